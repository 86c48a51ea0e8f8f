//! Materials of blocks and mortar, in SI units.

use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// Elastic constants of a linear elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio \[-\].
    pub poisson: f64,
}

/// The two-dimensional idealisation of elasticity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Plane {
    /// Plane stress, free to strain out of the plane: `sigma_z = 0`.
    Stress,
    /// Plane strain, without strain out of the plane: `eps_z = 0`.
    Strain,
}

/// The mortar of a film: its elastic constants and the plane idealisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmMaterial {
    /// Elastic constants.
    pub elasticity: Elasticity,
    /// Plane stress or plane strain.
    pub plane: Plane,
}

/// Returns the matrix that maps `eps_x, eps_y, gamma_xy` to `sigma_x, sigma_y, tau_xy` \[Pa\].
pub fn constitutive(elasticity: Elasticity, plane: Plane) -> Matrix3<f64> {
    let Elasticity { young, poisson } = elasticity;
    // Plane strain is plane stress with the constants of an infinitely long body.
    let (e, nu) = match plane {
        Plane::Stress => (young, poisson),
        Plane::Strain => (young / (1.0 - poisson * poisson), poisson / (1.0 - poisson)),
    };
    Matrix3::new(1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu)) * (e / (1.0 - nu * nu))
}
