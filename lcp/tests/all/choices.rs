//! Problems that pivots alone do not decide: choices of sides, and more attempts.

use crate::common;

use faer::Mat;
use lcp::{Auto, HorizontalLcp, Lcp, Method, Solver, Status};
use lcp_problems::exact::{EnumerationSettings, enumerate};
use proptest::collection::vec;
use proptest::prelude::*;

fn problem(n: usize, entries: &[i32], q: &[i32]) -> Lcp {
    let m = Mat::from_fn(n, n, |i, j| f64::from(entries[n * i + j]));
    Lcp::new(m, q[..n].iter().map(|q| f64::from(*q)).collect::<Vec<f64>>()).unwrap()
}

/// `M` with `q` such that a point solves it: `z_i` is `pairs[i]` if that is positive, else `w_i` is `-pairs[i]`.
fn planted(m: Mat<f64>, pairs: &[i32]) -> Lcp {
    let side = |sign: f64| move |pair: &i32| (sign * f64::from(*pair)).max(0.0);
    let z: Vec<f64> = pairs.iter().map(side(1.0)).collect();
    let w: Vec<f64> = pairs.iter().map(side(-1.0)).collect();
    let product = |i: usize| z.iter().enumerate().map(|(j, z)| m[(i, j)] * z).sum::<f64>();
    let q: Vec<f64> = w.iter().enumerate().map(|(i, w)| w - product(i)).collect();
    Lcp::new(m, q).unwrap()
}

/// Solved, or with a proof that the library has checked.
fn is_decided(problem: &Lcp) -> bool {
    let solution = Auto::default().solve(problem).unwrap();
    let is_proved = solution.certificate.as_ref().is_some_and(lcp::Certificate::is_proof);
    let has_none = matches!(solution.status, Status::Infeasible | Status::NoSolution);
    solution.is_solved() || has_none && is_proved
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..common::cases(0) })]

    /// Of any class, with many ties; most of them have no solution.
    #[test]
    fn up_to_eighteen_pairs_are_decided(
        n in 13..=18_usize,
        entries in vec(-3..=3_i32, 18 * 18),
        q in vec(-3..=2_i32, 18),
    ) {
        prop_assert!(is_decided(&problem(n, &entries, &q)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..common::cases(0) })]

    /// Against all solutions in rational arithmetic.
    #[test]
    fn verdicts_on_thirteen_pairs_are_right(
        entries in vec(-3..=3_i32, 13 * 13),
        q in vec(-3..=2_i32, 13),
    ) {
        let problem = problem(13, &entries, &q);
        let all = enumerate(&HorizontalLcp::from(problem.clone()), &EnumerationSettings::default());
        let solution = Auto::default().solve(&problem).unwrap();
        prop_assert_eq!(solution.is_solved(), all.unwrap().is_solvable(), "{}", solution.status);
    }

    /// P0-matrices with three entries in a row, half of the diagonal zero, on which pivots end on rays.
    #[test]
    fn sparse_triangular_problems_of_a_hundred_pairs_are_solved(
        n in 20..=100_usize,
        diagonal in vec(0..=1_i32, 100),
        places in vec((0..1000_usize, 0..1000_usize), 100),
        entries in vec((1..=2_i32, -2..=-1_i32), 100),
        pairs in vec(-4..=4_i32, 100),
    ) {
        let mut m = Mat::zeros(n, n);
        for i in 0..n {
            m[(i, i)] = f64::from(diagonal[i]);
            if i > 0 {
                m[(i, places[i].0 % i)] = f64::from(entries[i].0);
                m[(i, places[i].1 % i)] = f64::from(entries[i].1);
            }
        }
        let solution = Auto::default().solve(&planted(m, &pairs[..n])).unwrap();
        prop_assert!(solution.is_solved(), "{}", solution.status);
    }

    /// Dense indefinite matrices, of which one drawn start basis in hundreds leads to the solution, and one in some dozens
    /// after the descent to few negative values.
    #[test]
    fn planted_indefinite_problems_are_solved(
        n in 20..=50_usize,
        entries in vec(-100..=100_i32, 50 * 50),
        pairs in vec(-4..=4_i32, 50),
    ) {
        let m = Mat::from_fn(n, n, |i, j| f64::from(entries[n * i + j]));
        let solution = Auto::default().solve(&planted(m, &pairs[..n])).unwrap();
        prop_assert!(solution.is_solved(), "{}", solution.status);
    }
}

/// A number of attempts limits Lemke's method, and not the chain.
#[test]
fn the_chain_goes_on_behind_the_attempts() {
    let m = Mat::from_fn(2, 2, |i, j| f64::from(u8::from(i != j)));
    let problem = Lcp::new(m, vec![-1.0, -1.0]).unwrap();
    let settings = lcp::AutoSettings { max_attempts: Some(1), ..Default::default() };
    let solution = Auto::new(settings).solve(&problem).unwrap();
    assert!(solution.is_solved());
    assert_eq!(solution.info.method, Method::Enumeration);
    assert_eq!(solution.info.runs[0].method, Method::Lemke);
}
