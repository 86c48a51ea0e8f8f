//! The step from a complementary basis to a point that is verified by the original data.

use super::basis_matrix::BasisMatrix;
use super::start::Equilibrated;
use crate::certify::Precision;
use crate::vector::{REFINEMENTS, max_abs};
use crate::{Basis, Residuals};

#[derive(Debug, Clone)]
pub(super) struct BasicPoint {
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) basis: Basis,
    pub(super) residuals: Residuals,
    pub(super) condition: f64,
    /// The pairs whose basic variable is negative and was set to zero.
    pub(super) negative: Vec<usize>,
}

impl BasicPoint {
    /// The basis with the other variable of every pair whose basic one is negative.
    pub(super) fn exchanged(&self) -> Basis {
        let mut sides = self.basis.sides().to_vec();
        self.negative.iter().for_each(|&pair| sides[pair] = sides[pair].complement());
        Basis::new(sides)
    }
}

/// Solves for the basic variables with the original columns, refines, and sets negative values to
/// zero; the residuals show values that are more than rounding errors.
pub(super) fn solve_basis(problem: &Equilibrated<'_>, basis: &Basis) -> Option<BasicPoint> {
    let matrix = BasisMatrix::new(problem, basis)?;
    let condition = matrix.condition();
    let x = refined(&matrix, &problem.right_hand_side());
    if !condition.is_finite() || x.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let n = problem.order();
    let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
    let mut sides = basis.sides().to_vec();
    let mut negative = Vec::new();
    for (j, (side, x)) in sides.iter_mut().zip(x).enumerate() {
        let mut value = x * problem.factor(j, *side);
        // A negative free variable is a positive one on the other side.
        if let Some(ratio) = problem.opposite[j].filter(|_| value < 0.0) {
            value = side.of(-value / ratio, -value * ratio);
            *side = side.complement();
        }
        side.of(&mut t, &mut y)[j] = value.max(0.0);
        negative.extend((value < 0.0).then_some(j));
    }
    let residuals = problem.judge.residuals(&[&t[..], &y], Precision::Exact);
    Some(BasicPoint { t, y, basis: Basis::new(sides), residuals, condition, negative })
}

/// The solution, refined with residuals of twice the digits.
fn refined(matrix: &BasisMatrix, right: &[f64]) -> Vec<f64> {
    let mut x = right.to_vec();
    matrix.solve(&mut x);
    // The part that rounding to `f64` omits.
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
    x
}
