//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.
//!
//! By Farkas' lemma that is so exactly if some `pi` has `A^T pi <= 0`, `B^T pi <= 0` and
//! `c.pi > 0`. It is found by the dual simplex method without costs: a basic variable with a negative
//! value leaves, any nonbasic one that raises it enters, until no value is negative (feasible) or
//! none can be raised, when its row of the inverse basis is the proof.

use std::time::Instant;

use super::basis_matrix::BasisMatrix;
use super::start::{Equilibrated, Start};
use super::tableau::Tableau;
use crate::Side;
use crate::problem::max_abs;

/// Entries of a row below this multiple of the largest are taken for zero.
const PIVOT_TOLERANCE: f64 = 1e-9;
/// Values down to minus this, relative to the largest, are taken for zero.
const VALUE_TOLERANCE: f64 = 1e-10;
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
    let (basis, row) = infeasible_row(start, deadline)?;
    let matrix = BasisMatrix::from_columns(problem, &basis)?;
    let mut pi = vec![0.0; start.q.len()];
    pi[row] = -1.0;
    matrix.solve_transpose(&mut pi);
    pi.iter_mut().zip(&problem.row).for_each(|(pi, row)| *pi *= row);
    let largest = max_abs(&pi);
    pi.iter_mut().for_each(|pi| *pi /= largest);
    is_proof(problem, &pi).then_some(pi)
}

fn is_proof(problem: &Equilibrated<'_>, pi: &[f64]) -> bool {
    let columns = [Side::T, Side::Y].into_iter().flat_map(|side| {
        (0..pi.len()).map(move |pair| problem.problem.column(pair, side))
    });
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

/// A basis, one column for every row of the tableau, and the row that cannot be made nonnegative.
fn infeasible_row(start: &Start, deadline: Option<Instant>) -> Option<(Vec<(usize, Side)>, usize)> {
    let n = start.q.len();
    let mut tableau = Tableau::new(start.t.clone());
    let mut values = start.q.clone();
    let side = |var: usize| {
        let nonbasic = start.nonbasic_side(var % n);
        if var < n { nonbasic.complement() } else { nonbasic }
    };
    let mut basic: Vec<usize> = (0..n).collect();
    let mut nonbasic: Vec<usize> = (n..2 * n).collect();
    let mut column = vec![0.0; n];
    // The most negative value and the largest pivot first; should that cycle, the least index, which
    // does not (the criss-cross method; Terlaky 1985).
    let (fast, slow) = (2 * n + 20, 4 * n + 40);
    for pivot in 0..slow {
        if deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return None;
        }
        let least = -VALUE_TOLERANCE * max_abs(&values);
        let negative = (0..n).filter(|&i| values[i] < least && !start.is_free(basic[i] % n));
        let row = if pivot < fast {
            negative.min_by(|&i, &j| values[i].total_cmp(&values[j]))
        } else {
            negative.min_by_key(|&i| basic[i])
        }?;
        let inverse_row = tableau.row(row);
        let entries: Vec<f64> = (0..n).map(|col| tableau.entry(&inverse_row, col)).collect();
        let smallest = -PIVOT_TOLERANCE * max_abs(&entries).max(1.0);
        let raising = (0..n).filter(|&col| entries[col] < smallest);
        let entering = if pivot < fast {
            raising.min_by(|&i, &j| entries[i].total_cmp(&entries[j]))
        } else {
            raising.min_by_key(|&col| nonbasic[col])
        };
        let Some(col) = entering else {
            return Some((basic.iter().map(|&var| (var % n, side(var))).collect(), row));
        };
        tableau.column(col, &mut column);
        let step = values[row] / column[row];
        values.iter_mut().zip(&column).for_each(|(value, a)| *value -= step * a);
        values[row] = step;
        tableau.pivot(row, col, &column);
        std::mem::swap(&mut basic[row], &mut nonbasic[col]);
    }
    None
}
