//! Enumeration as a method: the last resort for small problems.

use std::time::Duration;

use super::constants::WORK;
use crate::conversion::{General, judged_point};
use crate::enumerate::{Enumerated, MOST_PAIRS, enumerate};
use crate::solve::{Monitor, is_over};
use crate::{Certificate, Error, Method, Named, Observer, Solution, Solver, Status};

/// The last resort of [`Auto`](crate::Auto) for small problems, by itself: all choices of sides by branch and bound,
/// with a proof if no choice has a solution. Problems of more than 100 pairs are [not treated](Error::NotTreated).
#[derive(Debug, Clone, Copy)]
pub struct Enumeration {
    /// Largest residual of a solution, relative to the data.
    pub tolerance: f64,
    /// Time limit.
    pub time_limit: Option<Duration>,
}

impl Named for Enumeration {
    fn method(&self) -> Method {
        Method::Enumeration
    }
}

impl<P: General> Solver<P> for Enumeration {
    fn solve_pairs(&self, problem: &P, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        let general = problem.general();
        let n = general.order();
        if n > MOST_PAIRS {
            return Err(Error::NotTreated {
                method: Method::Enumeration,
                reason: format!("it has more than {MOST_PAIRS} pairs"),
            });
        }
        let mut monitor = Monitor::new(Method::Enumeration, usize::MAX, self.time_limit, observer);
        let is_cancelled = monitor.stop(f64::INFINITY) == Some(Status::Cancelled);
        let deadline = monitor.deadline();
        let (found, exchanges) = if is_cancelled {
            (Enumerated::Limit, 0)
        } else {
            enumerate(&general, WORK / n.pow(2).max(1), deadline)
        };
        let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
        let (mut basis, mut proof) = (None, None);
        let is_limited = found == Enumerated::Limit;
        match found {
            Enumerated::Found { t: of_t, y: of_y, basis: found } => {
                (t, y, basis) = (of_t, of_y, Some(found));
            }
            Enumerated::Infeasible(pi) => proof = Some(Certificate::Farkas { pi }),
            Enumerated::NoSolution(leaves) => proof = Some(Certificate::Choices { leaves }),
            Enumerated::Limit | Enumerated::Open => {}
        }
        let otherwise = if is_cancelled {
            Status::Cancelled
        } else if is_over(deadline) {
            Status::TimeLimit
        } else if is_limited {
            Status::IterationLimit
        } else {
            Status::NumericalTrouble
        };
        let mut solution = judged_point(problem, t, y, self.tolerance, otherwise);
        solution.basis = basis;
        if let Some(proof) = proof.filter(|it| it.holds(&general)) {
            solution = solution.proved(proof);
        }
        solution.info.method = Method::Enumeration;
        solution.info.pivots = exchanges;
        solution.info.seconds = monitor.seconds();
        Ok(solution)
    }
}
