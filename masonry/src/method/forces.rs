//! The route by statically admissible forces: one convex program without stiffness and gaps.
//!
//! Rigid blocks without gaps, in joints without compliance, are at rest under any such forces, which are then the
//! answer. For all other scenes, the route only decides whether such forces exist, with a proof if they do not.

use lcp::{ContactState, Residuals, Status};

use super::{RouteAnswer, sparse};
use crate::data::info::{RouteAttempt, SolveInfo};
use crate::data::statics::Statics;
use crate::forms::Sparse;
use crate::method::statics::Decision;
use crate::scene::Route;
use crate::system::System;

/// The name of the form of this route in reports.
const FORM: &str = "admissible forces";

/// Returns the answer of the route from the decision on admissible forces; the status is `Solved` if residuals meet
/// `tolerance`.
pub fn answer(
    system: &System,
    sparse: &Sparse,
    decision: &Decision,
    tolerance: f64,
) -> RouteAnswer {
    let problem = &sparse.problem;
    let (status, at_rest) = match &decision.statics {
        Statics::Admissible(forces) if system.is_at_rest() => {
            let (state, residuals) = rested(system, sparse, forces, tolerance);
            let solved = residuals.worst() <= tolerance;
            let status = if solved { Status::Solved } else { Status::AlmostSolved };
            (status, Some((state, residuals)))
        }
        Statics::Impossible(_) => (Status::Infeasible, None),
        Statics::Open if decision.is_cancelled => (Status::Cancelled, None),
        Statics::Admissible(_) | Statics::Open => (Status::Stalled, None),
    };
    let are_found = matches!(decision.statics, Statics::Admissible(_));
    let residuals = at_rest.as_ref().map_or(sparse::UNKNOWN, |(_, residuals)| *residuals);
    let info = SolveInfo {
        form: FORM.to_owned(),
        order: 3 * system.bodies.len() + system.points() + system.friction.len(),
        attempts: vec![RouteAttempt::Forces { status, are_found, factorisations: decision.steps }],
        iterations: decision.steps,
        factorisations: decision.steps,
        proved: status == Status::Infeasible,
        ..SolveInfo::new(Route::Forces, status, residuals)
    };
    let state = at_rest.map(|(state, _)| state).filter(|_| status == Status::Solved);
    RouteAnswer {
        rows: state.as_ref().map(|state| sparse.rows(state)),
        displacements: state.map(|_| vec![0.0; problem.displacements()]),
        ..RouteAnswer::new(info)
    }
}

/// Returns the state of the blocks at rest under given forces of all rows, refined if the residuals do not meet
/// `tolerance`.
fn rested(
    system: &System,
    sparse: &Sparse,
    forces: &[f64],
    tolerance: f64,
) -> (ContactState, Residuals) {
    let problem = &sparse.problem;
    let (normal, friction) = forces.split_at(system.points());
    let rest = vec![0.0; problem.displacements()];
    let state = sparse.with_forces(system, rest, normal, friction);
    let residuals = problem.residuals(&state);
    if residuals.worst() <= tolerance {
        return (state, residuals);
    }
    sparse.refined(&state, tolerance).unwrap_or((state, residuals))
}
