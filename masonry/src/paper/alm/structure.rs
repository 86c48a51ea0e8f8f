//! The data that stay the same through all iterations: loads, rows of the contacts, films, and their natural units.

use faer::sparse::SparseColMat;
use lcp::{Contact2d, ContactState, Residuals};

use super::films::Segment;
use super::{AlmError, ROUNDING};
use crate::law::Cone;
use crate::paper::film::pointwise::FilmResponse;
use crate::rounding::{cleared, largest};

/// The internal forces of blocks and films under displacements of the blocks.
pub(super) struct Taken {
    /// The internal forces of the blocks, `K u` \[N\].
    pub(super) blocks: Vec<f64>,
    /// The responses of all films.
    pub(super) films: Vec<FilmResponse>,
    /// The sum of the internal forces of blocks and films \[N\].
    all: Vec<f64>,
}

/// A contact problem with its films, and data derived from both that stay the same in all iterations.
pub(super) struct Structure<'a> {
    pub(super) problem: &'a Contact2d,
    pub(super) films: &'a [Segment],
    pub(super) diagonal: Vec<f64>,
    pub(super) normal: Vec<Vec<(usize, f64)>>,
    pub(super) tangent: Vec<Vec<(usize, f64)>>,
    /// The largest load \[N\].
    load: f64,
    /// The largest displacement \[m\] that the loads would cause if `K` were diagonal.
    way: f64,
}

impl<'a> Structure<'a> {
    pub(super) fn new(problem: &'a Contact2d, films: &'a [Segment]) -> Result<Self, AlmError> {
        let k = problem.stiffness();
        let diagonal: Vec<f64> =
            (0..problem.displacements()).map(|j| k.get(j, j).copied().unwrap_or(0.0)).collect();
        if let Some(displacement) = diagonal.iter().position(|k| *k <= 0.0) {
            return Err(AlmError::NoStiffness { displacement });
        }
        let has_spring = |compliance: &[f64; 2]| compliance.iter().any(|it| *it > 0.0);
        if let Some(contact) = problem.compliance().iter().position(has_spring) {
            return Err(AlmError::Compliance { contact });
        }
        let rows = |matrix: &SparseColMat<usize, f64>| {
            let mut rows = vec![Vec::new(); problem.points()];
            matrix.triplet_iter().for_each(|entry| rows[entry.row].push((entry.col, *entry.val)));
            rows
        };
        let mut tangent = rows(problem.tangent());
        let without = problem.mu().iter().enumerate().filter(|(_, mu)| **mu == 0.0);
        without.for_each(|(i, _)| tangent[i].clear());
        let load = largest(problem.loads());
        let ways = problem.loads().iter().zip(&diagonal).map(|(f, k)| f / k);
        let way = largest(ways.collect::<Vec<_>>());
        let normal = rows(problem.normal());
        Ok(Self { problem, films, diagonal, normal, tangent, load, way })
    }

    /// Returns the natural units of displacements and of forces, in this order.
    pub(super) fn units(&self) -> [f64; 2] {
        [self.way, self.load]
    }

    /// Returns the stiffness at a row of contacts as if `K` were diagonal.
    pub(super) fn seen(&self, row: &[(usize, f64)]) -> f64 {
        let compliance: f64 = row.iter().map(|&(j, v)| v * v / self.diagonal[j]).sum();
        if compliance > 0.0 { 1.0 / compliance } else { 0.0 }
    }

    /// Computes the internal forces of blocks and films under the displacements `u`.
    pub(super) fn taken(&self, u: &[f64]) -> Taken {
        let mut blocks = vec![0.0; u.len()];
        for entry in self.problem.stiffness().triplet_iter() {
            blocks[entry.row] += entry.val * u[entry.col];
        }
        let films: Vec<FilmResponse> = self.films.iter().map(|film| film.respond(u)).collect();
        let mut all = blocks.clone();
        for (film, response) in self.films.iter().zip(&films) {
            film.add_force(&response.force, &mut all);
        }
        Taken { blocks, films, all }
    }

    /// Returns the unbalanced nodal forces: the sum of loads and contact forces, minus the internal forces of blocks
    /// and films; without films `f + C^T t - K u`.
    pub(super) fn rest(&self, t_n: &[f64], t_t: &[f64], taken: &Taken) -> Vec<f64> {
        let loads = self.problem.loads().iter();
        let mut rest: Vec<f64> = loads.zip(&taken.all).map(|(f, taken)| f - taken).collect();
        for (i, (t_n, t_t)) in t_n.iter().zip(t_t).enumerate() {
            self.normal[i].iter().for_each(|&(j, v)| rest[j] += v * t_n);
            self.tangent[i].iter().for_each(|&(j, v)| rest[j] += v * t_t);
        }
        rest
    }

    /// Returns the largest unbalanced force, relative to the loads \[-\].
    pub(super) fn unbalance(&self, state: &ContactState, taken: &Taken) -> f64 {
        let rest = self.rest(&state.t_n, &state.t_t, taken);
        if rest.iter().any(|v| !v.is_finite()) {
            return f64::INFINITY;
        }
        ratio(largest(&rest), if self.load > 0.0 { self.load } else { largest(&state.t_n) })
    }

    /// Computes the residuals of a state from the data. The law of films holds by construction, and the internal
    /// forces of films are subtracted from the loads of the contact problem.
    ///
    /// # Errors
    /// [`lcp::Error::NotFinite`] if the forces of films overflow.
    pub(super) fn residuals(
        &self,
        state: &ContactState,
        taken: &Taken,
    ) -> Result<Residuals, lcp::Error> {
        if self.films.is_empty() {
            return Ok(self.problem.residuals(state));
        }
        let of_films: Vec<f64> = taken.all.iter().zip(&taken.blocks).map(|(a, b)| a - b).collect();
        let size = largest(&of_films);
        let loads = self.problem.loads().iter().zip(&of_films);
        let left = loads.map(|(f, film)| f - cleared(*film, size)).collect();
        Ok(self.problem.with_loads(left)?.residuals(state))
    }

    /// Returns the largest violation of the contact law \[-\]: the largest of `min(force, gap or slip)` over its
    /// pairs, and of the violations of signs. Forces are in units of the largest force; gaps and slips are in units of
    /// the deformation of the bodies, or of the displacement under the loads if that is larger. Units of the
    /// displacements of a body that slid far would make all its gaps small, including gaps at points with a force.
    pub(super) fn slack(&self, state: &ContactState, taken: &Taken) -> f64 {
        let ContactState { u, t_n, t_t, gap, slip, .. } = state;
        let deformed = taken.blocks.iter().zip(&self.diagonal).map(|(force, k)| force / k);
        let length = deformed.fold(self.way, |max, d| max.max(d.abs()));
        let force = largest(t_n);
        // A rounding error between bodies that moved far is not a gap.
        let rounding = |row: &[(usize, f64)], first: f64| {
            let terms = row.iter().map(|&(j, v)| (v * u[j]).abs());
            ROUNDING * terms.fold(first.abs(), f64::max)
        };
        let mut worst = 0.0_f64;
        for (i, mu) in self.problem.mu().iter().enumerate() {
            let in_normal = rounding(&self.normal[i], self.problem.initial_gaps()[i]);
            let in_tangent = rounding(&self.tangent[i], self.problem.initial_slips()[i]);
            let [plus, minus] = Cone::friction(*mu).distances(t_n[i], t_t[i]);
            let pairs = [
                (t_n[i], gap[i] - in_normal),
                (plus, slip[i] - in_tangent),
                (minus, -slip[i] - in_tangent),
            ];
            for (t, y) in pairs.into_iter().take(if *mu > 0.0 { 3 } else { 1 }) {
                worst = worst.max(ratio(t.max(0.0), force).min(ratio(y.max(0.0), length)));
                worst = worst.max(ratio(-t, force));
            }
            worst = worst.max(ratio(-gap[i] - in_normal, length));
        }
        worst
    }
}

/// Returns the ratio `value / unit`: zero if `value` is not positive, and infinite for a positive value if `unit` is
/// zero.
fn ratio(value: f64, unit: f64) -> f64 {
    if value <= 0.0 { 0.0 } else { value / unit }
}
