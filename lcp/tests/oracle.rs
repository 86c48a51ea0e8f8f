//! Small integer problems against the enumeration of all complementary bases in exact arithmetic.

#![allow(clippy::unwrap_used)] // a test may panic

use faer::Mat;
use lcp::{HorizontalLcp, Lemke, Status};
use proptest::collection::vec;
use proptest::prelude::*;

type Integers = Vec<Vec<i128>>;

/// What enumeration finds.
#[derive(Debug, PartialEq)]
struct Truth {
    /// Some complementary basis is nonsingular.
    has_basis: bool,
    /// Some complementary basis gives nonnegative values, or zero is a solution.
    is_solvable: bool,
}

fn enumerate(a: &Integers, b: &Integers, c: &[i128]) -> Truth {
    let n = c.len();
    let mut truth = Truth { has_basis: false, is_solvable: c.iter().all(|&c| c == 0) };
    for choice in 0..1_u32 << n {
        let entry = |i: usize, j: usize| if choice >> j & 1 == 1 { a[i][j] } else { b[i][j] };
        let rows = (0..n).map(|i| (0..n).map(|j| entry(i, j)).chain([c[i]]).collect()).collect();
        if let Some(values) = scaled_solution(rows) {
            truth.has_basis = true;
            truth.is_solvable |= values.iter().all(|&v| v >= 0);
        }
    }
    truth
}

/// The solution of a system given as rows with the right-hand side at the end, times a positive number;
/// fraction-free elimination (Bareiss 1968). `None` when the matrix is singular.
fn scaled_solution(mut rows: Integers) -> Option<Vec<i128>> {
    let n = rows.len();
    let mut previous = 1;
    for k in 0..n {
        let pivot_row = (k..n).find(|&i| rows[i][k] != 0)?;
        rows.swap(k, pivot_row);
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k];
            for (v, p) in row.iter_mut().zip(&pivot) {
                *v = (*v * pivot[k] - factor * p) / previous;
            }
            debug_assert!(row[k] == 0, "row {i}");
        }
        previous = pivot[k];
    }
    Some(rows.iter().map(|row| row[n] * previous.signum()).collect())
}

/// Rows, `t` and `y` multiplied by powers of two.
fn scaled(a: &Integers, b: &Integers, c: &[i128], exponents: &[i32]) -> HorizontalLcp {
    let n = c.len();
    let power = |group: usize, k: usize| f64::from(exponents[group * n + k]).exp2();
    let entry = |v: i128| v as f64;
    let a = Mat::from_fn(n, n, |i, j| entry(a[i][j]) * power(0, i) * power(1, j));
    let b = Mat::from_fn(n, n, |i, j| entry(b[i][j]) * power(0, i) * power(2, j));
    let c = (0..n).map(|i| entry(c[i]) * power(0, i)).collect();
    HorizontalLcp::new(a, b, c).unwrap()
}

fn matrix(n: usize, size: i8, zeros: bool) -> impl Strategy<Value = Integers> {
    let entry = (-size..=size, any::<bool>())
        .prop_map(move |(v, keep)| if zeros && !keep { 0 } else { i128::from(v) });
    vec(vec(entry, n), n)
}

fn vector(n: usize, size: i8) -> impl Strategy<Value = Vec<i128>> {
    vec((-size..=size).prop_map(i128::from), n)
}

/// `A`, `B`, `c` and the exponents of the scaling.
fn general() -> impl Strategy<Value = (Integers, Integers, Vec<i128>, Vec<i32>)> {
    (1..6_usize, any::<bool>()).prop_flat_map(|(n, zeros)| {
        let exponents = vec(-20..=20_i32, 3 * n);
        (matrix(n, 2, zeros), matrix(n, 2, zeros), vector(n, 2), exponents)
    })
}

/// `A = -C C^T`, `B = 1`: a standard problem with a positive semidefinite matrix.
fn semidefinite() -> impl Strategy<Value = (Integers, Integers, Vec<i128>, Vec<i32>)> {
    (1..6_usize).prop_flat_map(|n| {
        (matrix(n, 2, true), vector(n, 2), vec(-20..=20_i32, 3 * n)).prop_map(
            move |(m, c, exponents)| {
                let gram = |i: usize, j: usize| (0..n).map(|k| m[i][k] * m[j][k]).sum::<i128>();
                let a = (0..n).map(|i| (0..n).map(|j| -gram(i, j)).collect()).collect();
                let one = |i| (0..n).map(|j| i128::from(i == j)).collect();
                (a, (0..n).map(one).collect(), c, exponents)
            },
        )
    })
}

/// At least so many cases; more by the environment variable `PROPTEST_CASES`.
fn cases(least: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(least), ..default }
}

proptest! {
    #![proptest_config(cases(1024))]

    /// Whatever the scaling: solved only what has a solution, and no basis only where there is none.
    #[test]
    fn no_verdict_is_wrong((a, b, c, exponents) in general()) {
        let truth = enumerate(&a, &b, &c);
        let solution = Lemke::default().solve(&scaled(&a, &b, &c, &exponents)).unwrap();
        match solution.status {
            Status::Solved => prop_assert!(truth.is_solvable, "{:?}", solution.t),
            Status::NoComplementaryBasis => prop_assert!(!truth.has_basis),
            _ => {}
        }
    }

    /// For semidefinite matrices Lemke's method decides, whatever the scaling.
    #[test]
    fn semidefinite_problems_are_decided((a, b, c, exponents) in semidefinite()) {
        let truth = enumerate(&a, &b, &c);
        let solution = Lemke::default().solve(&scaled(&a, &b, &c, &exponents)).unwrap();
        let expected = if truth.is_solvable { Status::Solved } else { Status::Infeasible };
        prop_assert_eq!(solution.status, expected);
    }
}

/// The oracle itself.
#[test]
fn enumeration_knows_the_textbook() {
    let one = vec![vec![1, 0], vec![0, 1]];
    let solvable = enumerate(&vec![vec![-2, -1], vec![-1, -2]], &one, &[-5, -6]);
    assert_eq!(solvable, Truth { has_basis: true, is_solvable: true });
    let infeasible = enumerate(&vec![vec![1, 0], vec![0, -1]], &one, &[-1, 1]);
    assert_eq!(infeasible, Truth { has_basis: true, is_solvable: false });
    assert_eq!(scaled_solution(vec![vec![2, 1, 5], vec![1, 2, 6]]), Some(vec![4, 7]));
}
