//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.
//!
//! Such a proof exists exactly if some `pi` has `A^T pi <= 0`, `B^T pi <= 0` and `c.pi > 0` (Farkas' lemma).
//! The vector is found by the primal simplex method on `w + T z - d z0 = q`, which minimises the artificial
//! variable without regard to complementarity. If its minimum is zero, the system is feasible. If not, the
//! multipliers of the last basis are the proof.

use super::basis_matrix::BasisMatrix;
use super::constants::VANISHING;
use super::kernel::Var;
use super::path::{Limits, Path};
use super::start::{Equilibrated, Start};
use crate::certify::is_proof;
use crate::pivoting::AttemptEnd;
use crate::vector::in_units_of_largest;

/// A checked Farkas vector, if one is found from a start basis.
pub(super) fn farkas_vector(
    problem: &Equilibrated<'_>,
    start: &Start,
    covering: &[f64],
    limits: Limits<'_>,
) -> Result<Option<Vec<f64>>, AttemptEnd> {
    let n = problem.order();
    let mut path = Path::new(start, covering);
    let mut column = vec![0.0; n];
    if path.enter_artificial(&mut column).is_none() {
        return Ok(None);
    }
    while let Some(row) = path.artificial_row() {
        if let Some(end) = limits(path.pivots, path.artificial_left()) {
            return Err(end);
        }
        if path.kernel.is_due() && !path.tidy() {
            break;
        }
        let Some(entering) = descending_variable(&path, row, n) else {
            // The vector is orthogonal to all basic columns except the artificial one, which the right-hand
            // side replaces.
            let basis: Vec<_> = path.basic().map(|var| start.variable(var)).collect();
            let matrix = BasisMatrix::from_columns(problem, &basis);
            let pi = matrix.map(|matrix| in_problem_rows(problem, &matrix.inverse_row(row)));
            return Ok(pi.filter(|pi| is_proof(problem.problem, pi)));
        };
        path.kernel.column(entering, &mut column);
        match path.leaving_row(&column) {
            Some(leaving) if path.is_new() => path.exchange(leaving, entering, &column),
            _ => break,
        };
    }
    Ok(None)
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
    best.1.filter(|_| best.0 > VANISHING * largest)
}

/// A vector in the rows of the problem from one in equilibrated rows, with a largest entry of one.
pub(super) fn in_problem_rows(problem: &Equilibrated<'_>, pi: &[f64]) -> Vec<f64> {
    in_units_of_largest(pi.iter().zip(&problem.row).map(|(pi, row)| pi * row))
}
