//! One route after the other, each with what it is built on, until one has the answer.

use std::ops::ControlFlow;
use std::time::Instant;

use lcp::Status;
use nalgebra::Vector2;

use super::{Clock, Event, SolveError, named};
use crate::check::Checks;
use crate::forms::{Sparse, Start};
use crate::model::Model;
use crate::outcome::{RouteEnd, SolveInfo, State};
use crate::plan::Choice;
use crate::recover;
use crate::reduction::Reduction;
use crate::routes::alm::{Multipliers, Strips};
use crate::routes::interior::Interior;
use crate::routes::lemke::Pivots;
use crate::routes::newton::Newton;
use crate::routes::pgs::Sweeps;
use crate::routes::qp::Programs;
use crate::routes::{Answer, Method, Request, Step};
use crate::scene::Route;
use crate::system::System;

/// What a route came to.
pub(super) struct Attempt {
    pub(super) info: SolveInfo,
    pub(super) state: Option<State>,
    pub(super) checks: Option<Checks>,
    pub(super) mechanism: Option<Vec<[Vector2<f64>; 4]>>,
    pub(super) basis: Option<Start>,
}

/// How much an attempt says; what comes first says more.
#[derive(PartialEq, PartialOrd)]
enum Rank {
    Solved,
    /// There is none, with a proof, or with springs or a ray that show how it falls.
    Proved,
    Springs,
    Mechanism,
    /// Something was found that does not hold.
    Almost,
    Open,
}

impl Attempt {
    fn rank(&self) -> Rank {
        match self.info.status {
            Status::Solved => Rank::Solved,
            Status::Infeasible if self.info.proved => Rank::Proved,
            Status::NoEquilibrium if self.info.springs.is_some() => Rank::Springs,
            _ if self.mechanism.is_some() => Rank::Mechanism,
            Status::AlmostSolved => Rank::Almost,
            _ => Rank::Open,
        }
    }

    /// Whether no other route has more to say. Without friction a proof may follow what springs show.
    fn is_final(&self, has_friction: bool) -> bool {
        match self.rank() {
            Rank::Solved | Rank::Proved | Rank::Mechanism => true,
            Rank::Springs => has_friction,
            Rank::Almost | Rank::Open => self.info.status == Status::Cancelled,
        }
    }
}

/// A model on its way through the routes.
pub(super) struct Chain<'a> {
    pub(super) model: &'a Model,
    pub(super) system: &'a System,
    pub(super) request: Request,
    pub(super) with_stresses: bool,
    pub(super) clock: &'a mut Clock,
    pub(super) observer: &'a mut dyn FnMut(Event) -> ControlFlow<()>,
    /// The basis of the step before.
    start: Option<Start>,
    sparse: Option<Sparse>,
}

impl<'a> Chain<'a> {
    pub(super) fn new(
        (model, system): (&'a Model, &'a System),
        (request, with_stresses): (Request, bool),
        start: Option<Start>,
        clock: &'a mut Clock,
        observer: &'a mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Self {
        Self { model, system, request, with_stresses, clock, observer, start, sparse: None }
    }

    /// The attempt that says most; with all lines of all of them.
    pub(super) fn run(mut self, routes: &[Choice]) -> Result<Attempt, SolveError> {
        let has_friction = !self.system.friction.is_empty();
        let (mut ends, mut lines, mut pivots) = (Vec::new(), Vec::new(), 0);
        let mut best: Option<Attempt> = None;
        let mut refusal = None;
        for choice in routes {
            let began = Instant::now();
            let mut end = |end: String| {
                let seconds = began.elapsed().as_secs_f64();
                let because = choice.because.clone();
                ends.push(RouteEnd { route: choice.route, because, end, seconds });
            };
            match self.attempt(choice.route) {
                Ok(mut attempt) => {
                    attempt.info.because.clone_from(&choice.because);
                    end(attempt.info.status.to_string());
                    lines.append(&mut attempt.info.attempts);
                    pivots += attempt.info.pivots;
                    let is_final = attempt.is_final(has_friction);
                    let is_better = best.as_ref().is_none_or(|best| attempt.rank() < best.rank());
                    if is_better || attempt.info.status == Status::Cancelled {
                        best = Some(attempt);
                    }
                    if is_final {
                        break;
                    }
                }
                Err(error) if error.is_refusal() => {
                    end(match &error {
                        SolveError::Solver(error) => format!("refused: {error}"),
                        other => format!("refused: {other}"),
                    });
                    refusal = Some(error);
                }
                Err(error) => return Err(error),
            }
        }
        let mut best = match (best, refusal) {
            (Some(best), _) => best,
            (None, Some(refusal)) => return Err(refusal),
            (None, None) => unreachable!("every plan has a route"),
        };
        best.info.routes = ends;
        best.info.attempts = lines;
        best.info.pivots = pivots;
        Ok(best)
    }

    fn attempt(&mut self, route: Route) -> Result<Attempt, SolveError> {
        if matches!(route, Route::Auto | Route::Lemke) {
            self.by_pivots()
        } else {
            self.on_sparse(route)
        }
    }

    fn by_pivots(&mut self) -> Result<Attempt, SolveError> {
        let Self { model, system, .. } = *self;
        let reduction = self
            .clock
            .time("reduction", self.observer, || Reduction::new(system, None))
            .map_err(|error| named(error, model))?;
        let start = self.start.take();
        let pivots = Pivots { system, reduction: &reduction, start: start.as_ref() };
        let answer = self.timed(&pivots)?;
        let with_stresses = self.with_stresses;
        let state = answer.rows.as_ref().map(|rows| {
            self.clock.time("recovery", self.observer, || {
                recover::recover(model, system, &reduction, rows, with_stresses)
            })
        });
        let attempt = self.concluded(answer, state);
        if attempt.info.status == Status::AlmostSolved {
            self.refined(attempt)
        } else {
            Ok(attempt)
        }
    }

    /// The answer on the states of its contacts, solved anew with all displacements as unknowns: the reduced
    /// forms lose digits of flat bricks, and of huge friction. As it was, where that is no better.
    fn refined(&mut self, mut attempt: Attempt) -> Result<Attempt, SolveError> {
        let Self { model, system, .. } = *self;
        let Some(state) = &attempt.state else { return Ok(attempt) };
        let sparse = self.sparse()?;
        let problem = &sparse.problem;
        let given = sparse.state((model, system), state);
        let tolerance = self.request.tolerance;
        let verified = self.clock.time("refinement", self.observer, || problem.verify(&given));
        // States that overflow are not refined.
        let refined = verified.ok().map(|it| it.refined.rounded(problem));
        let judged = refined.map(|state| (problem.residuals(&state), state));
        if let Some((residuals, refined)) = judged.filter(|(it, _)| it.worst() <= tolerance) {
            let state = recover::from_displacements(
                (model, system, &sparse),
                (&sparse.rows(&refined), &refined.u),
                tolerance,
                self.with_stresses,
            );
            let checks = Checks::of(model, &state);
            if checks.hold(tolerance) {
                attempt.info.status = Status::Solved;
                attempt.info.residuals = residuals;
                attempt.info.attempts.push(format!(
                    "refined on all displacements, residual {:.1e}",
                    residuals.worst()
                ));
                (attempt.state, attempt.checks) = (Some(state), Some(checks));
            }
        }
        self.sparse = Some(sparse);
        Ok(attempt)
    }

    fn on_sparse(&mut self, route: Route) -> Result<Attempt, SolveError> {
        let Self { model, system, .. } = *self;
        let sparse = self.sparse()?;
        let answer = match route {
            Route::Newton => self.timed(&Newton { sparse: &sparse }),
            Route::Qp => self.timed(&Programs { sparse: &sparse }),
            Route::Pgs => self.timed(&Sweeps { sparse: &sparse }),
            Route::Alm if Strips::are_in(model) => {
                self.timed(&Strips { model, system, sparse: &sparse })
            }
            Route::Alm => self.timed(&Multipliers { sparse: &sparse }),
            _ => self.timed(&Interior { sparse: &sparse }),
        };
        let answer = answer?;
        let (tolerance, with_stresses) = (self.request.tolerance, self.with_stresses);
        let found = answer.rows.as_ref().zip(answer.displacements.as_deref());
        let state = found.map(|(rows, u)| {
            self.clock.time("recovery", self.observer, || {
                recover::from_displacements(
                    (model, system, &sparse),
                    (rows, u),
                    tolerance,
                    with_stresses,
                )
            })
        });
        self.sparse = Some(sparse);
        Ok(self.concluded(answer, state))
    }

    /// The sparse problem, built once; who takes it gives it back.
    fn sparse(&mut self) -> Result<Sparse, lcp::Error> {
        let system = self.system;
        match self.sparse.take() {
            Some(sparse) => Ok(sparse),
            None => self.clock.time("sparse form", self.observer, || Sparse::new(system)),
        }
    }

    fn timed(&mut self, method: &dyn Method) -> Result<Answer, SolveError> {
        let observer = &mut *self.observer;
        let _ = observer(Event::Phase("solve"));
        let began = Instant::now();
        let answer = method.solve(&self.request, &mut |step| {
            observer(match step {
                Step::Pivots(progress) => Event::Pivots(progress),
                Step::Iteration { number, residual } => Event::Iteration { number, residual },
            })
        });
        self.clock.add("solve", began);
        Ok(answer?)
    }

    fn concluded(&self, answer: Answer, state: Option<State>) -> Attempt {
        let checks = state.as_ref().map(|state| Checks::of(self.model, state));
        let mut info = answer.info;
        // The complementarity problem may be solved to its tolerance and the structure not: forces and
        // displacements of very different size meet in one vector.
        if checks.as_ref().is_some_and(|checks| !checks.hold(self.request.tolerance)) {
            info.status = Status::AlmostSolved;
        }
        let motion = answer.motion.as_ref();
        let mechanism = motion.and_then(|motion| {
            recover::mechanism(self.model, self.system, self.sparse.as_ref(), motion)
        });
        Attempt { info, state, checks, mechanism, basis: answer.basis }
    }
}
