//! The master film: stiffness of films of every length from one integration.
//!
//! In the co-ordinate `x / l` the matrix `B` has a part without `l` and a part with `1/l`, so that the
//! stiffness of a film in contact along its whole length is
//!
//! ```text
//!  K(l) = l K_1 + K_0 + K_-1 / l
//! ```
//!
//! with three matrices that depend on the mortar and the two thicknesses only. A film in contact on a part
//! `[x_i, x_f]` is the film of that part with its ends moved back to the nodes, and a film between blocks
//! that overlap by chance is one with its ends moved to the corners: [`NodalChange::of_film`].

use super::change::{ChangeError, NodalChange};
use super::strip::{across, along};
use super::{FilmError, FilmMaterial, Matrix8, positive};
use crate::element::quadrature::GAUSS_2;

/// What films of one mortar and one thickness have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct MasterFilm {
    growing: Matrix8,
    constant: Matrix8,
    falling: Matrix8,
}

impl MasterFilm {
    /// The master of films of thickness `t_y` in a wall of thickness `t_z` \[m\].
    ///
    /// # Errors
    /// [`FilmError`] if a thickness is not positive or the material is not elastic.
    pub fn new(thickness: f64, wall: f64, material: &FilmMaterial) -> Result<Self, FilmError> {
        let thickness = positive("thickness", thickness)?;
        let wall = positive("thickness out of the plane", wall)?;
        let d = material.matrix()?;
        let section = thickness * wall;
        let slopes = along();
        // Each of the two points stands for half of the length.
        let weight = 0.5 * section;
        let mut master = Self {
            growing: Matrix8::zeros(),
            constant: Matrix8::zeros(),
            falling: slopes.transpose() * d * slopes * section,
        };
        for xi in GAUSS_2 {
            let b = across([0.5 * (1.0 - xi), 0.5 * (1.0 + xi)], thickness);
            let mixed = b.transpose() * d * slopes * weight;
            master.growing += b.transpose() * d * b * weight;
            master.constant += mixed + mixed.transpose();
        }
        Ok(master)
    }

    /// Stiffness \[N/m\] of a film of `length` \[m\] in contact along the whole of it, at its own ends.
    ///
    /// # Errors
    /// [`FilmError::NotPositive`] for the length.
    pub fn stiffness(&self, length: f64) -> Result<Matrix8, FilmError> {
        let length = positive("length", length)?;
        Ok(self.growing * length + self.constant + self.falling / length)
    }

    /// The same for a film whose nodes are at `[[x_1, x_2], [x_3, x_4]]` \[m\] of its local axis.
    ///
    /// # Errors
    /// [`MasterError`] if the length is not positive or a node cannot be moved there. `element` names
    /// the film.
    pub fn attached(
        &self,
        element: &str,
        length: f64,
        faces: [[f64; 2]; 2],
    ) -> Result<Matrix8, MasterError> {
        let own = self.stiffness(length)?;
        Ok(NodalChange::of_film(element, length, faces)?.stiffness(&own))
    }
}

/// Why the stiffness of an attached film could not be found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MasterError {
    /// The film itself.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The move of one of its nodes.
    #[error(transparent)]
    Change(#[from] ChangeError),
}
