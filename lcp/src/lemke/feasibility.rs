//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.
//!
//! By Farkas' lemma that is so exactly if some `pi` has `A^T pi <= 0`, `B^T pi <= 0` and
//! `c.pi > 0`. It is found by the primal simplex method on `w + T z - d z0 = q`, which makes the
//! artificial variable as small as it can be, without regard to complementarity. If that is zero, the
//! system is feasible. If not, the multipliers of the last basis are the proof.

use super::basis_matrix::BasisMatrix;
use super::constants::COST_TOLERANCE;
use super::kernel::Var;
use super::path::Path;
use super::start::{Equilibrated, Start};
use crate::Side;
use crate::certify::is_proof;
use crate::vector::max_abs;

/// A checked Farkas vector, if one is found along a path that has not begun. `is_over` is asked before
/// every pivot.
pub(super) fn farkas_vector(
    problem: &Equilibrated<'_>,
    start: &Start,
    mut path: Path<'_>,
    is_over: &mut dyn FnMut(usize, f64) -> bool,
) -> Option<Vec<f64>> {
    let n = problem.order();
    let mut column = vec![0.0; n];
    path.enter_artificial(&mut column)?;
    loop {
        if is_over(path.pivots, path.artificial_left()) || (path.kernel.is_due() && !path.tidy()) {
            return None;
        }
        let row = path.artificial_row()?;
        let Some(entering) = descending_variable(&path, row, n) else {
            let basis: Vec<_> = path.basic().map(|var| side_of(start, var, n)).collect();
            let pi = multipliers(problem, &basis, row)?;
            return is_proof(problem.problem, &pi).then_some(pi);
        };
        path.kernel.column(entering, &mut column);
        let leaving = path.leaving_row(&column)?;
        if !path.is_new() {
            return None;
        }
        path.exchange(leaving, entering, &column);
    }
}

/// The nonbasic variable that lowers the artificial one the fastest.
fn descending_variable(path: &Path<'_>, row: usize, n: usize) -> Option<Var> {
    let inverse_row = path.kernel.row(row);
    let mut largest = 1.0_f64;
    let mut best = (0.0, None);
    for var in (0..2 * n).filter(|&var| path.is_nonbasic(var)) {
        let cost = path.kernel.entry(row, &inverse_row, var);
        largest = largest.max(cost.abs());
        if cost > best.0 {
            best = (cost, Some(var));
        }
    }
    best.1.filter(|_| best.0 > COST_TOLERANCE * largest)
}

/// Pair and side of a variable; none for the artificial one.
fn side_of(start: &Start, var: Var, n: usize) -> Option<(usize, Side)> {
    (var < 2 * n).then(|| {
        let nonbasic = start.nonbasic_side(var % n);
        (var % n, if var < n { nonbasic.complement() } else { nonbasic })
    })
}

/// The vector that is orthogonal to all basic columns but the artificial one, in the rows of the
/// problem, with `c.pi > 0` and a largest entry of one.
fn multipliers(
    problem: &Equilibrated<'_>,
    basis: &[Option<(usize, Side)>],
    row: usize,
) -> Option<Vec<f64>> {
    let matrix = BasisMatrix::from_columns(problem, basis)?;
    Some(in_problem_rows(problem, &matrix.inverse_row(row)))
}

/// From equilibrated rows, with a largest entry of one.
pub(super) fn in_problem_rows(problem: &Equilibrated<'_>, pi: &[f64]) -> Vec<f64> {
    let pi: Vec<f64> = pi.iter().zip(&problem.row).map(|(pi, row)| pi * row).collect();
    let largest = max_abs(&pi);
    pi.into_iter().map(|pi| pi / largest).collect()
}
