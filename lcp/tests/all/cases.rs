//! Small problems whose answers were wrong or not found, each with others of its class: by every method the truth, or
//! no answer; by `Auto` the truth.

use crate::common;

mod blocks;
mod boxes;
use crate::common::draw;
mod far;
mod friction;
mod gaps;
use crate::common::methods;

use lcp::{HorizontalLcp, Solution};
use lcp_problems::exact::{EnumerationSettings, ExactEnumeration, enumerate};
use methods::{AUTO, Treated};

/// The answers that are called solved, by the name of their method. That of `Auto` must be one of them.
fn solved<P: Treated>(problem: &P) -> Vec<(&'static str, Solution<P>)> {
    let mut solved = Vec::new();
    for (name, answer) in problem.answers() {
        match answer {
            Ok(solution) if solution.is_solved() => solved.push((name, solution)),
            other => assert_ne!(name, AUTO, "{other:?}"),
        }
    }
    solved
}

/// All solutions, in exact arithmetic.
fn truth(problem: &HorizontalLcp) -> ExactEnumeration {
    enumerate(problem, &EnumerationSettings::default()).unwrap()
}

/// `t` of the only solution.
fn only(problem: &HorizontalLcp) -> Vec<f64> {
    truth(problem).unique().unwrap().rounded().0
}

/// Every component is right in units of its own, or of this size where it is smaller.
fn assert_near(name: &str, found: &[f64], exact: &[f64], size: f64) {
    let is_near = |(f, e): (&f64, &f64)| (f - e).abs() <= 1e-8 * e.abs().max(size);
    assert!(found.iter().zip(exact).all(is_near), "{name}: {found:?}, but {exact:?}");
}
