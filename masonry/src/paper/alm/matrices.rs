//! The linear systems of the augmented Lagrangian, and the projection of the forces.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use lcp::ContactState;

use super::AlmError;
use super::structure::Structure;
use crate::data::state::PointStatus;
use crate::law::Cone;
use crate::paper::film::pointwise::FilmResponse;

/// The states of all contacts and films, on which the matrix depends.
#[derive(Clone, Copy)]
pub(super) struct States<'a> {
    pub(super) contacts: &'a [PointStatus],
    pub(super) films: &'a [FilmResponse],
}

/// The matrix of the iteration, with one sparsity pattern for all states of the contacts.
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
        let all = vec![PointStatus::Stick; rho_n.len()];
        let rest = structure.taken(&vec![0.0; structure.diagonal.len()]);
        let states = States { contacts: &all, films: &rest.films };
        let matrix = assembled(structure, states, &rho_n, &rho_t, proximal)?;
        let symbolic = SymbolicLlt::try_new(matrix.symbolic(), Side::Lower).map_err(failed)?;
        Ok(Self { structure, rho_n, rho_t, proximal, symbolic })
    }

    /// Assembles and factorises the matrix for given states of the contacts and of the films.
    pub(super) fn factorised(&self, states: States<'_>) -> Result<Llt<usize, f64>, AlmError> {
        let matrix = assembled(self.structure, states, &self.rho_n, &self.rho_t, self.proximal)?;
        Llt::try_new_with_symbolic(self.symbolic.clone(), matrix.as_ref(), Side::Lower)
            .map_err(failed)
    }

    /// Solves for the displacements under the current forces.
    pub(super) fn displacements(
        &self,
        factors: &Llt<usize, f64>,
        States { contacts, films }: States<'_>,
        at: &ContactState,
    ) -> Vec<f64> {
        let Structure { problem, diagonal, normal, tangent, .. } = self.structure;
        let n = diagonal.len();
        let (f, delta) = (problem.loads(), self.proximal);
        let mut u = Mat::from_fn(n, 1, |j, _| f[j] + delta * diagonal[j] * at.u[j]);
        for (i, contact) in contacts.iter().enumerate() {
            if *contact == PointStatus::Open {
                continue;
            }
            let t_n = at.t_n[i] - self.rho_n[i] * problem.initial_gaps()[i];
            normal[i].iter().for_each(|&(j, v)| u[(j, 0)] += v * t_n);
            let held = if *contact == PointStatus::Stick { self.rho_t[i] } else { 0.0 };
            let t_t = at.t_t[i] - held * problem.initial_slips()[i];
            tangent[i].iter().for_each(|&(j, v)| u[(j, 0)] += v * t_t);
        }
        // The forces of films exceed the product with their matrix, as friction that is held.
        let mut held = vec![0.0; n];
        for (film, response) in self.structure.films.iter().zip(films) {
            let by_matrix = film.matrix(response) * film.motion(&at.u);
            film.add_force(&(by_matrix - response.force), &mut held);
        }
        held.iter().enumerate().for_each(|(j, force)| u[(j, 0)] += force);
        factors.solve_in_place(&mut u);
        u.col_as_slice(0).to_vec()
    }

    /// Returns the norm of the residual of this iteration's equations at the displacements `u`: the unbalanced forces,
    /// with the contact forces projected on their cones and the forces of films included. The forces are divided by
    /// the square root of the diagonal stiffness, so that forces and moments can be added.
    pub(super) fn lack(&self, at: &ContactState, u: &[f64]) -> f64 {
        let Structure { problem, diagonal, .. } = self.structure;
        let trial = problem.state(u.to_vec(), at.t_n.clone(), at.t_t.clone());
        let (t_n, t_t, _) = self.projected(&trial);
        let rest = self.structure.rest(&t_n, &t_t, &self.structure.taken(u));
        let squares = rest.iter().zip(diagonal).zip(u.iter().zip(&at.u));
        let squares = squares.map(|((rest, k), (u, old))| {
            let rest = rest - self.proximal * k * (u - old);
            rest * rest / k
        });
        squares.sum::<f64>().sqrt()
    }

    /// Projects the contact forces on the friction cones; returns the normal and tangential forces and the states of
    /// the contacts.
    pub(super) fn projected(&self, at: &ContactState) -> (Vec<f64>, Vec<f64>, Vec<PointStatus>) {
        let all = self.structure.problem.mu().iter().enumerate().map(|(i, mu)| {
            let t_n = (at.t_n[i] - self.rho_n[i] * at.gap[i]).max(0.0);
            if t_n <= 0.0 {
                return (0.0, 0.0, PointStatus::Open);
            }
            let (t_t, bound) =
                (at.t_t[i] - self.rho_t[i] * at.slip[i], Cone::friction(*mu).bound(t_n));
            match *mu {
                0.0 => (t_n, 0.0, PointStatus::Stick),
                _ if t_t.abs() <= bound => (t_n, t_t, PointStatus::Stick),
                _ => (t_n, bound.copysign(t_t), PointStatus::Slip),
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
    States { contacts, films }: States<'_>,
    rho_n: &[f64],
    rho_t: &[f64],
    proximal: f64,
) -> Result<SparseColMat<usize, f64>, AlmError> {
    let Structure { problem, diagonal, normal, tangent, .. } = structure;
    let k = problem.stiffness().triplet_iter();
    let mut entries: Vec<_> = k.map(|e| Triplet::new(e.row, e.col, *e.val)).collect();
    let held = diagonal.iter().enumerate();
    entries.extend(held.map(|(j, k)| Triplet::new(j, j, proximal * k)));
    for (i, contact) in contacts.iter().enumerate() {
        let closed = if *contact == PointStatus::Open { 0.0 } else { rho_n[i] };
        let sticking = if *contact == PointStatus::Stick { rho_t[i] } else { 0.0 };
        for (row, rho) in [(&normal[i], closed), (&tangent[i], sticking)] {
            // Zeros are included: the pattern must not depend on the states.
            for &(j, v) in row {
                entries.extend(row.iter().map(|&(i, w)| Triplet::new(i, j, rho * v * w)));
            }
        }
    }
    for (film, response) in structure.films.iter().zip(films) {
        entries.extend(film.entries(&film.matrix(response)));
    }
    let n = diagonal.len();
    SparseColMat::try_new_from_triplets(n, n, &entries).map_err(failed)
}

fn failed(error: impl std::fmt::Debug) -> AlmError {
    AlmError::Factorisation(format!("{error:?}"))
}
