//! Common code of the routes on the sparse problem, which converts solutions to the answers of routes.

use lcp::{Contact2d, ContactState, Residuals, Solution, Status};

use super::RouteAnswer;
use crate::data::info::{RouteAttempt, SolveInfo};
use crate::data::motion::Motion;
use crate::forms::Sparse;
use crate::scene::Route;

/// The name of the sparse form in reports.
const FORM: &str = "contact";

/// The residuals of a record if no solve was tried.
pub(crate) const UNKNOWN: Residuals = Residuals {
    equation: f64::INFINITY,
    feasibility: f64::INFINITY,
    complementarity: f64::INFINITY,
    natural: f64::INFINITY,
    loads: f64::INFINITY,
};

/// Returns the answer of a route from a solution of the sparse problem.
pub(crate) fn solved(route: Route, sparse: &Sparse, solution: Solution<Contact2d>) -> RouteAnswer {
    let problem = &sparse.problem;
    // The entries of a proof for the displacements are a motion on which the loads do more work than the contacts can
    // take.
    let motion =
        solution.farkas().map(|it| it.iter().take(problem.displacements()).copied().collect());
    let info = SolveInfo {
        iterations: solution.info.iterations,
        factorisations: solution.info.factorisations,
        proved: motion.is_some(),
        ..SolveInfo::new(route, solution.status, solution.residuals)
    };
    let recovered = || problem.recover(&solution.t, &solution.y);
    let state = solution.contact.unwrap_or_else(recovered);
    RouteAnswer { motion: motion.map(Motion::Displacements), ..answer(sparse, info, state) }
}

/// Returns the answer of a route from a state and the record of the route; the state is kept only if it is solved.
pub(crate) fn answer(sparse: &Sparse, info: SolveInfo, state: ContactState) -> RouteAnswer {
    let attempt = RouteAttempt::Sparse {
        route: info.route,
        status: info.status,
        iterations: info.iterations,
        factorisations: info.factorisations,
        residual: info.residuals.worst(),
    };
    let state = (info.status == Status::Solved).then_some(state);
    RouteAnswer {
        rows: state.as_ref().map(|state| sparse.rows(state)),
        displacements: state.map(|state| state.u),
        ..RouteAnswer::new(SolveInfo {
            form: FORM.to_owned(),
            order: sparse.problem.order(),
            attempts: vec![attempt],
            ..info
        })
    }
}
