//! From a complementary basis to a point that the original data vouches for.

use super::basis_matrix::BasisMatrix;
use super::constants::{HIDDEN, REFINEMENTS};
use super::start::Equilibrated;
use crate::certify::Precision;
use crate::extended::{Extended, extended};
use crate::vector::max_abs;
use crate::{Basis, Residuals, Side};

/// A point and what the original data says of it.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) basis: Basis,
    pub(super) residuals: Residuals,
    pub(super) condition: f64,
    /// The pairs whose basic variable is negative, and was set to zero.
    pub(super) negative: Vec<usize>,
}

impl Point {
    /// The basis with the other variable of every pair whose basic one is negative.
    pub(super) fn exchanged(&self) -> Basis {
        let mut sides = self.basis.sides().to_vec();
        self.negative.iter().for_each(|&pair| sides[pair] = sides[pair].complement());
        Basis::new(sides)
    }
}

/// Solves for the basic variables with the original columns, refines, and sets negative values to
/// zero, which the residuals see where it is more than rounding.
///
/// Where the terms of the equations hide what is left of the right-hand side, that is measured on the values of
/// the basis with twice the digits: these leave nothing if the basis is regular, and its point is the solution
/// however large it is.
pub(super) fn solve_basis(problem: &Equilibrated<'_>, basis: &Basis) -> Option<Point> {
    let matrix = BasisMatrix::new(problem, basis)?;
    let right = problem.right_hand_side();
    let condition = matrix.condition();
    let (x, low) = refined(&matrix, &right);
    if !condition.is_finite() || x.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let judged = |x: &[f64]| {
        let values = Values::new(problem, basis, x);
        let point = [&values.t[..], &values.y];
        let mut residuals = problem.judge.residuals(&point, Precision::Exact);
        if residuals.loads > HIDDEN && residuals.equation.max(residuals.natural) <= HIDDEN {
            let exact = values.exact_loads(problem, basis, &low);
            let rounded = problem.judge.residuals(&point, Precision::Rounded).loads;
            residuals.loads = residuals.loads.min(exact.max(rounded));
        }
        let Values { t, y, sides, negative } = values;
        Point { t, y, basis: Basis::new(sides), residuals, condition, negative }
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

/// The solution, and what its rounding to `f64` leaves out, from residuals with twice the digits.
fn refined(matrix: &BasisMatrix, right: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut x = right.to_vec();
    matrix.solve(&mut x);
    let mut low = vec![0.0; x.len()];
    for _ in 0..REFINEMENTS {
        let mut step = matrix.residual(right, &x, &low);
        matrix.solve(&mut step);
        for ((x, low), step) in x.iter_mut().zip(&mut low).zip(&step) {
            let sum = *x + (*low + step);
            *low = (*low + step) - (sum - *x);
            *x = sum;
        }
        let size = max_abs(&step);
        if !size.is_finite() || size <= f64::EPSILON * max_abs(&x) {
            break;
        }
    }
    (x, low)
}

/// The pairs of a basis, in units of the problem.
struct Values {
    t: Vec<f64>,
    y: Vec<f64>,
    sides: Vec<Side>,
    negative: Vec<usize>,
}

impl Values {
    /// From the basic variables in equilibrated units. A negative free variable is a positive one on the other
    /// side; what else is negative is set to zero.
    fn new(problem: &Equilibrated<'_>, basis: &Basis, x: &[f64]) -> Self {
        let n = problem.order();
        let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
        let mut sides = basis.sides().to_vec();
        let mut negative = Vec::new();
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
            negative.extend((value < 0.0).then_some(j));
        }
        Self { t, y, sides, negative }
    }

    /// What is left of the loads with the digits of the basic variables that rounding left out.
    fn exact_loads(&self, problem: &Equilibrated<'_>, basis: &Basis, low: &[f64]) -> f64 {
        let (mut t, mut y) = (extended(&self.t), extended(&self.y));
        for (j, (side, &low)) in self.sides.iter().zip(low).enumerate() {
            // One that was set to zero stays there.
            let value = match side {
                Side::T => &mut t[j],
                Side::Y => &mut y[j],
            };
            let is_turned = *side != basis.sides()[j];
            if value.rounded() > 0.0 && !is_turned {
                *value += Extended::from(low * problem.factor(j, *side));
            } else if let Some(ratio) = problem.opposite(j).filter(|_| is_turned) {
                let low = -low * problem.factor(j, side.complement());
                let low = if *side == Side::Y { low / ratio } else { low * ratio };
                *value += Extended::from(low);
            }
        }
        problem.judge.residuals_of(&[&t, &y]).loads
    }
}
