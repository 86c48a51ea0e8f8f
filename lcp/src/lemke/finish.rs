//! From a complementary basis to a point that the original data vouches for.

use super::basis_matrix::BasisMatrix;
use super::start::Equilibrated;
use crate::problem::max_abs;
use crate::{Basis, Residuals, Side};

/// Steps of iterative refinement.
const REFINEMENTS: usize = 3;
/// With a condition number above this, residuals are computed with twice the working precision.
const ILL_CONDITIONED: f64 = 1e6;

/// A point and what the original data says of it.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) basis: Basis,
    pub(super) residuals: Residuals,
    pub(super) condition: f64,
}

impl Point {
    /// Whether the equation holds to this part of the right-hand side itself, in equilibrated rows. Far
    /// enough out nearly everything holds compared with the terms.
    pub(super) fn is_near(&self, problem: &Equilibrated<'_>, part: f64) -> bool {
        let mut rest = problem.problem.c().to_vec();
        for (side, x) in [(Side::T, &self.t), (Side::Y, &self.y)] {
            for (pair, &x) in x.iter().enumerate().filter(|(_, x)| **x > 0.0) {
                problem.problem.column(pair, side).add_to(-x, &mut rest);
            }
        }
        let rest: Vec<f64> = rest.iter().zip(&problem.row).map(|(rest, row)| rest * row).collect();
        max_abs(&rest) <= part * max_abs(&problem.right_hand_side())
    }
}

/// Solves for the basic variables with the original columns, refines, and sets negative values to
/// zero. How far that is more than rounding goes into the feasibility residual.
pub(super) fn solve_basis(problem: &Equilibrated<'_>, basis: &Basis) -> Option<Point> {
    let matrix = BasisMatrix::new(problem, basis)?;
    let right = problem.right_hand_side();
    let condition = matrix.condition();
    let x = refined(&matrix, &right, condition > ILL_CONDITIONED);
    if !condition.is_finite() || x.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let judged = |x: &[f64]| {
        let infeasibility = infeasibility(problem, &matrix, &right, x);
        let mut point = point(problem, basis, x, condition);
        point.residuals.feasibility = point.residuals.feasibility.max(infeasibility);
        point.residuals.natural = point.residuals.natural.max(infeasibility);
        point
    };
    let mut cleared = x.clone();
    let is_changed = drop_rounding(&matrix, &right, &mut cleared);
    let point = judged(&cleared);
    if !is_changed {
        return Some(point);
    }
    // With an ill-conditioned basis values of the solution too are smaller than those errors.
    let as_solved = judged(&x);
    let is_worse = point.residuals.worst() > as_solved.residuals.worst();
    Some(if is_worse { as_solved } else { point })
}

/// Sets to zero what rounding has left in place of zeros: values below the errors that rounding of the
/// data makes, and what refinement has made smaller and smaller without an end. Says whether there
/// were any.
fn drop_rounding(matrix: &BasisMatrix, right: &[f64], x: &mut [f64]) -> bool {
    let least = f64::EPSILON * f64::EPSILON * max_abs(x);
    let errors = matrix.errors(right, x);
    let mut is_changed = false;
    for (x, error) in x.iter_mut().zip(&errors) {
        if *x != 0.0 && x.abs() <= error.max(least) {
            *x = 0.0;
            is_changed = true;
        }
    }
    is_changed
}

fn refined(matrix: &BasisMatrix, right: &[f64], accurate: bool) -> Vec<f64> {
    let mut x = right.to_vec();
    matrix.solve(&mut x);
    let mut low = vec![0.0; x.len()];
    for _ in 0..REFINEMENTS {
        let mut step = if accurate {
            matrix.accurate_residual(right, &x, &low)
        } else {
            matrix.residual(right, &x)
        };
        let size = max_abs(&step);
        if !size.is_finite() || size == 0.0 {
            break;
        }
        matrix.solve(&mut step);
        for ((x, low), step) in x.iter_mut().zip(&mut low).zip(&step) {
            let sum = *x + (*low + step);
            *low = if accurate { (*low + step) - (sum - *x) } else { 0.0 };
            *x = sum;
        }
    }
    x
}

/// Negative values up to this multiple of the largest value, in equilibrated units, are rounding
/// errors, of the data if not of the solution.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The largest negative value beyond rounding, each relative to the size that its variable could have
/// by the data: row `j` of `|M^-1| (|M||x| + |c|)`. So a negative value is not forgiven because others
/// are large.
fn infeasibility(
    problem: &Equilibrated<'_>,
    matrix: &BasisMatrix,
    right: &[f64],
    x: &[f64],
) -> f64 {
    let rounding = ROUNDING * max_abs(x);
    let negative = (0..x.len()).filter(|&j| x[j] < -rounding && problem.opposite(j).is_none());
    let size = matrix.sizes(right, x);
    let relative = negative.map(|j| {
        let mut row = vec![0.0; x.len()];
        row[j] = 1.0;
        matrix.solve_transpose(&mut row);
        let bound: f64 = row.iter().zip(&size).map(|(v, size)| v.abs() * size).sum();
        if bound > 0.0 { -x[j] / bound } else { f64::INFINITY }
    });
    relative.fold(0.0, f64::max)
}

/// The pairs; a negative free variable is a positive one on the other side.
fn point(problem: &Equilibrated<'_>, basis: &Basis, x: &[f64], condition: f64) -> Point {
    let n = problem.order();
    let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
    let mut sides = basis.sides().to_vec();
    for (j, (side, &x)) in sides.iter_mut().zip(x).enumerate() {
        let mut value = x * problem.factor(j, *side);
        if let Some(ratio) = problem.opposite(j).filter(|_| value < 0.0) {
            value = if *side == Side::T { -value / ratio } else { -value * ratio };
            *side = side.complement();
        }
        match side {
            Side::T => t[j] = value.max(0.0),
            Side::Y => y[j] = value.max(0.0),
        }
    }
    let residuals = problem.problem.residuals(&t, &y);
    Point { t, y, basis: Basis::new(sides), residuals, condition }
}
