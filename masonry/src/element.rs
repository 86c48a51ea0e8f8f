//! Finite elements: the four-node quadrilateral and its quadrature.

use nalgebra::Matrix3;

use crate::material::Elasticity;
use crate::scene::Plane;

pub mod quad4;
pub mod quadrature;

/// The matrix that maps `eps_x, eps_y, gamma_xy` to `sigma_x, sigma_y, tau_xy` \[Pa\].
pub fn constitutive(elasticity: Elasticity, plane: Plane) -> Matrix3<f64> {
    let Elasticity { young, poisson } = elasticity;
    // Plane strain is plane stress with the constants of an infinitely long body.
    let (e, nu) = match plane {
        Plane::Stress => (young, poisson),
        Plane::Strain => (young / (1.0 - poisson * poisson), poisson / (1.0 - poisson)),
    };
    Matrix3::new(1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu)) * (e / (1.0 - nu * nu))
}
