//! A sweep of small random problems of all classes against the enumeration of their solutions in exact
//! arithmetic: integers with ties and zeros, singular matrices, problems without a solution.
//!
//! A verdict is wrong when it says solved without a solution or at a point that is none, says infeasible
//! of what is feasible, or gives a proof that is none. `Auto` must decide every problem, with a proof where
//! the linear conditions alone cannot be met.
//!
//! The environment variable `LCP_SWEEP` gives the seeds of the problems of every kind, `0..100` without it:
//! ```text
//! LCP_SWEEP=5000..8000 cargo test --release -p lcp --test all sweep::random -- --nocapture
//! ```
//! is 21 000 problems and prints the table, with the smallest problem of every kind of failure.

use crate::common::draw;
use crate::common::methods;
mod problems;
mod tally;
mod text;
mod truth;

use faer::Mat;
use lcp::{HorizontalLcp, Lcp};
use problems::{Case, Kind, Problem};
use tally::Tally;
use truth::truth;

/// No verdict of any method is wrong, and `Auto` leaves nothing open.
fn assert_decided(tally: &Tally) {
    let (wrong, open) = (tally.wrong(), tally.undecided_by_auto());
    assert!(wrong + open == 0, "{wrong} wrong, {open} undecided by auto\n{tally}");
    if std::env::var_os("LCP_SWEEP").is_some() {
        eprintln!("{tally}");
    }
}

#[test]
fn random_problems() {
    let seeds = std::env::var("LCP_SWEEP").map_or(0..100, |seeds| {
        let (from, to) = seeds.split_once("..").expect("LCP_SWEEP is a range such as 5000..8000");
        from.parse().unwrap()..to.parse().unwrap()
    });
    assert!(!seeds.is_empty(), "LCP_SWEEP is an empty range");
    assert_decided(&Tally::sweep(seeds));
}

/// All numbers of `n` digits with these values.
fn digits(n: u32, values: &[i8]) -> impl Iterator<Item = Vec<f64>> + '_ {
    let base = values.len();
    (0..base.pow(n)).map(move |number| {
        let digit = |k: u32| f64::from(values[number / base.pow(k) % base]);
        (0..n).map(digit).collect()
    })
}

/// The solutions themselves, rounded to the nearest numbers, pass the judge, whatever the units: it is not so strict
/// that answers would have to be better than that.
#[test]
fn rounded_solutions_are_solutions() {
    for kind in Kind::ALL {
        for seed in 0..300 {
            let case = Case::draw(kind, seed);
            let vertices = truth(&case.general).faces.into_iter().flat_map(|face| face.vertices);
            for (t, y) in vertices.map(|vertex| vertex.rounded()) {
                let worst = case.problem.residual(&t, &y);
                assert!(worst <= 1e-13, "{worst:e} of t = {t:?}, y = {y:?}: {}", case.text());
            }
        }
    }
}

#[test]
fn all_standard_problems_of_order_two_with_entries_of_one() {
    let mut tally = Tally::default();
    for d in digits(6, &[0, 1, -1]) {
        let m = Mat::from_fn(2, 2, |i, j| d[2 * i + j]);
        let lcp = Lcp::new(m, d[4..].to_vec()).unwrap();
        tally.add("standard", &Case::new(Problem::Standard(lcp)));
    }
    assert_decided(&tally);
}

#[test]
fn all_general_problems_of_order_one() {
    let mut tally = Tally::default();
    for d in digits(3, &[0, 1, -1, 2, -2]) {
        let entry = |k: usize| Mat::from_fn(1, 1, |_, _| d[k]);
        let problem = HorizontalLcp::new(entry(0), entry(1), vec![d[2]]).unwrap();
        tally.add("general", &Case::new(Problem::General(problem)));
    }
    assert_decided(&tally);
}
