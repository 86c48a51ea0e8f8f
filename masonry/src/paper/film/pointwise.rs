//! Nodal forces and tangent stiffness of a film with the contact law at its Gauss points.
//!
//! The strip is divided into equal parts with two Gauss points each. The integral over a part is exact if all of it
//! sticks, or all of it is open; a boundary between states inside a part causes an error of the order of the square of
//! its length.

use nalgebra::Matrix3;

use super::law::{FilmLaw, FilmState, PointResponse};
use super::strip::Strip;
use super::{FilmError, Matrix8, Vector8};
use crate::element::quadrature::GAUSS_2;

/// A strip with unilateral contact and friction at Gauss points.
#[derive(Debug, Clone, PartialEq)]
pub struct PointwiseFilm {
    strip: Strip,
    law: FilmLaw,
    parts: usize,
}

/// The response of a film to the displacements of its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmResponse {
    /// Internal forces \[N\], conjugate to the displacements: the forces that the nodes must apply to the film.
    pub force: Vector8,
    /// The responses of the Gauss points, in the order of increasing `x`.
    pub points: Vec<PointResponse>,
    /// Energy dissipated in this step \[J\], never negative.
    pub dissipation: f64,
}

impl PointwiseFilm {
    /// Builds a film with friction coefficient `mu` and `2 * parts` Gauss points.
    ///
    /// # Errors
    /// [`FilmError::Friction`] and [`FilmError::NoParts`].
    pub fn new(strip: Strip, mu: f64, parts: usize) -> Result<Self, FilmError> {
        if parts == 0 {
            return Err(FilmError::NoParts);
        }
        let law = FilmLaw::new(strip.material(), strip.thickness(), mu)?;
        Ok(Self { strip, law, parts })
    }

    /// Returns the elastic strip of the film.
    pub fn strip(&self) -> &Strip {
        &self.strip
    }

    /// Returns the law that holds at each Gauss point.
    pub fn law(&self) -> &FilmLaw {
        &self.law
    }

    /// Returns the coordinates `x` of the Gauss points \[m\], increasing.
    pub fn places(&self) -> impl Iterator<Item = f64> {
        let part = self.strip.length() / self.parts as f64;
        let start = self.strip.ends()[0];
        (0..self.parts)
            .flat_map(move |k| GAUSS_2.map(|xi| start + part * (k as f64 + 0.5 * (1.0 + xi))))
    }

    /// Returns the states of all Gauss points before any slip.
    pub fn initial(&self) -> Vec<FilmState> {
        vec![FilmState::default(); 2 * self.parts]
    }

    /// Returns the volume of the film that one Gauss point stands for \[m^3\].
    pub fn volume(&self) -> f64 {
        let area = 0.5 * self.strip.length() / self.parts as f64 * self.strip.wall();
        area * self.strip.thickness()
    }

    /// Returns the integral of `B^T D B` \[N/m\], with a matrix `D` \[Pa\] at every Gauss point. With the tangents of
    /// the points, which are not symmetric if the points slip, it is the derivative of the forces with respect to the
    /// displacements.
    pub fn tangent(&self, d: impl IntoIterator<Item = Matrix3<f64>>) -> Matrix8 {
        let points = self.places().zip(d).map(|(x, d)| {
            let b = self.strip.strain_matrix(x);
            b.transpose() * d * b * self.volume()
        });
        points.sum()
    }

    /// Computes forces and states for `displacements` of the nodes in local axes, from the states `before` the step.
    ///
    /// # Panics
    /// If the number of states differs from the number of Gauss points.
    pub fn respond(&self, displacements: &Vector8, before: &[FilmState]) -> FilmResponse {
        assert_eq!(before.len(), 2 * self.parts, "one state per Gauss point");
        let volume = self.volume();
        let area = volume / self.strip.thickness();
        let mut response = FilmResponse {
            force: Vector8::zeros(),
            points: Vec::with_capacity(before.len()),
            dissipation: 0.0,
        };
        for (x, state) in self.places().zip(before) {
            let b = self.strip.strain_matrix(x);
            let point = self.law.respond(b * displacements, *state);
            response.force += b.transpose() * point.stress * volume;
            response.dissipation += point.dissipation * area;
            response.points.push(point);
        }
        response
    }
}
