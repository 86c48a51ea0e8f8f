//! Matrices near singular ones, with answers that are exact for the data as they are.

use lcp::faer::Mat;

use super::case::Case;
use super::data::{Point, hilbert, ill_conditioned, strict, with_solution};

pub const TITLE: &str = "Condition";

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    let why = "The solution depends on digits that elimination loses; data and solution are integers, without rounding errors.";
    for (n, condition) in [(6, 1e7), (10, 1e13), (14, 1e18)] {
        let point = strict(n);
        list.push(
            Case::new(&format!("Hilbert, order {n}"), why, with_solution(hilbert(n), &point))
                .parameters(&format!(
                    "`h_ij = c / (i + j - 1)`, `c` the common denominator: condition number {condition:e}"
                ))
                .unique(point, condition),
        );
    }
    let point = strict(12);
    list.push(
        Case::new("condition 1e12", why, with_solution(ill_conditioned(12, 40), &point))
            .parameters("`L D L^T`, n = 12: `L` has ones on the diagonal and in its first column, and `s_ij` elsewhere below; `d_k = 2^-r`, `r` the integer next to `40 k / 11`")
            .unique(point, 1e14),
    );
    let why = "A P-matrix with very small principal minors.";
    for (bits, minor, condition) in [(20, "1e-6", 1e14), (43, "1e-13", 1e20)] {
        let point = of_minors();
        list.push(
            Case::new(&format!("minors of {minor}"), why, with_solution(minors(bits), &point))
                .parameters(&format!(
                    "blocks `[1 a; 1/a 1 + 2^-{bits}]` with `a` = 1, 2, -1 on the diagonal, `s_ij` above them, n = 6; `z = (1, 2, 0, 3, 2, 1)` and `w_2 = 2` are planted"
                ))
                .unique(point, condition),
        );
    }
    list
}

/// An answer to the problem with small minors.
pub(super) fn of_minors() -> Point {
    (vec![1.0, 2.0, 0.0, 3.0, 2.0, 1.0], vec![0.0, 0.0, 2.0, 0.0, 0.0, 0.0])
}

/// Block triangular, so that principal minors are products of those of the blocks.
pub(super) fn minors(bits: i32) -> Mat<f64> {
    let a = [1.0, 2.0, -1.0];
    Mat::from_fn(6, 6, |i, j| match (i / 2, j / 2) {
        (block, other) if block > other => 0.0,
        (block, other) if block < other => super::data::sign(i, j),
        (block, _) => match (i % 2, j % 2) {
            (0, 0) => 1.0,
            (0, _) => a[block],
            (_, 0) => 1.0 / a[block],
            _ => 1.0 + 2_f64.powi(-bits),
        },
    })
}
