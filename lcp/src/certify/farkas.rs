//! Proofs that there is no solution.
//!
//! By Farkas' lemma `A t + B y = c` has no solution with `t >= 0` and `y >= 0` exactly if some `pi` has
//! `A^T pi <= 0`, `B^T pi <= 0` and `c.pi > 0`.

use crate::matrix::Column;
use crate::{HorizontalLcp, Side};

/// Rounding of a component of `A^T pi`, relative to `|A|^T |pi|`.
const ROUNDING: f64 = 1e-12;
/// Least value of `c.pi` of a proof, relative to `|c|.|pi|`.
const LEAST_GAP: f64 = 1e-9;

/// Whether a vector proves that the linear conditions have no solution.
pub(crate) fn is_proof(problem: &HorizontalLcp, pi: &[f64]) -> bool {
    let pairs = 0..problem.order();
    let columns = [Side::T, Side::Y]
        .into_iter()
        .flat_map(|side| pairs.clone().map(move |pair| problem.column(pair, side)));
    is_proof_of(columns, problem.c(), pi)
}

/// Whether a vector proves that no nonnegative combination of these columns is `c`.
pub(crate) fn is_proof_of<'a>(
    columns: impl IntoIterator<Item = Column<'a>>,
    c: &[f64],
    pi: &[f64],
) -> bool {
    let sums = |column: Column<'_>| {
        let (mut sum, mut size) = (0.0, 0.0);
        column.for_each(|i, v| {
            sum += v * pi[i];
            size += (v * pi[i]).abs();
        });
        (sum, size)
    };
    if pi.len() != c.len() || pi.iter().any(|pi| !pi.is_finite()) {
        return false;
    }
    let holds = columns.into_iter().map(sums).all(|(sum, size)| sum <= ROUNDING * size);
    let (gap, size) = sums(Column::Dense(c));
    holds && gap > LEAST_GAP * size
}
