//! From a complementary basis to a point that the original data vouches for.

use super::start::Equilibrated;
use crate::linear::Lu;
use crate::problem::max_abs;
use crate::{Basis, HorizontalLcp, Residuals, Side};

/// Steps of iterative refinement.
const REFINEMENTS: usize = 3;

/// A point and what the original data says of it.
pub(super) struct Point {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) residuals: Residuals,
}

/// Solves for the basic variables with the original columns, refines, and sets negative values to
/// zero: if that is more than rounding, the equation residual tells.
pub(super) fn solve_basis(
    problem: &HorizontalLcp,
    scaling: &Equilibrated,
    basis: &Basis,
) -> Option<Point> {
    let matrix = problem.basis_matrix(basis, &scaling.row, |j, side| scaling.factor(j, side));
    let lu = Lu::new(matrix.as_ref())?;
    let right: Vec<f64> = problem.c().iter().zip(&scaling.row).map(|(c, r)| c * r).collect();
    let mut x = right.clone();
    lu.solve_vector(&mut x);
    for _ in 0..REFINEMENTS {
        let mut residual = right.clone();
        for (j, &x) in x.iter().enumerate() {
            let column = matrix.col_as_slice(j);
            residual.iter_mut().zip(column).for_each(|(r, a)| *r -= a * x);
        }
        let before = max_abs(&residual);
        lu.solve_vector(&mut residual);
        if !before.is_finite() || before == 0.0 {
            break;
        }
        x.iter_mut().zip(&residual).for_each(|(x, dx)| *x += dx);
    }
    Some(point(problem, scaling, basis, &x))
}

fn point(problem: &HorizontalLcp, scaling: &Equilibrated, basis: &Basis, x: &[f64]) -> Point {
    let n = problem.order();
    let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
    for (j, (&side, &x)) in basis.sides().iter().zip(x).enumerate() {
        let value = (x * scaling.factor(j, side)).max(0.0);
        match side {
            Side::T => t[j] = value,
            Side::Y => y[j] = value,
        }
    }
    let residuals = problem.residuals(&t, &y);
    Point { t, y, residuals }
}
