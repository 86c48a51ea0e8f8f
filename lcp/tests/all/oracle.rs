//! The verdicts on small integer problems against the enumeration of all solutions in exact arithmetic.

use crate::common;

use common::cases;
use faer::Mat;
use lcp::{HorizontalLcp, Lemke, Solver, Status};
use lcp_problems::exact::{
    EnumerationSettings, ExactEnumeration, ExactVerdict, enumerate, verify_basis,
};
use proptest::collection::vec;
use proptest::prelude::*;

type Integers = Vec<Vec<i8>>;

fn truth(problem: &HorizontalLcp) -> ExactEnumeration {
    enumerate(problem, &EnumerationSettings::default()).unwrap()
}

/// Rows, `t` and `y` multiplied by powers of two.
fn scaled(a: &Integers, b: &Integers, c: &[i8], exponents: &[i32]) -> HorizontalLcp {
    let n = c.len();
    let power = |group: usize, k: usize| f64::from(exponents[group * n + k]).exp2();
    let entry = |v: i8| f64::from(v);
    let a = Mat::from_fn(n, n, |i, j| entry(a[i][j]) * power(0, i) * power(1, j));
    let b = Mat::from_fn(n, n, |i, j| entry(b[i][j]) * power(0, i) * power(2, j));
    let c: Vec<f64> = (0..n).map(|i| entry(c[i]) * power(0, i)).collect();
    HorizontalLcp::new(a, b, c).unwrap()
}

fn matrix(n: usize, size: i8, zeros: bool) -> impl Strategy<Value = Integers> {
    let entry =
        (-size..=size, any::<bool>()).prop_map(move |(v, keep)| if zeros && !keep { 0 } else { v });
    vec(vec(entry, n), n)
}

fn vector(n: usize, size: i8) -> impl Strategy<Value = Vec<i8>> {
    vec(-size..=size, n)
}

/// `A`, `B`, `c` and the exponents of the scaling.
fn general() -> impl Strategy<Value = (Integers, Integers, Vec<i8>, Vec<i32>)> {
    (1..8_usize, any::<bool>()).prop_flat_map(|(n, zeros)| {
        let exponents = vec(-20..=20_i32, 3 * n);
        (matrix(n, 2, zeros), matrix(n, 2, zeros), vector(n, 2), exponents)
    })
}

/// `A = -C C^T`, `B = 1`: a standard problem with a positive semidefinite matrix.
fn semidefinite() -> impl Strategy<Value = (Integers, Integers, Vec<i8>, Vec<i32>)> {
    (1..8_usize).prop_flat_map(|n| {
        (matrix(n, 2, true), vector(n, 2), vec(-20..=20_i32, 3 * n)).prop_map(
            move |(m, c, exponents)| {
                let gram = |i: usize, j: usize| (0..n).map(|k| m[i][k] * m[j][k]).sum::<i8>();
                let a = (0..n).map(|i| (0..n).map(|j| -gram(i, j)).collect()).collect();
                let one = |i| (0..n).map(|j| i8::from(i == j)).collect();
                (a, (0..n).map(one).collect(), c, exponents)
            },
        )
    })
}

proptest! {
    #![proptest_config(cases(1024))]

    /// Whatever the scaling: solved only what has a solution, infeasible only what
    /// is, and no basis only where there is none.
    #[test]
    fn no_verdict_is_wrong((a, b, c, exponents) in general()) {
        let problem = scaled(&a, &b, &c, &exponents);
        let (truth, solution) = (truth(&problem), Lemke::default().solve(&problem).unwrap());
        match solution.status {
            Status::Solved => prop_assert!(truth.is_solvable(), "{:?}", solution.t),
            Status::Infeasible => prop_assert!(!truth.is_feasible()),
            Status::NoComplementaryBasis => prop_assert!(!truth.has_basis),
            _ => {}
        }
    }

    /// The basis of an answer called solved is one of the problem without rounding as well, and the
    /// point is right to nearly all digits.
    #[test]
    fn solved_bases_are_exact((a, b, c, exponents) in general()) {
        let problem = scaled(&a, &b, &c, &exponents);
        let solution = Lemke::default().solve(&problem).unwrap();
        if let (Status::Solved, Some(basis)) = (solution.status, &solution.basis) {
            let (t, y) = match verify_basis(&problem, basis) {
                ExactVerdict::Solution { t, y } => (t, y),
                // Only where there is no other.
                ExactVerdict::Singular { .. } => {
                    prop_assert!(!truth(&problem).has_basis);
                    return Ok(());
                }
                verdict @ ExactVerdict::Infeasible { .. } => {
                    return Err(TestCaseError::fail(format!("{verdict:?}")));
                }
            };
            // In the units of the integers.
            let factors = exponents[c.len()..].iter().map(|&e| f64::from(e).exp2());
            let values = solution.t.iter().chain(&solution.y).zip(t.iter().chain(&y));
            let values: Vec<(f64, f64)> =
                values.zip(factors).map(|((v, exact), f)| (v * f, exact * f)).collect();
            let largest = values.iter().fold(0.0_f64, |max, (_, exact)| max.max(*exact));
            let is_near = |(v, exact): &(f64, f64)| (v - exact).abs() <= 1e-12 * largest;
            prop_assert!(values.iter().all(is_near), "{:?}", values);
        }
    }

    /// For semidefinite matrices Lemke's method decides, whatever the scaling.
    #[test]
    fn semidefinite_problems_are_decided((a, b, c, exponents) in semidefinite()) {
        let problem = scaled(&a, &b, &c, &exponents);
        let (truth, solution) = (truth(&problem), Lemke::default().solve(&problem).unwrap());
        let expected = if truth.is_solvable() { Status::Solved } else { Status::Infeasible };
        prop_assert_eq!(solution.status, expected);
    }
}
