//! Mortar films: thin elastic strips between two faces that press, slide and part, (3.28)-(3.39).
//!
//! The strip of this module has its own nodes, for use from Rust. The films of a scene
//! ([`model::Film`](crate::model::Film)) act at contact points: as compliances, and with
//! [`Films::Strips`](crate::scene::Films::Strips) also as bars (see [`system`](crate::system)). Their solution with
//! strips is that of [`pointwise`].
//!
//! A film is a strip of mortar of length `l` and thickness `t_y` between two straight faces. It has its own local
//! axes: `x` along the joint, from `-l/2` to `l/2`, and `y` perpendicular to the joint. In the signs of
//! [`model`](crate::model), side `a` is the lower face and side `b` the upper face, `x` is the joint's tangent `t` and
//! `y` its normal `n`:
//!
//! ```text
//!    3 -------------------- 4      upper face, y = +t_y/2
//!    |                      |                                 y = n
//!    1 -------------------- 2      lower face, y = -t_y/2     |
//!  x = -l/2              x = l/2                              +--- x = t
//! ```
//!
//! Nodes are counted from 0 in code: node `k` of the figure is `k - 1`. Tension and elongation are positive: the
//! traction that a contact point calls `t_n` is `-sigma_y`, and `t_t` is `-tau`.
//!
//! | module | content |
//! |---|---|
//! | [`strip`] | strains (3.38) and stiffness of a strip on the part in contact |
//! | [`law`] | unilateral contact with friction in series with the film, at one point |
//! | [`pointwise`] | forces and tangent of a film with that law at its Gauss points |
//!
//! # Example
//! A film of 1 cm between a fixed lower face and an upper face pressed down by 1 micrometre:
//!
//! ```
//! use masonry::paper::film::{FilmMaterial, Vector8, pointwise::PointwiseFilm, strip::Strip};
//! use masonry::model::{Elasticity, Plane};
//!
//! let elasticity = Elasticity { young: 1e9, poisson: 0.0 };
//! let mortar = FilmMaterial { elasticity, plane: Plane::Stress };
//! let strip = Strip::new(0.2, 0.01, 0.1, &mortar)?;
//! let film = PointwiseFilm::new(strip, 0.6, 1)?;
//! let u = Vector8::from([0.0, 0.0, 0.0, 0.0, 0.0, -1e-6, 0.0, -1e-6]);
//! let answer = film.respond(&u, &film.initial());
//! // E * 1e-4 of strain is a pressure of 1e5 Pa on 0.2 m x 0.1 m, half of it at each node.
//! assert!((answer.force[5] + 1000.0).abs() < 1e-9);
//! # Ok::<(), masonry::paper::film::FilmError>(())
//! ```

use nalgebra::{Matrix3, SMatrix, SVector};

use crate::material::constitutive;
pub use crate::material::{Elasticity, FilmMaterial};

pub mod law;
pub mod pointwise;
pub mod strip;

/// Displacements `u_1, v_1, ..., u_4, v_4` \[m\] or forces \[N\] of four nodes.
pub type Vector8 = SVector<f64, 8>;

/// An 8 x 8 matrix on the displacements of four nodes.
pub type Matrix8 = SMatrix<f64, 8, 8>;

/// The reasons for which a film could not be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FilmError {
    /// A length is zero, negative or not finite.
    #[error("the {quantity} of the film is {value:e} m: it must be positive and finite")]
    NotPositive {
        /// The name of the length.
        quantity: &'static str,
        /// The length \[m\].
        value: f64,
    },
    /// The elastic constants do not give a positive definite elasticity.
    #[error(
        "the mortar is not elastic (E = {young:e} Pa, nu = {poisson}): \
         E must be positive, nu above -1 and below 0.5"
    )]
    NotElastic {
        /// Young's modulus \[Pa\].
        young: f64,
        /// Poisson's ratio \[-\].
        poisson: f64,
    },
    /// The friction coefficient is negative or not finite.
    #[error("the friction coefficient of the film is {mu}: it must be finite and not negative")]
    Friction {
        /// Coefficient of Coulomb friction \[-\].
        mu: f64,
    },
    /// The number of parts of a film is zero.
    #[error("the film has no Gauss points: divide it into at least one part")]
    NoParts,
}

impl FilmMaterial {
    /// Returns the matrix that maps `eps_x, eps_y, gamma` to `sigma_x, sigma_y, tau` \[Pa\].
    ///
    /// # Errors
    /// [`FilmError::NotElastic`] unless the matrix is positive definite.
    pub fn matrix(&self) -> Result<Matrix3<f64>, FilmError> {
        let Elasticity { young, poisson } = self.elasticity;
        if young > 0.0 && young.is_finite() && poisson > -1.0 && poisson < 0.5 {
            Ok(constitutive(self.elasticity, self.plane))
        } else {
            Err(FilmError::NotElastic { young, poisson })
        }
    }
}

/// Checks that a length is positive, and returns the length.
fn positive(quantity: &'static str, value: f64) -> Result<f64, FilmError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(FilmError::NotPositive { quantity, value })
    }
}
