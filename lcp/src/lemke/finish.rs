//! From a complementary basis to a point that the original data vouches for.

use faer::Mat;

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
/// zero. How far that is more than rounding goes into the feasibility residual.
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
    if x.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let infeasibility = infeasibility(&matrix, &lu, &right, &x);
    let mut point = point(problem, scaling, basis, &x);
    point.residuals.feasibility = point.residuals.feasibility.max(infeasibility);
    point.residuals.natural = point.residuals.natural.max(infeasibility);
    Some(point)
}

/// Negative values up to this multiple of the largest value, in equilibrated units, are rounding
/// errors, of the data if not of the solution.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The largest negative value beyond rounding, each relative to the size that its variable could have
/// by the data: row `j` of `|M^-1| (|M||x| + |c|)`. So a negative value is not forgiven because others
/// are large.
fn infeasibility(matrix: &Mat<f64>, lu: &Lu, right: &[f64], x: &[f64]) -> f64 {
    let rounding = ROUNDING * max_abs(x);
    let negative: Vec<usize> = (0..x.len()).filter(|&j| x[j] < -rounding).collect();
    let mut size: Vec<f64> = right.iter().map(|c| c.abs()).collect();
    for (j, x) in x.iter().enumerate() {
        let column = matrix.col_as_slice(j);
        size.iter_mut().zip(column).for_each(|(size, a)| *size += (a * x).abs());
    }
    let mut inverse_rows = Mat::zeros(x.len(), negative.len());
    negative.iter().enumerate().for_each(|(k, &j)| inverse_rows[(j, k)] = 1.0);
    lu.solve_transpose_in_place(inverse_rows.as_mut());
    let relative = negative.iter().enumerate().map(|(k, &j)| {
        let row = inverse_rows.col_as_slice(k);
        let bound: f64 = row.iter().zip(&size).map(|(v, size)| v.abs() * size).sum();
        if bound > 0.0 { -x[j] / bound } else { f64::INFINITY }
    });
    relative.fold(0.0, f64::max)
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
