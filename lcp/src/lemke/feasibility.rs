//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.
//!
//! By Farkas' lemma that is so exactly if some `pi` has `A^T pi <= 0`, `B^T pi <= 0` and
//! `c.pi > 0`. It is found by the dual simplex method without costs: a basic variable with a negative
//! value leaves, any nonbasic one that raises it enters, until no value is negative (feasible) or
//! none can be raised, when its row of the inverse basis is the proof.

use std::time::Instant;

use super::any_kernel::AnyKernel;
use super::basis_matrix::BasisMatrix;
use super::kernel::{Kernel, Var};
use super::start::{Equilibrated, Start};
use crate::Side;
use crate::problem::max_abs;

/// Entries of a row below this multiple of the largest are taken for zero.
const PIVOT_TOLERANCE: f64 = 1e-9;
/// Values down to minus this, relative to the largest, are taken for zero.
const VALUE_TOLERANCE: f64 = 4.0 * f64::EPSILON;
/// Entries of `pi` below this multiple of the largest, in equilibrated units, are rounding errors.
const NOISE: f64 = 1e-13;
/// Rounding of a component of `A^T pi`, relative to `|A|^T |pi|`.
const ROUNDING: f64 = 1e-12;
/// Least value of `c.pi` of a proof, relative to `|c|.|pi|`.
const LEAST_GAP: f64 = 1e-9;

/// A checked Farkas vector, if one is found.
pub(super) fn farkas_vector(
    problem: &Equilibrated<'_>,
    start: &Start,
    deadline: Option<Instant>,
) -> Option<Vec<f64>> {
    let n = start.q.len();
    let covering = vec![0.0; n];
    let mut simplex = DualSimplex::new(start, start.kernel(&covering, None));
    // A row whose value is a rounding error proves nothing; others may.
    let mut is_refuted = vec![false; n];
    for step in 0..4 * n + 40 {
        if deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return None;
        }
        // The most negative value and the largest pivot first; should that cycle, the least index,
        // which does not (the criss-cross method; Terlaky 1985).
        let by_index = step > 2 * n + 20;
        let row = simplex.negative_row(by_index, &is_refuted)?;
        if let Some(at) = simplex.raising_variable(row, by_index) {
            if !simplex.pivot(row, at) {
                return None;
            }
            is_refuted.fill(false);
        } else {
            let proof = multipliers(problem, &simplex.basis(), row);
            if let Some(pi) = proof.filter(|pi| is_proof(problem, pi)) {
                return Some(pi);
            }
            is_refuted[row] = true;
        }
    }
    None
}

/// The row of the inverse basis in the rows of the problem, with the sign of a Farkas vector.
fn multipliers(
    problem: &Equilibrated<'_>,
    basis: &[(usize, Side)],
    row: usize,
) -> Option<Vec<f64>> {
    let matrix = BasisMatrix::from_columns(problem, basis)?;
    let mut pi = vec![0.0; basis.len()];
    pi[row] = -1.0;
    matrix.solve_transpose(&mut pi);
    // Rounding errors in place of zeros would be judged by themselves.
    let least = NOISE * max_abs(&pi);
    pi.iter_mut().filter(|pi| pi.abs() < least).for_each(|pi| *pi = 0.0);
    pi.iter_mut().zip(&problem.row).for_each(|(pi, row)| *pi *= row);
    let largest = max_abs(&pi);
    Some(pi.into_iter().map(|pi| pi / largest).collect())
}

pub(super) fn is_proof(problem: &Equilibrated<'_>, pi: &[f64]) -> bool {
    let columns = [Side::T, Side::Y]
        .into_iter()
        .flat_map(|side| (0..pi.len()).map(move |pair| problem.problem.column(pair, side)));
    let mut holds = pi.iter().all(|pi| pi.is_finite());
    for column in columns {
        let (mut sum, mut size) = (0.0, 0.0);
        column.for_each(|i, v| {
            sum += v * pi[i];
            size += (v * pi[i]).abs();
        });
        holds &= sum <= ROUNDING * size;
    }
    let terms = problem.problem.c().iter().zip(pi).map(|(c, pi)| c * pi);
    let (gap, size) = terms.fold((0.0, 0.0), |(gap, size), v: f64| (gap + v, size + v.abs()));
    holds && gap > LEAST_GAP * size
}

/// `w + T z = q` with any of the variables basic. `w_k` is `k`, `z_k` is `n + k`.
struct DualSimplex<'a> {
    start: &'a Start,
    kernel: AnyKernel<'a>,
    values: Vec<f64>,
    basic: Vec<Var>,
    nonbasic: Vec<Var>,
    column: Vec<f64>,
}

impl<'a> DualSimplex<'a> {
    fn new(start: &'a Start, kernel: AnyKernel<'a>) -> Self {
        let n = start.q.len();
        Self {
            start,
            kernel,
            values: start.q.clone(),
            basic: (0..n).collect(),
            nonbasic: (n..2 * n).collect(),
            column: vec![0.0; n],
        }
    }

    fn order(&self) -> usize {
        self.values.len()
    }

    /// The basic columns, one for every row of the tableau.
    fn basis(&self) -> Vec<(usize, Side)> {
        let n = self.order();
        let side = |var: usize| {
            let nonbasic = self.start.nonbasic_side(var % n);
            if var < n { nonbasic.complement() } else { nonbasic }
        };
        self.basic.iter().map(|&var| (var % n, side(var))).collect()
    }

    fn negative_row(&self, by_index: bool, is_refuted: &[bool]) -> Option<usize> {
        let n = self.order();
        let least = -VALUE_TOLERANCE * max_abs(&self.values);
        let is_bounded = |i: &usize| !self.start.is_free(self.basic[*i] % n);
        let negative =
            (0..n).filter(|&i| self.values[i] < least && !is_refuted[i]).filter(is_bounded);
        if by_index {
            negative.min_by_key(|&i| self.basic[i])
        } else {
            negative.min_by(|&i, &j| self.values[i].total_cmp(&self.values[j]))
        }
    }

    /// Position in `nonbasic`.
    fn raising_variable(&self, row: usize, by_index: bool) -> Option<usize> {
        let inverse_row = self.kernel.row(row);
        let entry = |&var: &Var| self.kernel.entry(&inverse_row, var);
        let entries: Vec<f64> = self.nonbasic.iter().map(entry).collect();
        let smallest = -PIVOT_TOLERANCE * max_abs(&entries).max(1.0);
        let raising = (0..entries.len()).filter(|&at| entries[at] < smallest);
        if by_index {
            raising.min_by_key(|&at| self.nonbasic[at])
        } else {
            raising.min_by(|&i, &j| entries[i].total_cmp(&entries[j]))
        }
    }

    /// `false` when the basis has become singular.
    fn pivot(&mut self, row: usize, at: usize) -> bool {
        let (entering, leaving) = (self.nonbasic[at], self.basic[row]);
        self.kernel.column(entering, &mut self.column);
        let step = self.values[row] / self.column[row];
        self.values.iter_mut().zip(&self.column).for_each(|(value, a)| *value -= step * a);
        self.values[row] = step;
        self.kernel.exchange(row, entering, leaving, &self.column);
        (self.basic[row], self.nonbasic[at]) = (entering, leaving);
        self.kernel.tidy(&self.basic, &mut self.values)
    }
}
