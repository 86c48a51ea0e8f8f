//! The route by projected Gauss-Seidel on the contacts of blocks on springs.
//!
//! The method needs a definite stiffness, which blocks that only touch do not have. So springs hold all displacements.
//! The springs are re-centred at the last solution, round after round (proximal steps, Rockafellar 1976), until forces
//! and displacements solve the problem without springs. Every round starts from the forces of the previous one and is
//! solved only slightly more accurately than the rounds have converged. When the rounds stop converging, the equations
//! of the contact states are solved once; the solution is exact if these states are right.

use std::ops::ControlFlow;

use lcp::{
    Bedding, Contact2d, ContactState, ProjectedGaussSeidel, ProjectedGaussSeidelSettings,
    Residuals, Solver, Status, WarmStart,
};

use super::{Event, EventObserver, Request, RouteAnswer, sparse};
use crate::data::info::{SoftReport, SolveInfo};
use crate::forms::Sparse;
use crate::scene::Route;

/// Stiffness of the auxiliary springs, relative to that of the blocks \[-\], if the scene does not set one. Softer
/// springs need fewer rounds, but more sweeps in each round.
pub const SOFT: f64 = 1e-3;

/// Largest number of rounds.
const MAX_ROUNDS: usize = 2000;
/// Largest number of sweeps in one round.
const SWEEPS: usize = 2000;
/// Ratio of the tolerance of the sweeps in a round to the last residual of the rounds. The ratio is multiplied by this
/// number after every round that did not reduce the residual, down to `LEAST`.
const BETTER: f64 = 0.1;
const LEAST: f64 = 1e-6;
/// Bounds of the tolerance of the sweeps: at most `FIRST`, and at least `LAST` times the tolerance of the route, since
/// the forces of the springs may be much larger than the loads, or `ROUNDING` if that is larger.
const FIRST: f64 = 0.1;
const LAST: f64 = 1e-4;
const ROUNDING: f64 = 1e-14;
/// Part of the tolerance to which the rounds continue: rounds converge linearly, and the error of the displacements may
/// be several times the last residual. If the residual has not decreased by a tenth for `SETTLED` rounds, the tolerance
/// itself suffices.
const NEARER: f64 = 0.1;
const SETTLED: usize = 3;
/// Number of rounds within which the residual must decrease by a tenth.
const PATIENCE: usize = 200;
/// Number of rounds without a decrease by a tenth after which the equations of the contact states are solved.
const IDLE: usize = 20;

/// Solves a sparse problem by rounds of projected Gauss-Seidel sweeps.
///
/// # Errors
/// As [`ProjectedGaussSeidel`].
pub fn solve(
    sparse: &Sparse,
    request: &Request,
    observer: EventObserver<'_>,
) -> Result<RouteAnswer, lcp::Error> {
    let stiffness = request.soft.unwrap_or(SOFT);
    let bedding = Bedding::new(&sparse.problem, stiffness)?;
    let mut rounds = Rounds::new(sparse, &bedding, request.tolerance);
    let status = loop {
        if let Some(status) = rounds.stop(observer) {
            break status;
        }
        if rounds.next(observer)?.is_break() {
            break Status::Cancelled;
        }
        if rounds.idle == IDLE && rounds.finish() {
            break Status::Solved;
        }
    };
    let info = SolveInfo {
        iterations: rounds.done,
        factorisations: rounds.factorisations,
        soft: rounds.report(stiffness),
        ..SolveInfo::new(Route::Pgs, status, rounds.residuals)
    };
    Ok(sparse::answer(sparse, info, rounds.state))
}

/// The rounds, in each of which the springs are re-centred.
struct Rounds<'a> {
    sparse: &'a Sparse,
    problem: &'a Contact2d,
    bedding: &'a Bedding,
    tolerance: f64,
    state: ContactState,
    residuals: Residuals,
    /// Displacements at the end of the first round, and the share of the load that its springs carried.
    first: Option<(Vec<f64>, f64)>,
    /// The share of the load that the springs carried in the last round.
    share: f64,
    done: usize,
    factorisations: usize,
    better: f64,
    least: f64,
    idle: usize,
}

impl<'a> Rounds<'a> {
    fn new(sparse: &'a Sparse, bedding: &'a Bedding, tolerance: f64) -> Self {
        let problem = &sparse.problem;
        let (n, m) = (problem.displacements(), problem.points());
        let state = problem.state(vec![0.0; n], vec![0.0; m], vec![0.0; m]);
        let residuals = problem.residuals(&state);
        Self {
            sparse,
            problem,
            bedding,
            tolerance,
            state,
            residuals,
            first: None,
            share: 0.0,
            done: 0,
            factorisations: 0,
            better: BETTER,
            least: f64::INFINITY,
            idle: 0,
        }
    }

    fn step(&self) -> Event {
        Event::Iteration { number: self.done, residual: self.residual() }
    }

    /// Returns the worst residual, or the share of the load on the springs if that is larger.
    fn residual(&self) -> f64 {
        self.residuals.worst().max(self.share)
    }

    /// Returns the merit of the residuals, or the share of the load on the springs if that is larger.
    fn lack(&self) -> f64 {
        self.residuals.merit().max(self.share)
    }

    /// Sets all displacements to zero, with the same forces, if that state is nearer to a solution: if nothing is
    /// elastic, displacements are rounding errors, and the residuals would compare them with each other.
    fn rest(&mut self) {
        let ContactState { u, t_n, t_t, .. } = &self.state;
        let rest = self.problem.state(vec![0.0; u.len()], t_n.clone(), t_t.clone());
        let residuals = self.problem.residuals(&rest);
        if residuals.worst() < self.residuals.worst() {
            (self.state, self.residuals) = (rest, residuals);
        }
    }

    fn stop(&self, observer: EventObserver<'_>) -> Option<Status> {
        let is_cancelled = observer(self.step()).is_break();
        let residual = self.residual();
        let is_settled = self.idle >= SETTLED || self.done >= MAX_ROUNDS;
        if residual <= NEARER * self.tolerance || (residual <= self.tolerance && is_settled) {
            Some(Status::Solved)
        } else if is_cancelled {
            Some(Status::Cancelled)
        } else if self.done >= MAX_ROUNDS {
            Some(Status::IterationLimit)
        } else {
            (self.idle > PATIENCE).then_some(Status::Stalled)
        }
    }

    fn next(&mut self, observer: EventObserver<'_>) -> Result<ControlFlow<()>, lcp::Error> {
        let centre = &self.state.u;
        let sprung = self.bedding.attached(self.problem, centre)?;
        let (t, y) = self.problem.to_pairs(&self.state);
        let settings = ProjectedGaussSeidelSettings {
            tolerance: (self.better * self.lack())
                .clamp((LAST * self.tolerance).max(ROUNDING), FIRST),
            max_iterations: SWEEPS,
            start: WarmStart::Point { t, y },
            ..Default::default()
        };
        let step = self.step();
        let solution =
            ProjectedGaussSeidel::new(settings).solve_observed(&sprung, &mut |_| observer(step))?;
        self.factorisations += solution.info.factorisations;
        if solution.status == Status::Cancelled {
            return Ok(ControlFlow::Break(()));
        }
        let recovered = || self.problem.recover(&solution.t, &solution.y);
        let state = solution.contact.unwrap_or_else(recovered);
        let forces = self.bedding.forces(&state.u, centre);
        self.share = self.bedding.share(self.problem, &forces);
        self.first.get_or_insert_with(|| (state.u.clone(), self.share));
        self.residuals = self.problem.residuals(&state);
        self.state = state;
        self.rest();
        self.done += 1;
        let lack = self.lack();
        if lack >= self.least {
            self.better = (BETTER * self.better).max(LEAST);
        }
        self.idle = if lack < 0.9 * self.least { 0 } else { self.idle + 1 };
        self.least = self.least.min(lack);
        Ok(ControlFlow::Continue(()))
    }

    /// Solves the equations of the last contact states; keeps the result and returns true if it is a solution.
    fn finish(&mut self) -> bool {
        let refined = self.sparse.refined(&self.state, self.tolerance);
        let is_solved = refined.is_some();
        if let Some(refined) = refined {
            (self.state, self.residuals) = refined;
        }
        is_solved
    }

    fn report(&self, stiffness: f64) -> Option<SoftReport> {
        let (u, share) = self.first.as_ref()?;
        let moved: Vec<f64> = self.state.u.iter().zip(u).map(|(a, b)| a - b).collect();
        let size = self.bedding.size(&self.state.u);
        let change = self.bedding.size(&moved);
        Some(SoftReport {
            stiffness,
            rounds: self.done,
            share: *share,
            displacement_error: (size > 0.0).then(|| change / size),
        })
    }
}
