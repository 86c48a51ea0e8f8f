//! Mixed and boxed problems: their solutions by their own definition, and the way there and back.

use crate::common;

use common::cases;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, mat};
use lcp::{BoxedLcp, Error, Lcp, Lemke, Matrix, MixedLcp, Monotonicity, Solver, Status};
use proptest::collection::vec;
use proptest::prelude::*;

const INF: f64 = f64::INFINITY;

/// `C C^T + 1 + S` with a skew `S`: positive definite, not symmetric.
fn monotone(n: usize, c: &[f64]) -> Mat<f64> {
    let c = Mat::from_fn(n, n, |i, j| c[i * n + j]);
    let skew = &c - c.transpose();
    &c * c.transpose() + Mat::<f64>::identity(n, n) + skew
}

/// Free, bounded below, above, on both sides, and fixed.
fn bounds() -> impl Strategy<Value = (f64, f64)> {
    let at = || (-4..=4_i8).prop_map(f64::from);
    prop_oneof![
        Just((-INF, INF)),
        at().prop_map(|l| (l, INF)),
        at().prop_map(|u| (-INF, u)),
        (at(), 1..4_u8).prop_map(|(l, d)| (l, l + f64::from(d))),
        at().prop_map(|z| (z, z)),
    ]
}

type Data = (Vec<f64>, Vec<f64>, Vec<(f64, f64)>);

fn data() -> impl Strategy<Value = Data> {
    (1..8_usize).prop_flat_map(|n| {
        let integer = || (-3..=3_i8).prop_map(f64::from);
        (vec(integer(), n * n), vec(integer(), n), vec(bounds(), n))
    })
}

fn product(m: &Mat<f64>, z: &[f64]) -> Vec<f64> {
    (0..z.len()).map(|i| (0..z.len()).map(|j| m[(i, j)] * z[j]).sum()).collect()
}

fn sparse(m: &Mat<f64>) -> Matrix {
    let n = m.nrows();
    let places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triplets: Vec<_> = places
        .filter(|&place| m[place] != 0.0)
        .map(|(i, j)| Triplet::new(i, j, m[(i, j)]))
        .collect();
    SparseColMat::try_new_from_triplets(n, n, &triplets).unwrap().into()
}

proptest! {
    #![proptest_config(cases(256))]

    /// `z = mid(lower, z - w, upper)` with `w = M z + q` characterises the solution, which is unique.
    #[test]
    fn boxed_problems_by_definition((c, q, bounds) in data(), is_sparse in any::<bool>()) {
        let n = q.len();
        let m = monotone(n, &c);
        let (lower, upper): (Vec<f64>, Vec<f64>) = bounds.into_iter().unzip();
        let stored = if is_sparse { sparse(&m) } else { Matrix::from(m.clone()) };
        let boxed = BoxedLcp::new(stored, q.clone(), lower.clone(), upper.clone()).unwrap();
        let solution = Lemke::default().solve(&boxed.to_general()).unwrap();
        prop_assert_eq!(solution.status, Status::Solved);
        let (z, w) = boxed.recover(&solution.t, &solution.y);
        let size = 1.0 + z.iter().fold(0.0_f64, |max, z| max.max(z.abs()));
        let image = product(&m, &z);
        for i in 0..n {
            prop_assert!((image[i] + q[i] - w[i]).abs() <= 1e-9 * size, "row {}", i);
            let projected = (z[i] - w[i]).clamp(lower[i], upper[i]);
            prop_assert!((projected - z[i]).abs() <= 1e-9 * size, "{}: {} {}", i, z[i], w[i]);
        }
        // Of the problem itself: in pairs, distances to bounds have the rounding errors of these.
        let own = Lemke::default().solve(&boxed).unwrap();
        let (own_z, own_w) = boxed.variables(&own);
        prop_assert!(own.is_solved() && boxed.residuals(&own_z, &own_w).worst() <= 1e-9);
        prop_assert!(own_z.iter().zip(&z).all(|(a, b)| (a - b).abs() <= 1e-9 * size));
        let (t, y) = boxed.to_pairs(&z, &w);
        for (a, b) in t.iter().zip(&solution.t).chain(y.iter().zip(&solution.y)) {
            prop_assert!((a - b).abs() <= 1e-9 * size);
        }
    }

    /// A mixed problem is a boxed one whose bounds are zero or infinite, whatever its free block: here
    /// that of the free variables is zero, as in a saddle point.
    #[test]
    fn mixed_problems_with_a_zero_block(
        (n, k, c, q) in (1..6_usize, 0..4_usize).prop_flat_map(|(n, k)| {
            let k = k.min(n);
            let integer = || (-3..=3_i8).prop_map(f64::from);
            (Just(n), Just(k), vec(integer(), n * n + n * k), vec(integer(), n + k))
        })
    ) {
        // [0, -R; R^T, M] with R of full rank k: [1 0 ...] plus noise below the diagonal.
        let m = monotone(n, &c[..n * n]);
        let r = Mat::from_fn(k, n, |i, j| match i.cmp(&j) {
            std::cmp::Ordering::Equal => 1.0,
            std::cmp::Ordering::Less => c[n * n + i * n + j],
            std::cmp::Ordering::Greater => 0.0,
        });
        let full = Mat::from_fn(k + n, k + n, |i, j| match (i < k, j < k) {
            (true, true) => 0.0,
            (true, false) => -r[(i, j - k)],
            (false, true) => r[(j, i - k)],
            (false, false) => m[(i - k, j - k)],
        });
        let free: Vec<bool> = (0..k + n).map(|i| i < k).collect();
        let mixed = MixedLcp::new(full.clone(), q.clone(), free).unwrap();
        let solution = Lemke::default().solve(&mixed.to_general()).unwrap();
        // Feasible only if R v = -q has a nonnegative solution; monotone, so that it is decided.
        prop_assert!(matches!(solution.status, Status::Solved | Status::Infeasible), "{:?}", solution.status);
        if solution.is_solved() {
            let (z, w) = mixed.recover(&solution.t, &solution.y);
            prop_assert!(mixed.residuals(&z, &w).worst() <= 1e-9);
            let size = 1.0 + z.iter().fold(0.0_f64, |max, z| max.max(z.abs()));
            for (i, image) in product(&full, &z).into_iter().enumerate() {
                let w_i = image + q[i];
                let rest = if i < k { w_i } else { z[i].min(w_i) };
                prop_assert!(rest.abs() <= 1e-9 * size, "row {}", i);
            }
        }
    }
}

proptest! {
    #![proptest_config(cases(256))]

    /// The bound holds for any point, and for a solution it is at rounding level.
    #[test]
    fn error_bounds_hold((c, q, _) in data(), shifts in vec(-1.0..1.0_f64, 8), exponent in 0..12_i32) {
        let n = q.len();
        let lcp = Lcp::new(monotone(n, &c), q.clone()).unwrap();
        let is_strong = matches!(lcp.monotonicity(), Monotonicity::Strong { modulus } if modulus > 0.9);
        prop_assert!(is_strong);
        let solution = Lemke::default().solve(&lcp).unwrap().t;
        let size = 1.0 + solution.iter().fold(0.0_f64, |max, z| max.max(z.abs()));
        prop_assert!(lcp.error_bound(&solution).unwrap().distance.unwrap() <= 1e-11 * size);
        let step = 10.0_f64.powi(-exponent);
        let near: Vec<f64> =
            solution.iter().zip(&shifts).map(|(z, shift)| (z + step * shift).max(0.0)).collect();
        let error = solution.iter().zip(&near).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        let bound = lcp.error_bound(&near).unwrap().distance.unwrap();
        prop_assert!(error <= bound + 1e-13 * size, "{} > {}", error, bound);
    }
}

#[test]
fn monotonicity_is_told() {
    let of = |m: Mat<f64>| Lcp::new(m, vec![0.0, 0.0]).unwrap().monotonicity();
    assert!(matches!(of(mat![[2.0, 5.0], [-5.0, 1.0]]), Monotonicity::Strong { .. }));
    assert_eq!(of(mat![[1.0, 1.0], [1.0, 1.0]]), Monotonicity::Weak);
    assert_eq!(of(mat![[0.0, 1.0], [-1.0, 0.0]]), Monotonicity::Weak);
    assert_eq!(of(mat![[1.0, 2.0], [2.0, 1.0]]), Monotonicity::None);
}

#[test]
fn misuse_is_an_error() {
    let one = || Mat::<f64>::identity(1, 1);
    let with = |lower, upper| BoxedLcp::new(one(), vec![0.0], vec![lower], vec![upper]);
    for (lower, upper) in [(1.0, 0.0), (INF, INF), (-INF, -INF), (f64::NAN, 1.0), (-1e308, 1e308)] {
        assert!(matches!(with(lower, upper), Err(Error::Bounds { index: 0, .. })));
    }
    let message = with(1.0, 0.0).unwrap_err().to_string();
    assert!(message.starts_with("variable 0 is to be between 1.0 and 0.0"), "{message}");
    assert!(MixedLcp::new(one(), vec![0.0], vec![]).is_err());
}

/// The `w` of a free variable must be zero.
#[test]
fn a_free_variable_with_a_force_is_no_solution() {
    let mixed = MixedLcp::new(Mat::<f64>::identity(1, 1), vec![-1.0], vec![true]).unwrap();
    assert!(mixed.residuals(&[1.0], &[0.0]).worst() <= 0.0);
    assert!(mixed.residuals(&[2.0], &[1.0]).worst() > 0.1);
}

/// Data whose sums leave the range of numbers are refused where they come in: no method can judge them.
#[test]
fn sums_that_overflow_are_errors() {
    let refused = |what: &'static str| {
        move |error: Error| {
            let text = error.to_string();
            assert!(matches!(error, Error::Overflow { row: 1, .. }), "{text}");
            assert!(text.contains(what) && text.contains("choose units"), "{text}");
        }
    };
    let huge = [[1.0, 0.0], [1e308, -1e308]];
    Lcp::new(huge, vec![1.0; 2]).map(drop).map_err(refused("M in row 1")).unwrap_err();
    let bounds = |lower| {
        let m = [[1.0, 0.0], [0.0, 1e200]];
        BoxedLcp::new(m, vec![-1.0; 2], vec![0.0, lower], vec![f64::INFINITY; 2])
    };
    bounds(1e200).map(drop).map_err(refused("q + M z")).unwrap_err();
    // As large as can be.
    Lcp::new([[1e308, 0.0], [0.0, 1e308]], vec![1.0; 2]).unwrap();
    bounds(1e100).unwrap();
}
