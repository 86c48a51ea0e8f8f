//! The same problem in other words has the same answer: units, rows, sides, order, and pairs that
//! have nothing to do with the rest.
//!
//! Every test rewrites a problem whose one solution is known exactly and compares what comes back.

use crate::common;

use common::cases;
use faer::Mat;
use lcp::{HorizontalLcp, Lemke, LemkeSettings, Solution, Solver, Status};
use lcp_problems::families::{self, Instance, KnownAnswer};
use proptest::collection::vec;
use proptest::prelude::*;

const LARGEST: usize = 12;

/// `A t + B y = c` and its solution.
#[derive(Debug, Clone)]
struct Case {
    a: Mat<f64>,
    b: Mat<f64>,
    c: Vec<f64>,
    t: Vec<f64>,
    y: Vec<f64>,
}

impl Case {
    fn order(&self) -> usize {
        self.c.len()
    }

    fn solve(&self, settings: LemkeSettings) -> Solution {
        let problem = HorizontalLcp::new(self.a.clone(), self.b.clone(), self.c.clone()).unwrap();
        Lemke::new(settings).solve(&problem).unwrap()
    }

    /// Solves at the first attempt and compares, to 1e-9 of the largest entry on each side.
    fn check(&self) {
        let once = LemkeSettings { max_attempts: Some(1), ..LemkeSettings::default() };
        let solution = self.solve(once);
        assert_eq!(solution.status, Status::Solved);
        self.compare(&solution.t, &solution.y);
    }

    fn compare(&self, t: &[f64], y: &[f64]) {
        for (found, expected) in [(t, &self.t), (y, &self.y)] {
            let size = expected.iter().fold(0.0_f64, |max, v| max.max(*v));
            let is_near = |(f, e): (&f64, &f64)| (f - e).abs() <= 1e-9 * size;
            assert!(found.iter().zip(expected).all(is_near), "{found:?} {expected:?}");
        }
    }
}

fn unique() -> impl Strategy<Value = Case> {
    let kinds = [families::positive_definite, families::p_matrix];
    (1..=LARGEST, any::<u64>(), 0..kinds.len()).prop_map(move |(n, seed, kind)| {
        let Instance { problem, known } = kinds[kind](n, seed);
        let KnownAnswer::Unique { t, y } = known else { panic!("both classes have one solution") };
        let a = Mat::from_fn(n, n, |i, j| -problem.m()[(i, j)]);
        Case { a, b: Mat::identity(n, n), c: problem.q().to_vec(), t, y }
    })
}

proptest! {
    #![proptest_config(cases(1024))]

    /// Units of rows, and of single variables on either side, over sixteen orders of magnitude each.
    #[test]
    fn units(case in unique(), exponents in vec(-8..=8_i32, 3 * LARGEST)) {
        let n = case.order();
        let factor = |group: usize, k: usize| 10.0_f64.powi(exponents[group * LARGEST + k]);
        let scaled = Case {
            a: Mat::from_fn(n, n, |i, j| factor(0, i) * case.a[(i, j)] * factor(1, j)),
            b: Mat::from_fn(n, n, |i, j| factor(0, i) * case.b[(i, j)] * factor(2, j)),
            c: (0..n).map(|i| factor(0, i) * case.c[i]).collect(),
            ..case.clone()
        };
        let solution = scaled.solve(LemkeSettings::default());
        prop_assert_eq!(solution.status, Status::Solved);
        let t: Vec<f64> = (0..n).map(|j| solution.t[j] * factor(1, j)).collect();
        let y: Vec<f64> = (0..n).map(|j| solution.y[j] * factor(2, j)).collect();
        case.compare(&t, &y);
    }

    /// Units of all forces, or of all lengths, far from one.
    #[test]
    fn size(case in unique(), exponent in -150..=150_i32) {
        let factor = 10.0_f64.powi(exponent);
        let times = |v: &[f64]| v.iter().map(|v| v * factor).collect();
        Case { c: times(&case.c), t: times(&case.t), y: times(&case.y), ..case }.check();
    }

    /// Rows mixed by a nonsingular matrix.
    #[test]
    fn rows(case in unique(), mix in vec(-1.0..1.0_f64, LARGEST * LARGEST)) {
        let n = case.order();
        let mix = Mat::from_fn(n, n, |i, j| mix[i * n + j] + if i == j { 4.0 } else { 0.0 });
        let c = (0..n).map(|i| (0..n).map(|j| mix[(i, j)] * case.c[j]).sum()).collect();
        Case { a: &mix * &case.a, b: &mix * &case.b, c, ..case }.check();
    }

    /// Pairs whose variables change places: neither matrix is simple any more.
    #[test]
    fn sides(case in unique(), swap in vec(any::<bool>(), LARGEST)) {
        let n = case.order();
        let matrix = |kept: &Mat<f64>, other: &Mat<f64>| {
            Mat::from_fn(n, n, |i, j| if swap[j] { other[(i, j)] } else { kept[(i, j)] })
        };
        let vector = |kept: &[f64], other: &[f64]| {
            (0..n).map(|j| if swap[j] { other[j] } else { kept[j] }).collect()
        };
        let (a, b) = (matrix(&case.a, &case.b), matrix(&case.b, &case.a));
        let (t, y) = (vector(&case.t, &case.y), vector(&case.y, &case.t));
        Case { a, b, c: case.c, t, y }.check();
    }

    /// Rows and pairs in another order, each in its own.
    #[test]
    fn order(
        case in unique(),
        rows in Just((0..LARGEST).collect::<Vec<_>>()).prop_shuffle(),
        pairs in Just((0..LARGEST).collect::<Vec<_>>()).prop_shuffle(),
    ) {
        let n = case.order();
        let below = |order: Vec<usize>| order.into_iter().filter(|&k| k < n).collect::<Vec<_>>();
        let (rows, pairs) = (below(rows), below(pairs));
        let matrix = |m: &Mat<f64>| Mat::from_fn(n, n, |i, j| m[(rows[i], pairs[j])]);
        let vector = |v: &[f64], order: &[usize]| order.iter().map(|&k| v[k]).collect();
        Case {
            a: matrix(&case.a),
            b: matrix(&case.b),
            c: vector(&case.c, &rows),
            t: vector(&case.t, &pairs),
            y: vector(&case.y, &pairs),
        }
        .check();
    }

    /// One more pair `t - y = value` with an equation of its own, in front or behind, of any size that
    /// leaves the others their digits.
    #[test]
    fn a_pair_apart(case in unique(), value in -3..=3_i8, exponent in -2..=2_i32, in_front: bool) {
        let n = case.order();
        let (at, first) = if in_front { (0, 1) } else { (n, 0) };
        let value = f64::from(value) * 10.0_f64.powi(exponent);
        let matrix = |m: &Mat<f64>, diagonal: f64| {
            Mat::from_fn(n + 1, n + 1, |i, j| match (i == at, j == at) {
                (true, true) => diagonal,
                (false, false) => m[(i - first, j - first)],
                _ => 0.0,
            })
        };
        let vector = |v: &[f64], value: f64| {
            let mut v = v.to_vec();
            v.insert(at, value);
            v
        };
        Case {
            a: matrix(&case.a, 1.0),
            b: matrix(&case.b, -1.0),
            c: vector(&case.c, value),
            t: vector(&case.t, value.max(0.0)),
            y: vector(&case.y, (-value).max(0.0)),
        }
        .check();
    }
}
