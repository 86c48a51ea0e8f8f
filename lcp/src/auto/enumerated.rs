//! Enumeration as a method: the last resort for small problems.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::constants::{MOST_PAIRS, MOST_VARIABLES, NODES};
use crate::certify::Residuals;
use crate::enumerate::{Enumerated, Limits, enumerate};
use crate::lower::General;
use crate::{
    Basis, Certificate, Error, HorizontalLcp, Iteration, Method, Observer, Solution, Solver, Status,
};

/// Whether a problem is small enough.
pub(super) fn is_small(general: &HorizontalLcp) -> bool {
    let n = general.order();
    n <= MOST_VARIABLES
        && (0..n).filter(|&pair| general.opposite(pair).is_none()).count() <= MOST_PAIRS
}

/// All choices of sides, with proofs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Enumeration {
    pub(crate) tolerance: f64,
    pub(crate) time_limit: Option<Duration>,
}

impl<P: General> Solver<P> for Enumeration {
    fn method(&self) -> Method {
        Method::Enumeration
    }

    fn solve_observed(&self, problem: &P, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        let general = problem.general();
        if !is_small(&general) {
            return Err(Error::NotTreated {
                method: Method::Enumeration,
                reason: format!("it has more than {MOST_PAIRS} pairs"),
            });
        }
        let began = Instant::now();
        if observer(&Iteration { iteration: 0, residual: f64::INFINITY }) == ControlFlow::Break(())
        {
            return Ok(self.answer(problem, None, (Status::Cancelled, None), began));
        }
        let deadline = self.time_limit.and_then(|limit| began.checked_add(limit));
        let found = enumerate(&general, Limits { nodes: NODES, deadline });
        let is_late = deadline.is_some_and(|deadline| Instant::now() >= deadline);
        let (point, otherwise) = match found {
            Enumerated::Found { t, y, basis } => {
                (Some((t, y, basis)), (Status::NumericalTrouble, None))
            }
            Enumerated::Infeasible(pi) => {
                (None, (Status::Infeasible, Some(Certificate::Farkas { pi })))
            }
            Enumerated::NoSolution(leaves) => {
                (None, (Status::NoSolution, Some(Certificate::Choices { leaves })))
            }
            Enumerated::Open if is_late => (None, (Status::TimeLimit, None)),
            Enumerated::Open => (None, (Status::NumericalTrouble, None)),
        };
        Ok(self.answer(problem, point, otherwise, began))
    }
}

impl Enumeration {
    fn answer<P: General>(
        &self,
        problem: &P,
        point: Option<(Vec<f64>, Vec<f64>, Basis)>,
        (otherwise, certificate): (Status, Option<Certificate>),
        began: Instant,
    ) -> Solution {
        let zero = || vec![0.0; problem.general().order()];
        let (t, y, basis) =
            point.map_or_else(|| (zero(), zero(), None), |(t, y, basis)| (t, y, Some(basis)));
        let residuals: Residuals = problem.residuals_of_pairs(&t, &y);
        let contact = problem.state_of_pairs(&t, &y);
        let is_proved = certificate.is_some();
        let mut solution = Solution::judged((t, y), residuals, self.tolerance, otherwise);
        if is_proved {
            solution.status = otherwise;
        }
        solution.contact = contact;
        solution.basis = basis;
        solution.certificate = certificate;
        solution.info.method = Method::Enumeration;
        solution.info.seconds = began.elapsed().as_secs_f64();
        solution
    }
}
