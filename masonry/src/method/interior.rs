//! The interior-point route, for walls of many blocks: every step factorises one sparse matrix.
//!
//! If there is friction and the path of the interior-point method ends without an answer, blocks with mass move under
//! their loads until they rest or fall ([`Evolution`](lcp::Evolution)). In later steps of a load history, they always
//! move, from the end of the previous step. If there is no friction, soft springs decide whether there is an
//! equilibrium.

use lcp::{
    Contact2d, ContactState, InteriorPoint, InteriorPointSettings, Iteration, Solver, Status,
    WarmStart,
};

use super::loading::{self, Led, Loading};
use super::{Event, EventObserver, Request, RouteAnswer, sparse};
use crate::data::info::{RouteAttempt, SolveInfo, Way};
use crate::data::motion::Motion;
use crate::forms::Sparse;
use crate::scene::Route;

/// The interior-point route on a sparse problem.
#[derive(Debug, Clone, Copy)]
pub struct Interior<'a> {
    /// The sparse problem.
    pub sparse: &'a Sparse,
    /// The problem before the step, with its loads, gaps and supports, and the state in which the blocks rest under
    /// them; `None` if nothing has acted yet.
    pub before: Option<(&'a Contact2d, &'a ContactState)>,
    /// The mass of every displacement \[kg\].
    pub mass: &'a [f64],
    /// The largest distance that blocks may move \[m\].
    pub reach: f64,
    /// Contact states that are tried before the path of the interior-point method.
    pub start: &'a WarmStart,
}

impl Interior<'_> {
    /// Looks for a solution, or moves the blocks until they rest or fall.
    ///
    /// # Errors
    /// As [`InteriorPoint`] and [`Evolution`](lcp::Evolution).
    pub fn solve(
        &self,
        request: &Request,
        observer: EventObserver<'_>,
    ) -> Result<RouteAnswer, lcp::Error> {
        let problem = &self.sparse.problem;
        let Request { tolerance, max_steps, .. } = *request;
        let may_move = !problem.frictional().is_empty();
        if may_move && self.before.is_some() {
            return self.led(None, request, observer);
        }
        let solver = if may_move {
            loading::path(tolerance, max_steps, self.start)
        } else {
            let defaults = InteriorPointSettings::default();
            let max_iterations = max_steps.unwrap_or(defaults.max_iterations);
            InteriorPoint::new(InteriorPointSettings { tolerance, max_iterations, ..defaults })
        };
        let solution = solver.solve_observed(problem, &mut |at| observer(step(at, 0)))?;
        let path = sparse::solved(Route::Interior, self.sparse, solution);
        let is_over =
            matches!(path.info.status, Status::Solved | Status::Cancelled | Status::Infeasible);
        if is_over || !may_move { Ok(path) } else { self.led(Some(path), request, observer) }
    }

    /// Moves the blocks under their loads until they rest or fall; `path` is the answer of the path before, if there is
    /// one.
    fn led(
        &self,
        path: Option<RouteAnswer>,
        request: &Request,
        observer: EventObserver<'_>,
    ) -> Result<RouteAnswer, lcp::Error> {
        let Self { sparse, before, mass, reach, .. } = *self;
        let problem = &sparse.problem;
        let tolerance = request.tolerance.min(request.step_tolerance);
        let taken = path.as_ref().map_or(0, |path| path.info.iterations);
        let slowness = request.slowness;
        let loading = Loading { before, problem, mass, reach, slowness, tolerance };
        let led = loading.lead(&mut |at| observer(step(at, taken)))?;
        let mut answer = self.answer_of(led)?;
        if let Some(path) = path {
            let SolveInfo { iterations, factorisations, attempts, .. } = &mut answer.info;
            *iterations += path.info.iterations;
            *factorisations += path.info.factorisations;
            attempts.splice(0..0, path.info.attempts);
        }
        Ok(answer)
    }

    fn answer_of(&self, led: Led) -> Result<RouteAnswer, lcp::Error> {
        let Led { ending, evolution, iterations } = led;
        let (state, slips) = (evolution.state().clone(), evolution.slips_before());
        let residuals = self.sparse.problem.slid(slips)?.residuals(&state);
        let factorisations = evolution.factorisations();
        let is_one_step = ending.rests() && evolution.steps() == 1;
        let info = SolveInfo {
            iterations,
            factorisations,
            way: if is_one_step { Way::Law } else { Way::Motion },
            ..SolveInfo::new(Route::Interior, ending.status(), residuals)
        };
        let mut answer = sparse::answer(self.sparse, info, state);
        answer.info.attempts = vec![RouteAttempt::Motion { ending, factorisations }];
        answer.account = Some(*evolution.account());
        answer.moved = Some(self.sparse.by_rows(slips));
        if answer.info.status == Status::NoEquilibrium {
            answer.motion = Some(Motion::Velocities(evolution.velocity().to_vec()));
        }
        Ok(answer)
    }
}

/// Returns the event for a step of the solver, whose number comes after `before` earlier steps.
fn step(at: &Iteration, before: usize) -> Event {
    Event::Iteration { number: before + at.iteration, residual: at.residual }
}
