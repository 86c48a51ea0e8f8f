//! The law at one point of a film: elastic mortar in series with a unilateral interface with friction.
//!
//! The faces move by the deformation of the mortar and by opening and sliding of an interface. The law
//! for the slip `s` reached so far and the elastic matrix `C` is:
//!
//! ```text
//!  sigma_y* = C_yx eps_x + C_yy eps_y,      tau* = G (gamma - s / t_y)
//!
//!  open    sigma_y* > 0                     sigma_y = tau = 0,  sigma_x = (C_xx - C_xy^2 / C_yy) eps_x
//!  stick   |tau*| <= -mu sigma_y*           sigma = C eps with tau = tau*
//!  slip    otherwise                        tau = sign(tau*) mu |sigma_y|,  the rest as in stick
//! ```
//!
//! The stress is continuous in the strain. `s` becomes `t_y (gamma - tau / G)` in every state, and the
//! dissipation `tau ds` is positive if the point slips, and zero otherwise.

use nalgebra::{Matrix3, Vector3};

use super::{FilmError, FilmMaterial, positive};
use crate::data::state::PointStatus;
use crate::law::Cone;

/// The state of one Gauss point of a film that later steps depend on: its slip.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FilmState {
    /// Slip of the upper face along `x` relative to the lower face, without the shear deformation of the mortar \[m\].
    pub slip: f64,
}

/// The response of one point of a film to its strains.
#[derive(Debug, Clone, PartialEq)]
pub struct PointResponse {
    /// The stress `(sigma_x, sigma_y, tau)` \[Pa\].
    pub stress: Vector3<f64>,
    /// Derivative of the stress with respect to the strain \[Pa\]; not symmetric if the point slips.
    pub tangent: Matrix3<f64>,
    /// The state of contact: open, sticking or slipping.
    pub contact: PointStatus,
    /// The slip after this step, from which the next step starts.
    pub state: FilmState,
    /// Opening of the interface \[m\]; zero unless the interface is open.
    pub opening: f64,
    /// Energy dissipated in this step per area of the joint \[J/m^2\], never negative.
    pub dissipation: f64,
}

/// The law of a film with its mortar, thickness and friction coefficient.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmLaw {
    matrix: Matrix3<f64>,
    thickness: f64,
    cone: Cone,
}

impl FilmLaw {
    /// Builds the law of a film of `thickness` `t_y` \[m\] with friction coefficient `mu`.
    ///
    /// # Errors
    /// [`FilmError`] if the thickness is not positive, the material not elastic, or `mu` negative.
    ///
    /// ```
    /// use masonry::data::state::PointStatus;
    /// use masonry::paper::film::{FilmMaterial, law::{FilmLaw, FilmState}};
    /// use masonry::model::{Elasticity, Plane};
    /// use nalgebra::Vector3;
    ///
    /// let elasticity = Elasticity { young: 2e9, poisson: 0.0 };
    /// let law = FilmLaw::new(&FilmMaterial { elasticity, plane: Plane::Stress }, 0.01, 0.5)?;
    /// let answer = law.respond(Vector3::new(0.0, -1e-4, 3e-4), FilmState::default());
    /// assert_eq!(answer.contact, PointStatus::Slip);
    /// assert!((answer.stress.z - 0.5 * 2e5).abs() < 1e-6);
    /// assert!((answer.state.slip - 2e-6).abs() < 1e-15);
    /// # Ok::<(), masonry::paper::film::FilmError>(())
    /// ```
    pub fn new(material: &FilmMaterial, thickness: f64, mu: f64) -> Result<Self, FilmError> {
        if !(mu >= 0.0 && mu.is_finite()) {
            return Err(FilmError::Friction { mu });
        }
        let thickness = positive("thickness", thickness)?;
        Ok(Self { matrix: material.matrix()?, thickness, cone: Cone::friction(mu) })
    }

    /// Computes stress and state for the strains `(eps_x, eps_y, gamma)`, from the state `before` the step.
    pub fn respond(&self, strain: Vector3<f64>, before: FilmState) -> PointResponse {
        let elastic = Vector3::new(strain.x, strain.y, strain.z - before.slip / self.thickness);
        let trial = self.matrix * elastic;
        if trial.y > 0.0 {
            self.open(strain, trial)
        } else if trial.z.abs() <= self.cone.bound(-trial.y) && self.cone.mu > 0.0 {
            PointResponse {
                stress: trial,
                tangent: self.matrix,
                contact: PointStatus::Stick,
                state: before,
                opening: 0.0,
                dissipation: 0.0,
            }
        } else {
            self.slipping(trial, before)
        }
    }

    fn open(&self, strain: Vector3<f64>, trial: Vector3<f64>) -> PointResponse {
        let c = &self.matrix;
        // The mortar is free to contract perpendicular to the joint.
        let along = c[(0, 0)] - c[(0, 1)] * c[(1, 0)] / c[(1, 1)];
        let mut tangent = Matrix3::zeros();
        tangent[(0, 0)] = along;
        PointResponse {
            stress: Vector3::new(along * strain.x, 0.0, 0.0),
            tangent,
            contact: PointStatus::Open,
            state: FilmState { slip: self.thickness * strain.z },
            opening: self.thickness * trial.y / c[(1, 1)],
            dissipation: 0.0,
        }
    }

    fn slipping(&self, trial: Vector3<f64>, before: FilmState) -> PointResponse {
        let slope = -self.cone.slope(trial.z);
        let tau = slope * trial.y;
        let advance = self.thickness * (trial.z - tau) / self.matrix[(2, 2)];
        let mut tangent = self.matrix;
        tangent.set_row(2, &(self.matrix.row(1) * slope));
        PointResponse {
            stress: Vector3::new(trial.x, trial.y, tau),
            tangent,
            contact: PointStatus::Slip,
            state: FilmState { slip: before.slip + advance },
            opening: 0.0,
            dissipation: tau * advance,
        }
    }
}
