//! Rows and blocks of very different sizes, none of which may hide behind another.

use faer::{Mat, mat};
use lcp::{HorizontalLcp, Lcp};
use proptest::prelude::*;

use super::common::cases;
use super::draw::Draw;
use super::{assert_near, only, solved};

#[test]
fn a_row_with_a_large_coefficient() {
    let lcp = Lcp::new(mat![[1e14, 0.0], [0.0, 1.0]], vec![-2.0, -1.0]).unwrap();
    // The first row misses by all of its right-hand side.
    assert!(lcp.residuals(&[0.0, 1.0], &[0.0, 0.0]).worst() > 0.5);
    for (name, solution) in solved(&lcp) {
        assert_near(name, &solution.t, &[2e-14, 1.0], 0.0);
    }
}

/// The second variable is missing, and `w_2 = -size` all that is left of its row. That it is a small part of the first
/// row, too, is no excuse.
#[test]
fn a_small_load_beside_a_large_one() {
    for coupling in [0.0_f64, 1e-6, 1.0, 1e6] {
        let m = mat![[3.0, coupling], [0.0, 3.0]];
        // Smaller ones are rounding errors of what the larger one makes of the row.
        let sizes = (-20..=0).map(|exponent| 10_f64.powi(exponent));
        for size in sizes.filter(|size| *size >= 1e-13 * 9e6 * coupling.max(1e-6)) {
            let lcp = Lcp::new(m.clone(), vec![-9e6, -size]).unwrap();
            let worst = lcp.residuals(&[3e6, 0.0], &[0.0, -size]).worst();
            assert!(worst > 1e-6, "{worst:e} with {coupling:e}, {size:e}");
        }
    }
}

/// `M = -1, 2, -1`.
fn chain(n: usize) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    })
}

/// Two chains that have nothing to do with each other, the second with another right-hand side.
fn assert_chains_are_solved(q: [&[f64]; 2]) {
    let n = q[0].len();
    let coupled = |i: usize, j: usize| if i / n == j / n { chain(n)[(i % n, j % n)] } else { 0.0 };
    let lcp = Lcp::new(Mat::from_fn(2 * n, 2 * n, coupled), q.concat()).unwrap();
    let alone = q.map(|q| only(&HorizontalLcp::from(Lcp::new(chain(n), q.to_vec()).unwrap())));
    for (name, solution) in solved(&lcp) {
        for ((found, exact), q) in solution.t.chunks(n).zip(&alone).zip(q) {
            let largest = q.iter().fold(0.0_f64, |max, q| max.max(q.abs()));
            assert_near(name, found, exact, largest);
        }
    }
}

/// The numbers are those of the file, to fewer digits.
#[test]
fn two_blocks_of_scales_one_and_a_trillion() {
    let small = [3.857, 3.283, -4.621, 0.619, 0.077, 1.635, 0.626, -1.506];
    let large =
        [0.586e12, 0.471e12, -0.146e12, -5.557e12, -8.986e12, -2.371e12, -4.904e12, 0.758e12];
    assert_chains_are_solved([&small, &large]);
}

/// Positive definite, small integers.
fn definite(draw: &mut Draw, n: usize) -> Mat<f64> {
    let c = Mat::from_fn(n, n, |_, _| draw.number(-2, 2));
    &c * c.transpose() + Mat::<f64>::identity(n, n)
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn blocks_of_any_scales(seed in any::<u64>(), scale in -18..=18_i32) {
        let draw = &mut Draw::new(seed);
        let mut q = || -> Vec<f64> { (0..5).map(|_| draw.number(-9, 9)).collect() };
        let small = q();
        let large: Vec<f64> = q().iter().map(|q| q * 10_f64.powi(scale)).collect();
        assert_chains_are_solved([&small, &large]);
    }

    /// Rows in units of their own: the solution does not change.
    #[test]
    fn rows_of_any_scales(seed in any::<u64>()) {
        let draw = &mut Draw::new(seed);
        let n = 1 + draw.index(5);
        let m = definite(draw, n);
        let q: Vec<f64> = (0..n).map(|_| draw.number(-9, 9)).collect();
        let exact = only(&HorizontalLcp::from(Lcp::new(m.clone(), q.clone()).unwrap()));
        let row: Vec<f64> = (0..n).map(|_| draw.power(46)).collect();
        let scaled = Mat::from_fn(n, n, |i, j| row[i] * m[(i, j)]);
        let lcp = Lcp::new(scaled, q.iter().zip(&row).map(|(q, row)| q * row).collect::<Vec<f64>>()).unwrap();
        for (name, solution) in solved(&lcp) {
            assert_near(name, &solution.t, &exact, 1.0);
        }
    }
}
