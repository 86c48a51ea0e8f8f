//! Common code of the routes on the sparse problem: answers in the shape of all routes.

use lcp::{Contact2d, ContactState, Residuals, Solution, Status};

use super::RouteAnswer;
use crate::data::info::{RouteAttempt, SolveInfo};
use crate::data::motion::Motion;
use crate::forms::Sparse;
use crate::scene::Route;

/// The name of the problem in reports, in the place of a form.
const FORM: &str = "contact";

/// Residuals if no solve was tried.
pub(crate) const UNKNOWN: Residuals = Residuals {
    equation: f64::INFINITY,
    feasibility: f64::INFINITY,
    complementarity: f64::INFINITY,
    natural: f64::INFINITY,
    loads: f64::INFINITY,
};

/// The answer of a solution.
pub(crate) fn solved(route: Route, sparse: &Sparse, solution: Solution<Contact2d>) -> RouteAnswer {
    let problem = &sparse.problem;
    // In the rows of the displacements, a proof is a motion on which the loads do more work than the contacts can
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

/// The answer of a state, with the record of its route.
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
