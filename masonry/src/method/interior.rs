//! The interior-point route, for walls of many blocks: every step factorises one sparse matrix.
//!
//! Where there seems to be no equilibrium, springs that carry their share of the load however soft they
//! are say so, and how blocks on the softest springs move is the mechanism. That is evidence, and with friction no
//! proof.
//!
//! Where friction keeps the path from an answer, the blocks evolve: friction turns over a short slip, or they move against
//! viscosity from the state before until they rest or flow ([`Evolution`]).

use lcp::{
    ContactState, Evolution, EvolutionSettings, Evolved, Info, InteriorPoint,
    InteriorPointSettings, Iteration, Solution, Solver, Status, WarmStart, Way,
};

use super::sparse::Found;
use super::{Answer, Method, Observer, Request, RouteError, Step, auto, sparse};
use crate::method::forms::Sparse;
use crate::method::info::SolveInfo;
use crate::scene::Route;

/// The route on a sparse problem.
#[derive(Debug, Clone, Copy)]
pub struct Interior<'a> {
    /// The problem.
    pub sparse: &'a Sparse,
    /// The state of a similar problem, whose contacts are tried before anything else.
    pub start: Option<&'a ContactState>,
    /// How that state was found.
    pub way: Way,
}

impl Method for Interior<'_> {
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError> {
        let problem = &self.sparse.problem;
        let start = self.start.map_or(WarmStart::None, |state| {
            let (t, y) = problem.to_pairs(state);
            WarmStart::Point { t, y }
        });
        let mut settings =
            InteriorPointSettings { tolerance: request.tolerance, start, ..Default::default() };
        settings.max_iterations = request.max_steps.unwrap_or(settings.max_iterations);
        let may_move = !problem.frictional().is_empty();
        let is_rigid = problem.stiffness().val().iter().all(|k| k.abs() <= 0.0);
        let mut thorough = settings.clone();
        if may_move {
            // Between steps only the states of the step before are tried.
            settings.max_iterations = match self.start {
                Some(_) => 0,
                None => settings.max_iterations.min(auto::STEPS_BEFORE_MOTION),
            };
            settings.openings.truncate(1);
            settings.continuation = false;
        }
        // Rigid bodies have other states in every step, and where the step before moved this one will.
        let is_hopeless = may_move && self.start.is_some() && (is_rigid || self.way == Way::Motion);
        let path = if is_hopeless { None } else { Some(self.by_path((settings, 0), observer)?) };
        let path = match path {
            Some(answer) if !may_move || is_over(&answer) => return Ok(answer),
            path => path,
        };
        let (moved, is_driven) = self.by_motion(path, request, observer)?;
        if is_over(&moved) || is_driven {
            return Ok(moved);
        }
        // The path that did not get far in a few steps may still get there.
        thorough.continuation = moved.info.status != Status::NoEquilibrium;
        let answer = self.by_path((thorough, moved.info.iterations), observer)?;
        let says_more =
            answer.info.status == Status::Solved || moved.info.status != Status::NoEquilibrium;
        Ok(if says_more { after(&moved.info, answer) } else { moved })
    }
}

impl Interior<'_> {
    /// The answer of the path, after so many other steps.
    fn by_path(
        &self,
        (settings, before): (InteriorPointSettings, usize),
        observer: Observer<'_>,
    ) -> Result<Answer, RouteError> {
        let solver = InteriorPoint::new(settings);
        let problem = &self.sparse.problem;
        let solution = solver.solve_observed(problem, &mut |at| observer(step(at, before)))?;
        Ok(self.answer(solution))
    }

    fn answer(&self, solution: Solution) -> Answer {
        sparse::answer(Route::Interior, self.sparse, Found::of(self.sparse, solution), None)
    }

    /// The answer that a motion leads to, or the `given` one where it says no more; and whether loads that contacts do not
    /// carry drive blocks that flow.
    fn by_motion(
        &self,
        given: Option<Answer>,
        request: &Request,
        observer: Observer<'_>,
    ) -> Result<(Answer, bool), RouteError> {
        let problem = &self.sparse.problem;
        let rest = vec![0.0; problem.displacements()];
        let from = self.start.map_or(&rest, |state| &state.u);
        let mut settings = EvolutionSettings {
            tolerance: request.tolerance,
            at_once: self.way != Way::Motion,
            max_iterations: request.max_steps.unwrap_or(auto::STEPS_OF_MOTION),
            ..EvolutionSettings::default()
        };
        if self.start.is_none() {
            settings.slips = auto::SLIPS_FROM_NOTHING.to_vec();
            // Where the path creeps but has not jammed, smooth friction rests sooner.
            let creeps = given.as_ref().is_some_and(|it| it.info.status == Status::IterationLimit);
            settings.reductions = if creeps { Vec::new() } else { auto::REDUCTIONS.to_vec() };
        }
        let before = given.as_ref().map_or(0, |given| given.info.iterations);
        let evolved = Evolution::new(settings)
            .advance_observed(problem, from, &mut |at| observer(step(at, before)))?;
        let line = described(&evolved);
        let flows = evolved.solution.status == Status::NoEquilibrium;
        let (says_more, is_driven) =
            (evolved.rests() || flows, flows && evolved.motions.carry_load());
        let Info { iterations, factorisations, .. } = evolved.solution.info;
        let answer = match given {
            Some(mut given) if !says_more => {
                if evolved.solution.status == Status::Cancelled {
                    given.info.status = Status::Cancelled;
                }
                given.info.iterations += iterations;
                given.info.factorisations += factorisations;
                given.info.attempts.push(line);
                given
            }
            given => {
                let moved = evolved.from.map(|from| self.slips(from));
                let mut answer = Answer { moved, ..self.answer(evolved.solution) };
                (answer.info.way, answer.info.attempts) = (evolved.way, vec![line]);
                match given {
                    Some(given) => after(&given.info, answer),
                    None => answer,
                }
            }
        };
        Ok((answer, is_driven))
    }

    /// The slips of the points with friction at displacements, as the problem measures them.
    fn slips(&self, u: Vec<f64>) -> Vec<f64> {
        let problem = &self.sparse.problem;
        let none = vec![0.0; problem.points()];
        let state = problem.state(u, none.clone(), none);
        self.sparse.rows(&state).y.split_off(self.sparse.points())
    }
}

/// A step after so many others.
fn step(at: &Iteration, before: usize) -> Step {
    Step::Iteration { number: before + at.iteration, residual: at.residual }
}

/// Whether nothing is left to try.
fn is_over(answer: &Answer) -> bool {
    let status = answer.info.status;
    matches!(status, Status::Solved | Status::Cancelled | Status::Infeasible)
}

/// An answer with what was done before it.
fn after(before: &SolveInfo, mut answer: Answer) -> Answer {
    answer.info.iterations += before.iterations;
    answer.info.factorisations += before.factorisations;
    answer.info.attempts.splice(0..0, before.attempts.iter().cloned());
    answer
}

fn described(evolved: &Evolved) -> String {
    let Info { factorisations, .. } = evolved.solution.info;
    let way = match (evolved.way, evolved.solution.status) {
        (Way::Law, _) => "solved after a start with smooth friction".to_owned(),
        (Way::ReducedFriction, _) => {
            "at rest with coefficients of friction that are slightly smaller".to_owned()
        }
        (Way::SmoothFriction, _) => "at rest with friction that turns over a short slip".to_owned(),
        (_, Status::Solved) => {
            format!(
                "moved against viscosity and came to rest in {} motions",
                evolved.motions.shares.len()
            )
        }
        (_, Status::NoEquilibrium) => format!(
            "flows: {} motions, the last ones of the same length",
            evolved.motions.shares.len()
        ),
        (_, status) => format!("moved against viscosity, {status}"),
    };
    format!("interior: {way}, after {factorisations} factorisations")
}
