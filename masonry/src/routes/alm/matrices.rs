//! The linear systems of the augmented Lagrangian, and the projection of the forces.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use lcp::{Contact2d, ContactState};

use super::AlmError;

/// Rounding errors of a gap, relative to its largest term.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The state of a contact, which decides what of it stands in the matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Contact {
    Open,
    Stick,
    Slip,
}

/// Rows of the contact points beside the problem.
pub(super) struct Structure<'a> {
    pub(super) problem: &'a Contact2d,
    diagonal: Vec<f64>,
    normal: Vec<Vec<(usize, f64)>>,
    tangent: Vec<Vec<(usize, f64)>>,
    /// The largest load.
    load: f64,
    /// The largest displacement that the loads would make, as if `K` were diagonal.
    way: f64,
}

impl<'a> Structure<'a> {
    pub(super) fn new(problem: &'a Contact2d) -> Result<Self, AlmError> {
        let k = problem.stiffness();
        let diagonal: Vec<f64> =
            (0..problem.displacements()).map(|j| k.get(j, j).copied().unwrap_or(0.0)).collect();
        if let Some(displacement) = diagonal.iter().position(|k| *k <= 0.0) {
            return Err(AlmError::NoStiffness { displacement });
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
        let way = largest(&ways.collect::<Vec<_>>());
        Ok(Self { problem, diagonal, normal: rows(problem.normal()), tangent, load, way })
    }

    /// Natural units of displacements and forces.
    pub(super) fn units(&self) -> [f64; 2] {
        [self.way, self.load]
    }

    /// The stiffness that a row sees, as if `K` were diagonal.
    fn seen(&self, row: &[(usize, f64)]) -> f64 {
        let compliance: f64 = row.iter().map(|&(j, v)| v * v / self.diagonal[j]).sum();
        if compliance > 0.0 { 1.0 / compliance } else { 0.0 }
    }

    /// `K u`: what the blocks take.
    pub(super) fn block_forces(&self, u: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; u.len()];
        for entry in self.problem.stiffness().triplet_iter() {
            forces[entry.row] += entry.val * u[entry.col];
        }
        forces
    }

    /// `f + C^T t - K u`, the largest entry relative to the loads.
    pub(super) fn unbalance(&self, state: &ContactState, block_forces: &[f64]) -> f64 {
        let loads = self.problem.loads().iter();
        let mut rest: Vec<f64> = loads.zip(block_forces).map(|(f, taken)| f - taken).collect();
        for (i, (t_n, t_t)) in state.t_n.iter().zip(&state.t_t).enumerate() {
            self.normal[i].iter().for_each(|&(j, v)| rest[j] += v * t_n);
            self.tangent[i].iter().for_each(|&(j, v)| rest[j] += v * t_t);
        }
        if rest.iter().any(|v| !v.is_finite()) {
            return f64::INFINITY;
        }
        let forces = state.t_n.iter().fold(0.0_f64, |max, t| max.max(*t));
        ratio(largest(&rest), if self.load > 0.0 { self.load } else { forces })
    }

    /// Largest of `min(force, gap or slip)` over the pairs of the contact law, with forces in units of the
    /// largest one, and gaps and slips in units of what the bodies are deformed by, or would be by the loads: a body that slid
    /// far makes all gaps small against its displacements, also those that should carry no force.
    pub(super) fn slack(&self, state: &ContactState, block_forces: &[f64]) -> f64 {
        let ContactState { u, t_n, t_t, gap, slip, .. } = state;
        let deformed = block_forces.iter().zip(&self.diagonal).map(|(force, k)| force / k);
        let length = deformed.fold(self.way, |max, d| max.max(d.abs()));
        let force = largest(t_n);
        // What rounding leaves of a gap between bodies that moved far is no gap.
        let rounding = |row: &[(usize, f64)], first: f64| {
            let terms = row.iter().map(|&(j, v)| (v * u[j]).abs());
            ROUNDING * terms.fold(first.abs(), f64::max)
        };
        let mut worst = 0.0_f64;
        for (i, mu) in self.problem.mu().iter().enumerate() {
            let in_normal = rounding(&self.normal[i], self.problem.initial_gaps()[i]);
            let in_tangent = rounding(&self.tangent[i], self.problem.initial_slips()[i]);
            let bound = mu * t_n[i];
            let pairs = [
                (t_n[i], gap[i] - in_normal),
                (bound + t_t[i], slip[i] - in_tangent),
                (bound - t_t[i], -slip[i] - in_tangent),
            ];
            for (t, y) in pairs.into_iter().take(if *mu > 0.0 { 3 } else { 1 }) {
                worst = worst.max(ratio(t.max(0.0), force).min(ratio(y.max(0.0), length)));
            }
        }
        worst
    }
}

/// The matrices for all states of the contacts, on one pattern.
pub(super) struct Matrices<'a> {
    structure: &'a Structure<'a>,
    rho_n: Vec<f64>,
    rho_t: Vec<f64>,
    proximal: f64,
    symbolic: SymbolicLlt<usize>,
}

impl<'a> Matrices<'a> {
    pub(super) fn new(
        structure: &'a Structure<'a>,
        penalty: f64,
        proximal: f64,
    ) -> Result<Self, AlmError> {
        let rho = |rows: &[Vec<(usize, f64)>]| -> Vec<f64> {
            rows.iter().map(|row| penalty * structure.seen(row)).collect()
        };
        let (rho_n, rho_t) = (rho(&structure.normal), rho(&structure.tangent));
        let all = vec![Contact::Stick; rho_n.len()];
        let matrix = assembled(structure, &all, (&rho_n, &rho_t), proximal)?;
        let symbolic = SymbolicLlt::try_new(matrix.symbolic(), Side::Lower).map_err(failed)?;
        Ok(Self { structure, rho_n, rho_t, proximal, symbolic })
    }

    pub(super) fn factorised(&self, contacts: &[Contact]) -> Result<Llt<usize, f64>, AlmError> {
        let rho = (&self.rho_n[..], &self.rho_t[..]);
        let matrix = assembled(self.structure, contacts, rho, self.proximal)?;
        Llt::try_new_with_symbolic(self.symbolic.clone(), matrix.as_ref(), Side::Lower)
            .map_err(failed)
    }

    /// The displacements that the present forces lead to.
    pub(super) fn displacements(
        &self,
        factors: &Llt<usize, f64>,
        contacts: &[Contact],
        at: &ContactState,
    ) -> Vec<f64> {
        let Structure { problem, diagonal, normal, tangent, .. } = self.structure;
        let n = diagonal.len();
        let (f, delta) = (problem.loads(), self.proximal);
        let mut u = Mat::from_fn(n, 1, |j, _| f[j] + delta * diagonal[j] * at.u[j]);
        for (i, contact) in contacts.iter().enumerate() {
            if *contact == Contact::Open {
                continue;
            }
            let t_n = at.t_n[i] - self.rho_n[i] * problem.initial_gaps()[i];
            normal[i].iter().for_each(|&(j, v)| u[(j, 0)] += v * t_n);
            let held = if *contact == Contact::Stick { self.rho_t[i] } else { 0.0 };
            let t_t = at.t_t[i] - held * problem.initial_slips()[i];
            tangent[i].iter().for_each(|&(j, v)| u[(j, 0)] += v * t_t);
        }
        factors.solve_in_place(&mut u);
        u.col_as_slice(0).to_vec()
    }

    /// The projection of the forces on the friction cones, and the states that belong to it.
    pub(super) fn projected(&self, at: &ContactState) -> (Vec<f64>, Vec<f64>, Vec<Contact>) {
        let all = self.structure.problem.mu().iter().enumerate().map(|(i, mu)| {
            let t_n = (at.t_n[i] - self.rho_n[i] * at.gap[i]).max(0.0);
            if t_n <= 0.0 {
                return (0.0, 0.0, Contact::Open);
            }
            let (t_t, bound) = (at.t_t[i] - self.rho_t[i] * at.slip[i], mu * t_n);
            match *mu {
                0.0 => (t_n, 0.0, Contact::Stick),
                _ if t_t.abs() <= bound => (t_n, t_t, Contact::Stick),
                _ => (t_n, bound.copysign(t_t), Contact::Slip),
            }
        });
        let (mut normal, mut tangential, mut contacts) = (Vec::new(), Vec::new(), Vec::new());
        for (t_n, t_t, contact) in all {
            normal.push(t_n);
            tangential.push(t_t);
            contacts.push(contact);
        }
        (normal, tangential, contacts)
    }
}

fn assembled(
    structure: &Structure<'_>,
    contacts: &[Contact],
    (rho_n, rho_t): (&[f64], &[f64]),
    proximal: f64,
) -> Result<SparseColMat<usize, f64>, AlmError> {
    let Structure { problem, diagonal, normal, tangent, .. } = structure;
    let k = problem.stiffness().triplet_iter();
    let mut entries: Vec<_> = k.map(|e| Triplet::new(e.row, e.col, *e.val)).collect();
    let held = diagonal.iter().enumerate();
    entries.extend(held.map(|(j, k)| Triplet::new(j, j, proximal * k)));
    for (i, contact) in contacts.iter().enumerate() {
        let closed = if *contact == Contact::Open { 0.0 } else { rho_n[i] };
        let sticking = if *contact == Contact::Stick { rho_t[i] } else { 0.0 };
        for (row, rho) in [(&normal[i], closed), (&tangent[i], sticking)] {
            // Zeros too: the pattern must not depend on the states.
            for &(j, v) in row {
                entries.extend(row.iter().map(|&(i, w)| Triplet::new(i, j, rho * v * w)));
            }
        }
    }
    let n = diagonal.len();
    SparseColMat::try_new_from_triplets(n, n, &entries).map_err(failed)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |max, v| max.max(v.abs()))
}

/// Nothing is a small part of anything, and everything a large part of nothing.
fn ratio(value: f64, unit: f64) -> f64 {
    if value <= 0.0 { 0.0 } else { value / unit }
}

fn failed(error: impl std::fmt::Debug) -> AlmError {
    AlmError::Factorisation(format!("{error:?}"))
}
