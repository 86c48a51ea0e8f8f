//! Invariants on random problems: whatever the data, an answer called solved satisfies the
//! conditions, and scaling, row operations and swapped pairs do not change it.

#![allow(clippy::unwrap_used)] // a test may panic

use faer::Mat;
use lcp::{HorizontalLcp, Lemke, LemkeSettings, Status};
use proptest::collection::vec;
use proptest::prelude::*;

fn matrix(n: usize, values: &[f64]) -> Mat<f64> {
    Mat::from_fn(n, n, |i, j| values[i * n + j])
}

fn entries(n: usize) -> impl Strategy<Value = Vec<f64>> {
    vec(-4.0..4.0_f64, n * n)
}

/// Small integers: ties and degeneracy, which continuous data never shows.
fn integers(n: usize) -> impl Strategy<Value = Vec<f64>> {
    vec((-3..=3_i8).prop_map(f64::from), n * n)
}

/// `w = M z + q` with a positive definite `M = C C^T + 1` and its data.
fn positive_definite() -> impl Strategy<Value = (Mat<f64>, Vec<f64>)> {
    (1..12_usize).prop_flat_map(|n| {
        (prop_oneof![entries(n), integers(n)], vec((-3..=3_i8).prop_map(f64::from), n)).prop_map(
            move |(c, q)| {
                let c = matrix(n, &c);
                (&c * c.transpose() + Mat::<f64>::identity(n, n), q)
            },
        )
    })
}

fn standard(m: &Mat<f64>, q: &[f64]) -> HorizontalLcp {
    let n = q.len();
    HorizontalLcp::new(-m, Mat::identity(n, n), q.to_vec()).unwrap()
}

fn first_attempt() -> Lemke {
    Lemke::new(LemkeSettings { max_attempts: 1, ..LemkeSettings::default() })
}

/// Equal to 1e-9 of the data: `M` is at least the identity, so that no `z` exceeds the largest `q`.
fn same(a: &[f64], b: &[f64], q: &[f64]) -> bool {
    let size = q.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * size)
}

/// At least so many cases; more by the environment variable `PROPTEST_CASES`.
fn cases(least: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(least), ..default }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn positive_definite_problems_are_solved_at_once((m, q) in positive_definite()) {
        let solution = first_attempt().solve(&standard(&m, &q)).unwrap();
        prop_assert_eq!(solution.status, Status::Solved);
        prop_assert!(solution.residuals.worst() <= 1e-10);
    }

    /// The unique answer survives scaling of forces, lengths and single pairs.
    #[test]
    fn units_do_not_matter((m, q) in positive_definite(), exponents in vec(-8..=8_i32, 24)) {
        let n = q.len();
        let solution = first_attempt().solve(&standard(&m, &q)).unwrap();
        let factor = |k: usize| 10.0_f64.powi(exponents[k]);
        let a = Mat::from_fn(n, n, |i, j| -factor(i) * m[(i, j)] * factor(n + j));
        let b = Mat::from_fn(n, n, |i, j| if i == j { factor(i) } else { 0.0 });
        let c = (0..n).map(|i| factor(i) * q[i]).collect();
        let scaled = first_attempt().solve(&HorizontalLcp::new(a, b, c).unwrap()).unwrap();
        prop_assert_eq!(scaled.status, Status::Solved);
        let back: Vec<f64> = (0..n).map(|j| scaled.t[j] * factor(n + j)).collect();
        prop_assert!(same(&back, &solution.t, &q), "{:?} {:?}", back, solution.t);
    }

    /// The general form as it stands: rows mixed by any nonsingular matrix and pairs swapped.
    #[test]
    fn rows_and_sides_do_not_matter(
        (m, q) in positive_definite(),
        mix in vec(-1.0..1.0_f64, 144),
        swap in vec(any::<bool>(), 12),
    ) {
        let n = q.len();
        let solution = first_attempt().solve(&standard(&m, &q)).unwrap();
        let mix = Mat::from_fn(n, n, |i, j| mix[i * n + j] + if i == j { 4.0 } else { 0.0 });
        let (a, b) = (&mix * -&m, mix.clone());
        let c: Vec<f64> = (0..n).map(|i| (0..n).map(|j| mix[(i, j)] * q[j]).sum()).collect();
        let pick = |t: &Mat<f64>, y: &Mat<f64>, t_side: bool| {
            Mat::from_fn(n, n, |i, j| if swap[j] == t_side { y[(i, j)] } else { t[(i, j)] })
        };
        let problem = HorizontalLcp::new(pick(&a, &b, true), pick(&a, &b, false), c).unwrap();
        let mixed = Lemke::default().solve(&problem).unwrap();
        prop_assert_eq!(mixed.status, Status::Solved);
        let back: Vec<f64> =
            (0..n).map(|j| if swap[j] { mixed.y[j] } else { mixed.t[j] }).collect();
        prop_assert!(same(&back, &solution.t, &q), "{:?} {:?}", back, solution.t);
    }

    /// Positive semidefinite with a planted, degenerate solution.
    #[test]
    fn planted_solutions_of_semidefinite_problems(
        (n, c, states) in (1..10_usize).prop_flat_map(|n| {
            (Just(n), integers(n), vec((0..3_u8, 1..4_u8), n))
        })
    ) {
        let mut c = matrix(n, &c);
        c.subcols_mut(n / 2, n - n / 2).fill(0.0);
        let m = &c * c.transpose();
        let z: Vec<f64> =
            states.iter().map(|&(s, v)| if s == 0 { f64::from(v) } else { 0.0 }).collect();
        let w: Vec<f64> =
            states.iter().map(|&(s, v)| if s == 1 { f64::from(v) } else { 0.0 }).collect();
        let q: Vec<f64> =
            (0..n).map(|i| w[i] - (0..n).map(|j| m[(i, j)] * z[j]).sum::<f64>()).collect();
        let solution = first_attempt().solve(&standard(&m, &q)).unwrap();
        prop_assert_eq!(solution.status, Status::Solved);
    }

    /// Anything at all: no panic, and `Solved` means solved.
    #[test]
    fn solved_means_solved(
        (n, a, b, c) in (1..8_usize).prop_flat_map(|n| {
            (Just(n), integers(n), integers(n), vec((-3..=3_i8).prop_map(f64::from), n))
        })
    ) {
        let problem = HorizontalLcp::new(matrix(n, &a), matrix(n, &b), c).unwrap();
        let solution = Lemke::default().solve(&problem).unwrap();
        if solution.is_solved() {
            prop_assert!(problem.residuals(&solution.t, &solution.y).worst() <= 1e-10);
            prop_assert!(solution.t.iter().chain(&solution.y).all(|&v| v >= 0.0));
        }
    }
}
