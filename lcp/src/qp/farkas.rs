//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.
//!
//! The vector of the cone `A^T pi <= 0`, `B^T pi <= 0` that is nearest to `c` is zero where there is a
//! solution, and a proof where there is none: `c . pi = |pi|^2` (Moreau 1962). So the proof is
//! itself the unique solution of a convex quadratic program, which has an interior-point solution and
//! can be made exact, whatever made the problem infeasible.

use std::cell::OnceCell;

use super::constants::NOISE;
use super::form::{Bounds, Form};
use super::interior::{Effort, End, Interior};
use super::scale::Scaled;
use crate::active::{self, Original, cross_over};
use crate::certify::is_proof;
use crate::scaling::equilibrate;
use crate::states::{self, Condensed, nearest};
use crate::vector::max_abs;
use crate::{HorizontalLcp, Matrix};

/// The proof that a problem has no solution, looked for at most once.
pub(super) struct Proof<'a> {
    general: &'a dyn Fn() -> HorizontalLcp,
    answer: OnceCell<Option<Vec<f64>>>,
}

impl<'a> Proof<'a> {
    pub(super) fn new(general: &'a dyn Fn() -> HorizontalLcp) -> Self {
        Self { general, answer: OnceCell::new() }
    }

    pub(super) fn is_found(&self, effort: Effort) -> bool {
        self.answer.get_or_init(|| farkas_vector(&(self.general)(), effort)).is_some()
    }

    pub(super) fn into_farkas(self, effort: Effort) -> Option<Vec<f64>> {
        let search = || farkas_vector(&(self.general)(), effort);
        self.answer.into_inner().unwrap_or_else(search)
    }
}

/// A checked Farkas vector with a largest entry of one, if one is found.
fn farkas_vector(problem: &HorizontalLcp, effort: Effort) -> Option<Vec<f64>> {
    let (form, rows) = projection(problem);
    let scaled = Scaled::new(&form);
    let limits = vec![0.0; form.rows()];
    let found = Interior::new(&scaled.form, effort)?.solve(&scaled.form, &limits, effort.time);
    if matches!(found.end, End::NoPoint | End::Failed) {
        return None;
    }
    let point = scaled.unscaled(&found.point);
    cleaned(problem, (&point.x, &rows)).or_else(|| {
        let mixed = form.to_mixed()?;
        let scaled = states::Scaled::of_mixed(&mixed);
        let mut condensed = Condensed::new(&scaled).ok()?;
        let (t, y) = form.to_pairs(&mixed, &point);
        let (u, forces) = mixed.point(&scaled, &t, &y);
        let contacts = nearest(&scaled, &u, &forces);
        let mut proof = None;
        let effort = active::Effort::ANCHORED;
        cross_over(&scaled, &mut condensed, (&u, &forces), contacts, &effort, |_, vertex, _| {
            let pi = &scaled.displacements(&vertex.u)[..form.unknowns()];
            proof = proof.take().or_else(|| cleaned(problem, (pi, &rows)));
            proof.is_some()
        });
        proof
    })
}

/// `min |r - c|^2 / 2` subject to `A^T r <= 0` and `B^T r <= 0`, in equilibrated rows, with their factors.
/// The two conditions of a free variable, whose columns are opposite, are one equation.
fn projection(problem: &HorizontalLcp) -> (Form, Vec<f64>) {
    let n = problem.order();
    let columns = problem.columns();
    let (rows, cols) = equilibrate(n, &columns);
    let is_free: Vec<bool> = (0..n).map(|pair| is_free(problem, pair)).collect();
    let mut entries = Vec::new();
    let mut bounds = Vec::new();
    for (k, column) in columns.iter().enumerate() {
        if k >= n && is_free[k - n] {
            continue;
        }
        let row = bounds.len();
        column.for_each(|i, v| {
            if v != 0.0 {
                entries.push((row, i, -v * rows[i] * cols[k]));
            }
        });
        bounds.push(if is_free[k % n] { Bounds::Free } else { Bounds::Nonnegative });
    }
    let m = bounds.len();
    let form = Form {
        p: Matrix::identity(n).into_sparse(),
        d: Matrix::from_entries(m, n, entries.into_iter()).into_sparse(),
        s: Matrix::diagonal(m, 0.0).into_sparse(),
        linear: problem.c().iter().zip(&rows).map(|(c, row)| -c * row).collect(),
        offset: vec![0.0; m],
        bounds,
    };
    (form, rows)
}

/// Whether the columns of a pair are opposite.
fn is_free(problem: &HorizontalLcp, pair: usize) -> bool {
    let nonzero = |matrix: &Matrix, factor: f64| -> Vec<(usize, f64)> {
        let entries = matrix.column(pair).map(|(i, v)| (i, factor * v));
        entries.filter(|(_, v)| *v != 0.0).collect()
    };
    nonzero(problem.a(), 1.0) == nonzero(problem.b(), -1.0)
}

/// The proof that a vector of equilibrated rows is, after what is rounding error in it was set to zero: in
/// the units of the user a displacement and a force could not be compared.
fn cleaned(problem: &HorizontalLcp, (pi, rows): (&[f64], &[f64])) -> Option<Vec<f64>> {
    let largest = max_abs(pi);
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let pi: Vec<f64> = pi.iter().map(|pi| pi / largest).collect();
    let candidates = NOISE.into_iter().map(|noise| {
        let kept = pi.iter().map(|pi| if pi.abs() <= noise { 0.0 } else { *pi });
        let pi: Vec<f64> = kept.zip(rows).map(|(pi, row)| pi * row).collect();
        let largest = max_abs(&pi);
        pi.iter().map(|pi| pi / largest).collect::<Vec<_>>()
    });
    candidates.into_iter().find(|pi| is_proof(problem, pi))
}
