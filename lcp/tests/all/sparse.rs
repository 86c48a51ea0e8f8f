//! Sparse problems: the same answers as with dense matrices.

use crate::common;

use common::cases;
use faer::Mat;
use faer::sparse::{SparseColMat, Triplet};
use lcp::{HorizontalLcp, Lemke, LemkeSettings, MixedLcp, Solver, Status};
use proptest::collection::vec;
use proptest::prelude::*;

type Sparse = SparseColMat<usize, f64>;

fn sparse(m: &Mat<f64>) -> Sparse {
    let entries: Vec<_> = (0..m.nrows())
        .flat_map(|i| (0..m.ncols()).map(move |j| (i, j)))
        .filter(|&(i, j)| m[(i, j)] != 0.0)
        .map(|(i, j)| Triplet::new(i, j, m[(i, j)]))
        .collect();
    Sparse::try_new_from_triplets(m.nrows(), m.ncols(), &entries).unwrap()
}

fn first_attempt() -> Lemke {
    Lemke::new(LemkeSettings { max_attempts: Some(1), ..LemkeSettings::default() })
}

/// The problem with both kinds of matrices.
fn both(a: &Mat<f64>, b: &Mat<f64>, c: &[f64]) -> [HorizontalLcp; 2] {
    let dense = HorizontalLcp::new(a.clone(), b.clone(), c.to_vec()).unwrap();
    let sparse = HorizontalLcp::new(sparse(a), sparse(b), c.to_vec()).unwrap();
    assert!(sparse.is_sparse() && !dense.is_sparse());
    [dense, sparse]
}

fn standard(m: &Mat<f64>, q: &[f64]) -> [HorizontalLcp; 2] {
    both(&-m, &Mat::identity(q.len(), q.len()), q)
}

fn close(a: &[f64], b: &[f64]) -> bool {
    let size = a.iter().chain(b).fold(1.0_f64, |max, v| max.max(v.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * size)
}

fn value() -> impl Strategy<Value = f64> {
    prop_oneof![-4.0..4.0_f64, (-3..=3_i8).prop_map(f64::from)]
}

/// A matrix with a few entries in every row.
fn scattered(n: usize) -> impl Strategy<Value = Mat<f64>> {
    vec((0..n, 0..n, (-2..=2_i8).prop_map(f64::from)), 0..3 * n).prop_map(move |entries| {
        let mut m = Mat::zeros(n, n);
        for (i, j, v) in entries {
            m[(i, j)] = v;
        }
        m
    })
}

/// A band of random width whose symmetric part is positive definite, and a vector of small integers,
/// whose ratios tie.
fn banded() -> impl Strategy<Value = (Mat<f64>, Vec<f64>)> {
    banded_with((-3..=3_i8).prop_map(f64::from))
}

/// Such a band, and a vector of the given numbers.
fn banded_with(
    number: impl Strategy<Value = f64> + Clone,
) -> impl Strategy<Value = (Mat<f64>, Vec<f64>)> {
    (1..40_usize, 1..4_usize).prop_flat_map(move |(n, width)| {
        (vec(value(), n * (2 * width + 1)), vec(number.clone(), n)).prop_map(move |(entries, q)| {
            let at = |i: usize, j: usize| entries[i * (2 * width + 1) + j + width - i];
            let mut m =
                Mat::from_fn(
                    n,
                    n,
                    |i, j| {
                        if i != j && i.abs_diff(j) <= width { at(i, j) } else { 0.0 }
                    },
                );
            for i in 0..n {
                let sum = |f: &dyn Fn(usize) -> f64| (0..n).map(|j| f(j).abs()).sum::<f64>();
                m[(i, i)] = 1.0 + sum(&|j| m[(i, j)]).max(sum(&|j| m[(j, i)]));
            }
            (m, q)
        })
    })
}

proptest! {
    #![proptest_config(cases(256))]

    /// One answer, although the two break ties by rules of their own.
    #[test]
    fn bands((m, q) in banded()) {
        let [dense, sparse] = standard(&m, &q).map(|it| first_attempt().solve(&it).unwrap());
        prop_assert_eq!(sparse.status, Status::Solved);
        prop_assert!(close(&sparse.t, &dense.t) && close(&sparse.y, &dense.y));
    }

    /// One path: the same pivots.
    #[test]
    fn bands_without_ties((m, q) in banded_with(-3.0..3.0_f64)) {
        let [dense, sparse] = standard(&m, &q).map(|it| first_attempt().solve(&it).unwrap());
        prop_assert_eq!(sparse.status, Status::Solved);
        prop_assert_eq!(sparse.info.pivots, dense.info.pivots);
        prop_assert!(close(&sparse.t, &dense.t) && close(&sparse.y, &dense.y));
    }

    /// The general form: neighbouring rows mixed, pairs swapped, columns of every size.
    #[test]
    fn general_problems(
        (m, q) in banded(),
        mix in vec(-1.0..1.0_f64, 40),
        swap in vec(any::<bool>(), 40),
        exponents in vec(-6..=6_i32, 80),
    ) {
        let n = q.len();
        let mix = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 if j > i => mix[i],
            _ => 0.0,
        });
        let c: Vec<f64> = (0..n).map(|i| (0..n).map(|j| mix[(i, j)] * q[j]).sum()).collect();
        let (t, y) = (&mix * -&m, mix.clone());
        let size = |j: usize| 10.0_f64.powi(exponents[j]);
        let a = Mat::from_fn(n, n, |i, j| size(j) * if swap[j] { y[(i, j)] } else { t[(i, j)] });
        let b = Mat::from_fn(n, n, |i, j| {
            size(40 + j) * if swap[j] { t[(i, j)] } else { y[(i, j)] }
        });
        let [plain, _] = standard(&m, &q).map(|it| Lemke::default().solve(&it).unwrap());
        let [_, sparse] = both(&a, &b, &c);
        let solution = Lemke::default().solve(&sparse).unwrap();
        prop_assert_eq!(solution.status, Status::Solved);
        let z: Vec<f64> = (0..n)
            .map(|j| if swap[j] { solution.y[j] * size(40 + j) } else { solution.t[j] * size(j) })
            .collect();
        prop_assert!(close(&z, &plain.t), "{:?} {:?}", z, plain.t);
    }

    /// Positive semidefinite: solved or infeasible, as for dense matrices; `w` is unique.
    #[test]
    fn semidefinite_problems(
        (c, q) in (1..12_usize).prop_flat_map(|n| {
            (scattered(n), vec((-3..=3_i8).prop_map(f64::from), n))
        })
    ) {
        let m = &c * c.transpose();
        let [dense, sparse] = standard(&m, &q).map(|it| Lemke::default().solve(&it).unwrap());
        prop_assert_eq!(sparse.status, dense.status);
        prop_assert!(matches!(sparse.status, Status::Solved | Status::Infeasible));
        if sparse.is_solved() {
            prop_assert!(close(&sparse.y, &dense.y));
        }
    }

    /// A quadratic programme: `x` is free, as are the multipliers of equations; others are not.
    #[test]
    fn mixed_problems(
        (m, c, q, kinds) in banded().prop_flat_map(|(m, q)| {
            let n = q.len();
            (Just(m), scattered(n), vec(value(), 2 * n), vec(any::<bool>(), n))
        })
    ) {
        let n = m.nrows();
        let saddle = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, true) => m[(i, j)],
            (true, false) => -c[(j - n, i)],
            (false, true) => c[(i - n, j)],
            (false, false) => if i == j { 0.5 } else { 0.0 },
        });
        let free: Vec<bool> = (0..2 * n).map(|i| i < n || kinds[i - n]).collect();
        let solve = |problem: MixedLcp| {
            let solution = Lemke::default().solve(&problem.to_general()).unwrap();
            let (z, _) = problem.recover(&solution.t, &solution.y);
            (solution.status, z)
        };
        let sparse = MixedLcp::new(sparse(&saddle), q.clone(), free.clone()).unwrap();
        prop_assert!(sparse.to_general().is_sparse());
        let (status, z) = solve(sparse);
        let (expected_status, expected) = solve(MixedLcp::new(saddle, q, free).unwrap());
        prop_assert_eq!(status, Status::Solved);
        prop_assert_eq!(expected_status, Status::Solved);
        prop_assert!(close(&z, &expected), "{:?} {:?}", z, expected);
    }

    /// Anything at all: no panic, `Solved` means solved, and no proof against a solution.
    #[test]
    fn no_verdict_is_wrong(
        (a, b, c) in (1..8_usize).prop_flat_map(|n| {
            (scattered(n), scattered(n), vec((-2..=2_i8).prop_map(f64::from), n))
        })
    ) {
        let problems = both(&a, &b, &c);
        let [dense, sparse] = problems.each_ref().map(|it| Lemke::default().solve(it).unwrap());
        if sparse.is_solved() {
            prop_assert!(problems[0].residuals(&sparse.t, &sparse.y).worst() <= 1e-10);
            prop_assert!(sparse.t.iter().chain(&sparse.y).all(|&v| v >= 0.0));
            prop_assert_ne!(dense.status, Status::Infeasible);
        }
        if dense.is_solved() {
            prop_assert_ne!(sparse.status, Status::Infeasible);
        }
    }
}
