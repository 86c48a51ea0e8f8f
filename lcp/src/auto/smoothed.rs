//! The smoothed continuation as a method: the last resort for problems on which pivots end on a ray.

use std::time::{Duration, Instant};

use super::constants::{STARTS, STEPS};
use crate::lower::{General, judged_by, judged_point};
use crate::smoothing::{Limits, follow};
use crate::solve::Monitor;
use crate::{
    Covering, Error, Lemke, LemkeSettings, Method, Observer, Solution, Solver, Status, WarmStart,
};

/// Newton's method on smoothed equations, from several starts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Smoothing {
    pub(crate) tolerance: f64,
    pub(crate) time_limit: Option<Duration>,
}

impl<P: General> Solver<P> for Smoothing {
    fn method(&self) -> Method {
        Method::Smoothing
    }

    fn solve_observed(&self, problem: &P, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        let general = problem.general();
        let mut monitor = Monitor::new(usize::MAX, self.time_limit, observer);
        let deadline = monitor.deadline();
        let mut best: Option<Solution> = None;
        let mut status = Status::Stalled;
        for start in 0..STARTS {
            let residual = best.as_ref().map_or(f64::INFINITY, |best| best.residuals.worst());
            if let Some(stopped) = monitor.stop(residual) {
                status = stopped;
                break;
            }
            let Some(found) = follow(&general, start, Limits { steps: STEPS, deadline }) else {
                continue;
            };
            // The sides that it suggests, as a basis that may be the solution itself.
            let settings = LemkeSettings {
                tolerance: self.tolerance,
                time_limit: deadline.map(|it| it.saturating_duration_since(Instant::now())),
                start: WarmStart::Basis(found.basis),
                covering: Covering::Ones,
                max_attempts: 1,
                prove_infeasible: false,
                ..LemkeSettings::default()
            };
            let solution = Lemke::new(settings).solve(general.as_ref())?;
            let mut solution = judged_by(problem, solution, self.tolerance);
            solution.contact = problem.state_of_pairs(&solution.t, &solution.y);
            let point = judged_point(problem, (found.t, found.y), self.tolerance, Status::Stalled);
            if !solution.is_solved() && point.residuals.worst() < solution.residuals.worst() {
                // The basis may be singular, and the point right.
                solution = point;
            }
            solution.certificate = None;
            let is_solved = solution.is_solved();
            let worst = solution.residuals.worst();
            if best.as_ref().is_none_or(|best| worst < best.residuals.worst()) {
                best = Some(solution);
            }
            if is_solved {
                break;
            }
        }
        let mut solution = best.unwrap_or_else(|| {
            let zero = vec![0.0; general.order()];
            judged_point(problem, (zero.clone(), zero), self.tolerance, status)
        });
        if !solution.is_solved() && solution.status != Status::AlmostSolved {
            solution.status = status;
        }
        solution.info.method = Method::Smoothing;
        solution.info.seconds = monitor.seconds();
        Ok(solution)
    }
}
