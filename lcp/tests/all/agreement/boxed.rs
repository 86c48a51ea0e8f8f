//! Problems with bounds: the sweeps against Lemke's method on the general form.

use faer::{Mat, Side as Triangle};
use lcp::{BoxedLcp, Solver};
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::cases;
use super::measure::{ROUNDING, norm, sparse, times, worst_of_boxed};
use super::routes::{TOLERANCES, lemke, sweeps};

/// Symmetric positive definite, with variables planted at bounds, between them, free and fixed.
fn planted() -> impl Strategy<Value = (BoxedLcp, Vec<f64>, Vec<f64>)> {
    (1..=12_usize, any::<bool>()).prop_flat_map(|(n, is_sparse)| {
        let variables = vec((0..6_u8, -3..=3_i8, 1..=3_i8, any::<bool>()), n);
        (vec(-2..=2_i8, n * n), variables).prop_map(move |(entries, variables)| {
            let c = Mat::from_fn(n, n, |i, j| f64::from(entries[i * n + j]));
            let m = &c * c.transpose() + Mat::<f64>::identity(n, n);
            let (mut lower, mut upper) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
            let (mut z, mut w) = (vec![0.0; n], vec![0.0; n]);
            for (i, (state, value, size, is_degenerate)) in variables.into_iter().enumerate() {
                let (value, size) = (f64::from(value), f64::from(size));
                z[i] = value;
                let push = if is_degenerate { 0.0 } else { size };
                match state {
                    0 => {}
                    1 => (lower[i], w[i]) = (value, push),
                    2 => (upper[i], w[i]) = (value, -push),
                    3 => (lower[i], upper[i], w[i]) = (value, value + size, push),
                    4 => (lower[i], upper[i]) = (value - size, value + size),
                    _ => {
                        (lower[i], upper[i], w[i]) =
                            (value, value, if size > 2.0 { -push } else { push });
                    }
                }
            }
            let q: Vec<f64> = times(&m, &z).iter().zip(&w).map(|(mz, w)| w - mz).collect();
            let m = if is_sparse { sparse(&m) } else { m.into() };
            (BoxedLcp::new(m, q, lower, upper).unwrap(), z, w)
        })
    })
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn boxed_problems((boxed, expected, w) in planted()) {
        // Where all pairs vanish there is nothing to measure them by but the rounding of the bounds, which
        // the sweeps do not get below.
        let (t, y) = boxed.to_pairs(&expected, &w);
        prop_assume!(t.iter().chain(&y).any(|v| *v > 0.0));
        let m = boxed.m().to_dense();
        let eigenvalues = m.self_adjoint_eigenvalues(Triangle::Lower).unwrap();
        let modulus = eigenvalues.into_iter().fold(f64::INFINITY, f64::min);
        let n = boxed.order();
        for tolerance in TOLERANCES {
            let answers = [
                lemke(tolerance).solve(&boxed).unwrap(),
                sweeps(tolerance).solve(&boxed).unwrap(),
            ];
            for solution in answers {
                let solver = solution.info.method;
                prop_assert!(solution.is_solved(), "{solver}: {:?} {:?}", solution.status, solution.residuals);
                let (z, w) = boxed.recover(&solution.t, &solution.y);
                let worst = worst_of_boxed(&boxed, &z, &w);
                prop_assert!(worst <= ROUNDING * tolerance, "{solver}: {worst:e}");
                // `|e| modulus <= |change of q|`, where every row may lack its share of the residual.
                let (z, w) = boxed.recover(&solution.t, &solution.y);
                let size = |i: usize| {
                    let terms = (0..n).map(|j| (m[(i, j)] * z[j]).abs()).sum::<f64>();
                    terms + boxed.q()[i].abs() + w[i].abs() + (0..n).map(|j| m[(i, j)].abs()).sum::<f64>() * 6.0
                };
                let change: Vec<f64> = (0..n).map(|i| 3.0 * tolerance * size(i)).collect();
                let error: Vec<f64> = z.iter().zip(&expected).map(|(a, b)| a - b).collect();
                let bound = norm(&change) / modulus;
                prop_assert!(norm(&error) <= bound, "{solver}: {:e} > {bound:e}", norm(&error));
            }
        }
    }
}
