//! The linear systems of the augmented Lagrangian, and the projection of the forces.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use lcp::{Contact2d, ContactState};

use super::AlmError;

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
        let load = problem.loads().iter().fold(0.0_f64, |max, f| max.max(f.abs()));
        Ok(Self { problem, diagonal, normal: rows(problem.normal()), tangent, load })
    }

    /// The stiffness that a row sees, as if `K` were diagonal.
    fn seen(&self, row: &[(usize, f64)]) -> f64 {
        let compliance: f64 = row.iter().map(|&(j, v)| v * v / self.diagonal[j]).sum();
        if compliance > 0.0 { 1.0 / compliance } else { 0.0 }
    }

    /// `f + C^T t - K u`, the largest entry relative to the loads.
    pub(super) fn unbalance(&self, state: &ContactState) -> f64 {
        let mut rest = self.problem.loads().to_vec();
        for entry in self.problem.stiffness().triplet_iter() {
            rest[entry.row] -= entry.val * state.u[entry.col];
        }
        for (i, (t_n, t_t)) in state.t_n.iter().zip(&state.t_t).enumerate() {
            self.normal[i].iter().for_each(|&(j, v)| rest[j] += v * t_n);
            self.tangent[i].iter().for_each(|&(j, v)| rest[j] += v * t_t);
        }
        let largest = rest.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
        let forces = state.t_n.iter().fold(0.0_f64, |max, t| max.max(*t));
        let unit = if self.load > 0.0 { self.load } else { forces };
        if rest.iter().any(|v| !v.is_finite()) {
            f64::INFINITY
        } else if unit > 0.0 {
            largest / unit
        } else {
            0.0
        }
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

fn failed(error: impl std::fmt::Debug) -> AlmError {
    AlmError::Factorisation(format!("{error:?}"))
}
