//! Runs the routes of a plan one after another, each on its own form of the problem, until one gives a final result.

use std::cmp::Ordering;
use std::ops::ControlFlow;
use web_time::Instant;

use lcp::{Contact2d, Status, WarmStart};

use super::{Event, SolveError, named};
use crate::analysis::clock::Clock;
use crate::data::info::{RouteAttempt, RouteRecord, SolveInfo};
use crate::data::state::State;
use crate::data::statics::Statics;
use crate::forms::reduction::Reduction;
use crate::forms::{Sparse, Start};
use crate::method::auto;
use crate::method::forces;
use crate::method::interior::Interior;
use crate::method::lemke::Pivots;
use crate::method::loading;
use crate::method::statics::{self, Decision};
use crate::method::{EventObserver, Request, RouteAnswer, pgs, qp};
use crate::model::Model;
#[cfg(feature = "paper")]
use crate::paper::alm;
use crate::plan::PlannedRoute;
use crate::recover;
use crate::scene::Route;
use crate::system::{System, mass};
use crate::verify::checks::Checks;
use crate::verify::step::{LoadingEnd, StepResult};
use crate::verify::verdict::Drift;

/// The state from which a step of a load history starts.
pub(super) struct Before<'a> {
    /// The problem with the loads, gaps and supports at the start of the step, with slips measured from `state`.
    pub(super) problem: Contact2d,
    pub(super) state: &'a State,
    /// The basis at which the pivots of the previous step ended; `None` without pivots.
    pub(super) basis: Option<&'a Start>,
}

/// A model that is solved by several routes, one after another.
pub(super) struct Chain<'a> {
    pub(super) model: &'a Model,
    pub(super) system: &'a System,
    pub(super) request: Request,
    pub(super) with_stresses: bool,
    pub(super) clock: &'a mut Clock,
    pub(super) observer: &'a mut dyn FnMut(Event) -> ControlFlow<()>,
    pub(super) before: Option<Before<'a>>,
    sparse: Option<Sparse>,
    /// The decision whether there are admissible forces; `None` until it is made, at most once.
    decision: Option<Decision>,
    /// Whether a proof that there are no admissible forces would end the current route.
    may_be_cut: bool,
}

impl<'a> Chain<'a> {
    pub(super) fn new(
        model: &'a Model,
        system: &'a System,
        request: Request,
        with_stresses: bool,
        clock: &'a mut Clock,
        observer: &'a mut dyn FnMut(Event) -> ControlFlow<()>,
    ) -> Self {
        Self {
            model,
            system,
            request,
            with_stresses,
            clock,
            observer,
            before: None,
            sparse: None,
            decision: None,
            may_be_cut: false,
        }
    }

    /// Tries the routes in their order. Returns the most conclusive result, with the attempts of all routes, and the
    /// sparse problem, if it was built.
    pub(super) fn run(
        mut self,
        routes: &[PlannedRoute],
    ) -> Result<(StepResult, Option<Sparse>), SolveError> {
        let has_friction = !self.system.friction.is_empty();
        let (mut ends, mut attempts, mut pivots) = (Vec::new(), Vec::new(), 0);
        let mut best: Option<StepResult> = None;
        let mut refusal = None;
        for (position, PlannedRoute { route, because, largest_order, .. }) in
            routes.iter().enumerate()
        {
            if best.as_ref().is_some_and(|best| !auto::is_asked(*route, best.rank())) {
                continue;
            }
            let limit = auto::max_pivots(*route, *largest_order, routes.len());
            self.request.max_pivots = self.request.max_pivots.or(limit);
            self.may_be_cut =
                auto::may_be_cut(routes[position + 1..].iter().map(|choice| choice.route));
            let began = Instant::now();
            let tried = self.attempt(*route);
            let end = match &tried {
                Ok(tried) => tried.info.status.to_string(),
                Err(error) => format!("refused: {error}"),
            };
            let (because, seconds) = (because.clone(), began.elapsed().as_secs_f64());
            ends.push(RouteRecord { route: *route, because: because.clone(), end, seconds });
            let mut tried = match tried {
                Ok(tried) => tried,
                // The next route may treat a structure that this route refused.
                Err(error) => {
                    refusal = refusal.or(Some(error));
                    continue;
                }
            };
            tried.info.because = because;
            attempts.append(&mut tried.info.attempts);
            pivots += tried.info.pivots;
            let is_cancelled = tried.info.status == Status::Cancelled;
            let is_final = tried.rank().is_final(has_friction) || is_cancelled;
            if is_cancelled || best.as_ref().is_none_or(|best| tried.rank() < best.rank()) {
                best = Some(tried);
            }
            if is_final {
                break;
            }
        }
        let mut best = match (best, refusal) {
            (Some(best), _) => best,
            (None, Some(refusal)) => return Err(refusal),
            (None, None) => unreachable!("every plan has a route"),
        };
        (best.info.routes, best.info.attempts, best.info.pivots) = (ends, attempts, pivots);
        self.add_statics(&mut best);
        self.add_loading(&mut best)?;
        Ok((best, self.sparse))
    }

    /// Adds the decision whether any forces balance the loads, if the verdict needs it.
    fn add_statics(&mut self, best: &mut StepResult) {
        let is_far =
            best.state.as_ref().is_some_and(|state| Drift::of(self.model, state).is_large());
        if !auto::needs_statics(best.info.status, is_far, self.system.is_at_rest()) {
            return;
        }
        // The decision stays open if data overflow.
        best.statics = self.statics().ok().map(|decision| decision.statics.clone());
        if let Some(Statics::Impossible(proof)) = &best.statics {
            best.mechanism.get_or_insert_with(|| proof.rates.clone());
        }
    }

    /// Loads rigid blocks with admissible forces slowly from a state without stresses, if the verdict needs this
    /// loading.
    fn add_loading(&mut self, best: &mut StepResult) -> Result<(), SolveError> {
        let has_friction = !self.system.friction.is_empty();
        if !auto::needs_loading(best.info.status, self.system.is_at_rest(), has_friction) {
            return Ok(());
        }
        let mut model = self.model.clone();
        model.give_stiffness_to_dry_joints();
        let system = System::without_factors(&model)?;
        let sparse = Sparse::new(&system)?;
        let mass = &mass::lumped(&model, &system);
        let reach = loading::reach(&model);
        let start = &match &best.statics {
            Some(Statics::Admissible(forces)) => sparse.start_of(&system, forces),
            _ => WarmStart::None,
        };
        let interior = Interior { sparse: &sparse, before: None, mass, reach, start };
        self.may_be_cut = false;
        let RouteAnswer { info, motion, .. } =
            self.timed(|request, observer| interior.solve(request, observer))?;
        best.info.attempts.extend(info.attempts);
        best.info.factorisations += info.factorisations;
        let end = match info.status {
            Status::Solved => LoadingEnd::ToRest,
            Status::NoEquilibrium => LoadingEnd::ToFall,
            _ => LoadingEnd::Nowhere,
        };
        best.loading = Some(end);
        if end == LoadingEnd::ToFall {
            let motion = motion.as_ref();
            best.mechanism = motion
                .and_then(|motion| recover::mechanism(&model, &system, Some(&sparse), motion));
        }
        Ok(())
    }

    /// Returns the decision whether there are admissible forces, and makes it if necessary.
    fn statics(&mut self) -> Result<&Decision, lcp::Error> {
        if self.decision.is_none() {
            let (model, system, observer) = (self.model, self.system, &mut *self.observer);
            let _ = observer(Event::Phase("solve"));
            let began = Instant::now();
            let decision = statics::decide(model, system, &mut |at| observer(at.into()))?;
            self.clock.add("solve", began);
            self.decision = Some(decision);
        }
        Ok(self.decision.as_ref().unwrap_or_else(|| unreachable!("it was just decided")))
    }

    fn attempt(&mut self, route: Route) -> Result<StepResult, SolveError> {
        match route {
            Route::Lemke => self.by_pivots(),
            Route::Forces => self.by_forces(),
            _ => self.on_sparse(route),
        }
    }

    fn by_forces(&mut self) -> Result<StepResult, SolveError> {
        let sparse = self.sparse()?;
        let (system, tolerance) = (self.system, self.request.tolerance);
        let decision = self.statics()?;
        let answer = forces::answer(system, &sparse, decision, tolerance);
        let state = self.recovered(self.model, &sparse, &answer);
        self.sparse = Some(sparse);
        Ok(self.concluded(self.model, answer, state))
    }

    fn by_pivots(&mut self) -> Result<StepResult, SolveError> {
        let Self { model, system, .. } = *self;
        let reduction = self
            .clock
            .time("reduction", self.observer, || Reduction::new(system, None))
            .map_err(|error| named(error, model))?;
        let start = self.before.as_ref().and_then(|before| before.basis);
        let pivots = Pivots { system, reduction: &reduction, start };
        let answer = self.timed(|request, observer| pivots.solve(request, observer))?;
        let with_stresses = self.with_stresses;
        let state = answer.rows.as_ref().map(|rows| {
            self.clock.time("recovery", self.observer, || {
                recover::recover(model, system, &reduction, rows, with_stresses)
            })
        });
        let mut tried = self.concluded(model, answer, state);
        if tried.info.status == Status::AlmostSolved {
            self.refine(&mut tried)?;
        }
        Ok(tried)
    }

    /// Solves the equations of the contact states of a result again, with all displacements as unknowns, because the
    /// reduced forms lose digits if bricks are flat or friction is huge. The given result is kept unless the new one
    /// passes the checks.
    fn refine(&mut self, result: &mut StepResult) -> Result<(), SolveError> {
        let Self { model, system, .. } = *self;
        let Some(state) = &result.state else { return Ok(()) };
        let sparse = self.sparse()?;
        let given = sparse.state(model, system, state);
        let tolerance = self.request.tolerance;
        let refined =
            self.clock.time("refinement", self.observer, || sparse.refined(&given, tolerance));
        if let Some((refined, residuals)) = refined {
            let rows = sparse.rows(&refined);
            let state = recover::from_displacements(
                model,
                system,
                &sparse,
                &rows,
                &refined.u,
                tolerance,
                self.with_stresses,
            );
            let checks = Checks::of(model, &state);
            if checks.hold(tolerance) {
                let info = &mut result.info;
                (info.status, info.residuals) = (Status::Solved, residuals);
                info.attempts.push(RouteAttempt::Refinement { residual: residuals.worst() });
                (result.state, result.checks) = (Some(state), Some(checks));
            }
        }
        self.sparse = Some(sparse);
        Ok(())
    }

    fn on_sparse(&mut self, route: Route) -> Result<StepResult, SolveError> {
        let Self { model, system, .. } = *self;
        let has_compliances = route != Route::Alm;
        let sparse =
            if has_compliances { self.sparse()? } else { Sparse::with_free_faces(system)? };
        let answer = match route {
            Route::Qp => self.timed(|request, observer| qp::solve(&sparse, request, observer)),
            Route::Pgs => self.timed(|request, observer| pgs::solve(&sparse, request, observer)),
            #[cfg(feature = "paper")]
            Route::Alm if model.has_strips() => self.timed(|request, observer| {
                alm::by_films(model, system, &sparse, request, observer)
            }),
            #[cfg(feature = "paper")]
            Route::Alm => {
                self.timed(|request, observer| alm::by_multipliers(&sparse, request, observer))
            }
            #[cfg(not(feature = "paper"))]
            Route::Alm => {
                let reason =
                    "the route needs the feature `paper`: add this feature, or take another route";
                return Err(SolveError::NotTreated { route, reason: reason.to_owned() });
            }
            _ => {
                let given = self.before.take();
                let state = given.as_ref().map(|it| sparse.state(model, system, it.state));
                let before = given.as_ref().map(|it| &it.problem).zip(state.as_ref());
                let mass = &mass::lumped(model, system);
                let reach = loading::reach(model);
                let start = &WarmStart::None;
                let interior = Interior { sparse: &sparse, before, mass, reach, start };
                let answer = self.timed(|request, observer| interior.solve(request, observer));
                self.before = given;
                answer
            }
        };
        let mut answer = answer?;
        if let Some(Decision { statics: Statics::Impossible(_), .. }) = &self.decision
            && answer.info.status == Status::Cancelled
        {
            let SolveInfo { status, attempts, iterations, .. } = &mut answer.info;
            *status = Status::Stalled;
            *attempts = vec![RouteAttempt::Left { route, iterations: *iterations }];
        }
        let is_at_rest = answer.account.is_some() && answer.info.status == Status::Solved;
        answer.moved = answer.moved.take().map(|moved| self.by_contact(moved));
        let after = answer.moved.as_ref().map(|moved| model.slid(moved));
        let model = after.as_ref().unwrap_or(model);
        let state = self.recovered(model, &sparse, &answer);
        if has_compliances {
            self.sparse = Some(sparse);
        }
        let tried = self.concluded(model, answer, state);
        match self.excess(&tried) {
            Some(excess) if is_at_rest && excess > 1.0 && excess.is_finite() => {
                Ok(self.finer(route, excess, tried))
            }
            _ => Ok(tried),
        }
    }

    /// Repeats the steps to a state at rest with a finer tolerance: half of the usual one, divided by `excess`, the
    /// factor by which the checks exceed their tolerance. Errors that remain are rounding errors, so that no still
    /// finer steps follow. The first state is kept if the second is not better.
    fn finer(&mut self, route: Route, excess: f64, rough: StepResult) -> StepResult {
        if self.request.step_tolerance < loading::STEP_TOLERANCE {
            return rough;
        }
        self.request.step_tolerance = 0.5 * loading::STEP_TOLERANCE / excess;
        // The first answer is kept if finer steps cannot be taken.
        let Ok(finer) = self.on_sparse(route) else { return rough };
        let is_nearer = self.excess(&finer).is_some_and(|it| it < excess);
        let is_better = match finer.rank().cmp(&rough.rank()) {
            Ordering::Less => true,
            Ordering::Equal => is_nearer,
            Ordering::Greater => finer.info.status == Status::Cancelled,
        };
        let (mut best, other) = if is_better { (finer, rough) } else { (rough, finer) };
        let (info, other) = (&mut best.info, other.info);
        info.iterations += other.iterations;
        info.factorisations += other.factorisations;
        info.attempts.splice(0..0, other.attempts);
        best
    }

    /// Returns the factor by which the checks exceed their tolerance; `None` if there is no state to check.
    fn excess(&self, tried: &StepResult) -> Option<f64> {
        tried.checks.as_ref().map(|checks| checks.excess(self.request.tolerance))
    }

    /// Lists a slip for every contact point from the slips of the points with friction; all other slips are zero.
    fn by_contact(&self, moved: Vec<f64>) -> Vec<f64> {
        let mut slips = vec![0.0; self.model.contacts.len()];
        for (friction, slip) in self.system.friction.iter().zip(moved) {
            slips[friction.contact.index()] = slip;
        }
        slips
    }

    /// Recovers the mechanical state from the answer of a route on the sparse problem.
    fn recovered(&mut self, model: &Model, sparse: &Sparse, answer: &RouteAnswer) -> Option<State> {
        let Self { system, with_stresses, .. } = *self;
        let (rows, u) = answer.rows.as_ref().zip(answer.displacements.as_deref())?;
        let tolerance = self.request.tolerance;
        Some(self.clock.time("recovery", self.observer, || {
            recover::from_displacements(model, system, sparse, rows, u, tolerance, with_stresses)
        }))
    }

    /// Returns the sparse problem, which is built once; the caller stores it in `self.sparse` again after use.
    fn sparse(&mut self) -> Result<Sparse, lcp::Error> {
        let system = self.system;
        match self.sparse.take() {
            Some(sparse) => Ok(sparse),
            None => self.clock.time("sparse form", self.observer, || Sparse::new(system)),
        }
    }

    fn timed<E: Into<SolveError>>(
        &mut self,
        solve: impl FnOnce(&Request, EventObserver<'_>) -> Result<RouteAnswer, E>,
    ) -> Result<RouteAnswer, SolveError> {
        let (model, system, observer) = (self.model, self.system, &mut *self.observer);
        let _ = observer(Event::Phase("solve"));
        let began = Instant::now();
        let (mut may_be_cut, decision) = (self.may_be_cut, &mut self.decision);
        let answer = solve(&self.request, &mut |step| {
            let is_long = matches!(step, Event::Iteration { number, .. } if number >= auto::STEPS_BEFORE_PROOF);
            if may_be_cut && is_long {
                may_be_cut = false;
                *decision = statics::decide(model, system, &mut |_| observer(step)).ok();
                if let Some(Decision { statics: Statics::Impossible(_), .. }) = decision {
                    return ControlFlow::Break(());
                }
            }
            observer(step)
        });
        self.clock.add("solve", began);
        answer.map_err(E::into)
    }

    fn concluded(&self, model: &Model, answer: RouteAnswer, state: Option<State>) -> StepResult {
        let checks = state.as_ref().map(|state| Checks::of(model, state));
        let RouteAnswer { mut info, basis, motion, moved, account, .. } = answer;
        // The complementarity problem may be solved to its tolerance although the structure is not, because forces and
        // displacements of very different size are in one vector.
        if checks.as_ref().is_some_and(|checks| !checks.hold(self.request.tolerance)) {
            info.status = Status::AlmostSolved;
        }
        let mechanism = motion.and_then(|motion| {
            recover::mechanism(self.model, self.system, self.sparse.as_ref(), &motion)
        });
        StepResult { state, checks, mechanism, basis, moved, account, ..StepResult::new(info) }
    }
}
