//! The strip: shape functions, strains, stiffness and stress of a film in its local axes.
//!
//! Displacements are linear along each face. The strains are means over the two faces, because
//! the film is thin; `phi- = 1/2 - x/l` and `phi+ = 1/2 + x/l` are the shape functions of a face:
//!
//! ```text
//!  eps_x = (u_2 - u_1 + u_4 - u_3) / 2l
//!  eps_y = (phi- (v_3 - v_1) + phi+ (v_4 - v_2)) / t_y
//!  gamma = (phi- (u_3 - u_1) + phi+ (u_4 - u_2)) / t_y + (v_2 - v_1 + v_4 - v_3) / 2l
//! ```
//!
//! No rigid-body motion of the whole strip causes strain, provided that the faces are drawn at their real distance
//! `t_y`. A rotation would strain a strip whose two faces are drawn on one line.

use nalgebra::{Matrix3, Vector3};

use super::{FilmError, FilmMaterial, Matrix8, Vector8, positive};
use crate::element::quad4::StrainMatrix;
use crate::element::quadrature::GAUSS_2;

/// A strip of mortar between two straight faces.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    length: f64,
    thickness: f64,
    wall: f64,
    material: FilmMaterial,
    matrix: Matrix3<f64>,
}

impl Strip {
    /// Builds a strip of length `l`, thickness `t_y` between its faces, and thickness `t_z` out of the plane (that of
    /// the wall) \[m\].
    ///
    /// # Errors
    /// [`FilmError`] if a length is not positive or the material is not elastic.
    pub fn new(
        length: f64,
        thickness: f64,
        wall: f64,
        material: &FilmMaterial,
    ) -> Result<Self, FilmError> {
        Ok(Self {
            length: positive("length", length)?,
            thickness: positive("thickness", thickness)?,
            wall: positive("thickness out of the plane", wall)?,
            material: *material,
            matrix: material.matrix()?,
        })
    }

    /// Returns the length `l` along the joint \[m\].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Returns the thickness `t_y` between the faces \[m\].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Returns the thickness `t_z` out of the plane \[m\].
    pub fn wall(&self) -> f64 {
        self.wall
    }

    /// Returns the mortar of the strip.
    pub fn material(&self) -> &FilmMaterial {
        &self.material
    }

    /// Returns the matrix that maps `eps_x, eps_y, gamma` to `sigma_x, sigma_y, tau` \[Pa\].
    pub fn elasticity(&self) -> &Matrix3<f64> {
        &self.matrix
    }

    /// Returns the coordinates `x` of the ends of the strip, `-l/2` and `l/2` \[m\].
    pub fn ends(&self) -> [f64; 2] {
        [-0.5 * self.length, 0.5 * self.length]
    }

    /// Returns the shape functions `phi-` and `phi+` of a face at `x` \[m\].
    pub fn shape(&self, x: f64) -> [f64; 2] {
        [0.5 - x / self.length, 0.5 + x / self.length]
    }

    /// Returns the strain matrix `B(x)` (3.38) \[1/m\]: `(eps_x, eps_y, gamma) = B u`.
    pub fn strain_matrix(&self, x: f64) -> StrainMatrix {
        let [minus, plus] = self.shape(x);
        let mut b = StrainMatrix::zeros();
        for (node, phi) in [-minus, -plus, minus, plus].into_iter().enumerate() {
            let slope = if node % 2 == 0 { -0.5 } else { 0.5 } / self.length;
            b[(0, 2 * node)] = slope;
            b[(1, 2 * node + 1)] = phi / self.thickness;
            b[(2, 2 * node)] = phi / self.thickness;
            b[(2, 2 * node + 1)] = slope;
        }
        b
    }

    /// Returns the stress `(sigma_x, sigma_y, tau)` \[Pa\] at `x` of the bonded strip, which can also carry tension.
    pub fn stress(&self, x: f64, displacements: &Vector8) -> Vector3<f64> {
        self.matrix * self.strain_matrix(x) * displacements
    }

    /// Returns the stiffness \[N/m\] of the strip if it is bonded on `[x_i, x_f]` \[m\] and carries nothing elsewhere;
    /// zero if this part is empty (`x_f <= x_i`).
    ///
    /// Exact: the integrand is quadratic in `x`.
    pub fn stiffness(&self, [from, to]: [f64; 2]) -> Matrix8 {
        let half = 0.5 * (to - from).max(0.0);
        let volume = half * self.thickness * self.wall;
        GAUSS_2
            .map(|xi| {
                let b = self.strain_matrix(0.5 * (from + to) + half * xi);
                b.transpose() * self.matrix * b * volume
            })
            .iter()
            .sum()
    }
}
