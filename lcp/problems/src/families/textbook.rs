//! Named problems of the literature.

use std::cmp::Ordering;

use faer::{Mat, mat};

use super::{Instance, KnownAnswer, standard, with_solution};
use crate::sparse;
use lcp::Lcp;

/// Ones on the diagonal and twos below it, `q = -1` (Murty, Mathematical Programming Study 7, 1978):
/// the solution is the first unit vector, and Lemke's method needs `2^n` pivots to reach it with a
/// covering vector of ones and the lexicographic rule.
pub fn murty(n: usize) -> Instance<Lcp> {
    first_unit_vector(murty_matrix(n))
}

/// `M = L L^T` with Murty's matrix `L`, `q = -1` (Fathi, Mathematical Programming 17, 1979): the same
/// number of pivots with a symmetric positive definite matrix.
pub fn fathi(n: usize) -> Instance<Lcp> {
    let l = murty_matrix(n);
    first_unit_vector(&l * l.transpose())
}

fn murty_matrix(n: usize) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| match i.cmp(&j) {
        Ordering::Less => 0.0,
        Ordering::Equal => 1.0,
        Ordering::Greater => 2.0,
    })
}

/// The problem `q = -1` for a first column with 1 on top and 2 below: the first unit vector solves
/// it.
fn first_unit_vector(m: Mat<f64>) -> Instance<Lcp> {
    let n = m.nrows();
    let unit = |i: usize, value: f64| if i == 0 { value } else { 0.0 };
    let t: Vec<f64> = (0..n).map(|i| unit(i, 1.0)).collect();
    let y: Vec<f64> = (0..n).map(|i| 1.0 - unit(i, 1.0)).collect();
    Instance { problem: standard(m, vec![-1.0; n]), known: KnownAnswer::Unique { t, y } }
}

/// A P-matrix of order 3, `q = -1`, on which the ratio test without a rule for ties cycles (Kostreva
/// 1979).
pub fn kostreva_1() -> Instance<Lcp> {
    let m = mat![[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]];
    let known = KnownAnswer::Unique { t: vec![1.0 / 3.0; 3], y: vec![0.0; 3] };
    Instance { problem: standard(m, vec![-1.0; 3]), known }
}

/// A problem of order 3 without a solution: the last row has no positive entry (Kostreva 1979).
pub fn kostreva_2() -> Instance<Lcp> {
    let m = mat![[1.0, -1.0, 3.0], [2.0, -1.0, 3.0], [-1.0, -2.0, 0.0]];
    let known = KnownAnswer::Infeasible { farkas: vec![0.0, 0.0, -1.0] };
    Instance { problem: standard(m, vec![-1.0; 3]), known }
}

/// A membrane over an obstacle on a square grid of `side` by `side` points: the five-point Laplacian,
/// sparse.
///
/// The gap `z` is a paraboloid over a disc in the middle; outside of it the membrane lies on the
/// obstacle, and the contact pressure `w` is 1.
pub fn obstacle(side: usize) -> Instance<Lcp> {
    let n = side * side;
    let neighbours = |i: usize| {
        let (row, column) = (i / side, i % side);
        let below = (row + 1 < side).then_some((i, i + side));
        let beside = (column + 1 < side).then_some((i, i + 1));
        below.into_iter().chain(beside).flat_map(|(i, j)| [(i, j, -1.0), (j, i, -1.0)])
    };
    let entries = (0..n).flat_map(|i| neighbours(i).chain([(i, i, 4.0)]));
    let m = sparse(n, n, entries);
    // Coordinates from the middle, in half steps: integers.
    let coordinate = |k: usize| 2.0 * k as f64 + 1.0 - side as f64;
    let radius_squared = (side * side / 2) as f64;
    let height = |i: usize| {
        let (x, y) = (coordinate(i / side), coordinate(i % side));
        radius_squared - (x * x + y * y)
    };
    let t: Vec<f64> = (0..n).map(|i| height(i).max(0.0)).collect();
    let y: Vec<f64> = (0..n).map(|i| if height(i) > 0.0 { 0.0 } else { 1.0 }).collect();
    Instance { problem: with_solution(m, &t, &y), known: KnownAnswer::Unique { t, y } }
}
