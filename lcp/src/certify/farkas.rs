//! Proofs that there is no solution.
//!
//! `A t + B y = c` has no solution with `t >= 0` and `y >= 0` exactly if some `pi` has `A^T pi <= 0`, `B^T pi <= 0` and
//! `c.pi > 0` (Farkas' lemma).

use crate::extended::Extended;
use crate::matrix::{Column, DATA_ROUNDING};
use crate::vector::WEAK;
use crate::{HorizontalLcp, MixedLcp};

/// Whether a vector proves that the linear conditions of a problem have no solution.
pub(crate) fn is_proof(problem: &HorizontalLcp, pi: &[f64]) -> bool {
    is_proof_of(problem.columns(), problem.c(), pi)
}

/// Whether `pi . a <= 0` for all columns and `pi . c > 0`, so that no nonnegative combination of the
/// columns gives `c` (Farkas 1902).
pub(crate) fn is_proof_of<'a>(
    columns: impl IntoIterator<Item = Column<'a>>,
    c: &[f64],
    pi: &[f64],
) -> bool {
    separates(columns.into_iter().map(|column| Product::of(column, pi)), c, pi)
}

/// Whether a vector is a proof for a mixed problem, whose general form is not assembled.
pub(crate) fn is_proof_of_mixed(problem: &MixedLcp, pi: &[f64]) -> bool {
    // `w - M z = q`; the positive and the negative part of a free `z` take the place of `z` and `w`.
    let products = problem.free().iter().enumerate().flat_map(|(j, is_free)| {
        let of_z = Product::of(problem.m().slice(j), pi);
        let of_w = Product { sum: pi[j], size: pi[j].abs(), terms: 1.0 };
        [Product { sum: -of_z.sum, ..of_z }, if *is_free { of_z } else { of_w }]
    });
    separates(products, problem.q(), pi)
}

/// Whether the products of `pi` with the columns are a proof. The products may be positive by rounding errors of `pi`,
/// relative to their terms, if `pi . c` is far above these errors.
fn separates(products: impl Iterator<Item = Product>, c: &[f64], pi: &[f64]) -> bool {
    if pi.len() != c.len() || pi.iter().any(|pi| !pi.is_finite()) {
        return false;
    }
    let gap = Product::of(Column::Dense(c), pi);
    let mut rounding = gap.rounding();
    for product in products {
        let Product { sum, size, .. } = product;
        if !size.is_finite() || sum > DATA_ROUNDING.max(product.rounding()) * size {
            return false;
        }
        if sum > 0.0 {
            rounding = rounding.max(sum / size);
        }
    }
    gap.size.is_finite() && WEAK * gap.sum > rounding * gap.size
}

/// The product with a column in twice the digits, the sum of the sizes of its terms, and their number.
#[derive(Clone, Copy)]
struct Product {
    sum: f64,
    size: f64,
    terms: f64,
}

impl Product {
    fn of(column: Column<'_>, pi: &[f64]) -> Self {
        let (mut sum, mut size, mut terms) = (Extended::ZERO, 0.0, 0.0);
        column.for_each(|i, v| {
            if v != 0.0 && pi[i] != 0.0 {
                sum += Extended::product(v, pi[i]);
                size += (v * pi[i]).abs();
                terms += 1.0;
            }
        });
        Self { sum: sum.rounded(), size, terms }
    }

    /// The largest rounding error of the numbers of a vector, relative to the size.
    fn rounding(self) -> f64 {
        f64::EPSILON * self.terms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn says(columns: &[[f64; 2]], c: [f64; 2], pi: [f64; 2]) -> bool {
        is_proof_of(columns.iter().map(|column| Column::Dense(column)), &c, &pi)
    }

    #[test]
    fn a_proof_separates_the_columns_from_the_right_hand_side() {
        let columns = [[1.0, -1.0], [-1.0, 0.0]];
        assert!(says(&columns, [1.0, 1.0], [1.0, 1.0]));
        assert!(!says(&columns, [-1.0, 1.0], [1.0, 1.0]));
        assert!(!says(&columns, [1.0, 1.0], [1.0, 0.0]));
        assert!(!says(&columns, [1.0, 1.0], [0.0, 0.0]));
        assert!(!says(&columns, [1.0, 1.0], [f64::NAN, 1.0]));
    }

    /// A gap of 1e-9 is a proof if the products with the columns vanish, and not otherwise.
    #[test]
    fn a_small_gap_asks_for_exact_products() {
        let c = [-1.0, 1.0 + 1e-9];
        assert!(says(&[[1.0, -1.0], [-1.0, 1.0]], c, [1.0, 1.0]));
        assert!(!says(&[[1.0, -1.0 + 1e-12], [-1.0, 1.0]], c, [1.0, 1.0]));
    }

    #[test]
    fn overflow_proves_nothing() {
        assert!(!says(&[[-1e200, 0.0]], [1e200, 1.0], [1e200, 1.0]));
    }
}
