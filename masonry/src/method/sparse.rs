//! Common code of the routes on the sparse problem: answers in the shape of all routes.

use lcp::{Contact2d, ContactState, Residuals, Solution, Status};

use super::Answer;
use crate::data::info::{SoftReport, SolveInfo};
use crate::data::motion::Motion;
use crate::forms::Sparse;
use crate::scene::Route;

/// The name of the problem in reports, in the place of a form.
const FORM: &str = "contact";

/// Residuals of what was never tried.
pub(crate) const UNKNOWN: Residuals = Residuals {
    equation: f64::INFINITY,
    feasibility: f64::INFINITY,
    complementarity: f64::INFINITY,
    natural: f64::INFINITY,
    loads: f64::INFINITY,
};

/// The result of a method on the sparse problem.
pub(crate) struct Found {
    pub(crate) status: Status,
    pub(crate) state: ContactState,
    pub(crate) residuals: Residuals,
    pub(crate) iterations: usize,
    pub(crate) factorisations: usize,
    /// Farkas' vector, in the rows of the general problem.
    pub(crate) proof: Option<Vec<f64>>,
}

impl Found {
    pub(crate) fn of(sparse: &Sparse, solution: Solution<Contact2d>) -> Self {
        Self {
            proof: solution.farkas().map(<[f64]>::to_vec),
            status: solution.status,
            state: solution
                .contact
                .unwrap_or_else(|| sparse.problem.recover(&solution.t, &solution.y)),
            residuals: solution.residuals,
            iterations: solution.info.iterations,
            factorisations: solution.info.factorisations,
        }
    }
}

/// The answer of a route.
pub(crate) fn answer(
    route: Route,
    sparse: &Sparse,
    found: Found,
    soft: Option<SoftReport>,
) -> Answer {
    let problem = &sparse.problem;
    let info = SolveInfo {
        form: FORM.to_owned(),
        order: problem.order(),
        attempts: vec![describe(route, &found)],
        iterations: found.iterations,
        factorisations: found.factorisations,
        proved: found.proof.is_some(),
        soft,
        ..SolveInfo::new(route, found.status, found.residuals)
    };
    // In the rows of the displacements a proof is a motion on which the loads do more work than the contacts can take.
    let motion = found.proof.map(|mut proof| {
        proof.truncate(problem.displacements());
        proof
    });
    let state = (found.status == Status::Solved).then_some(found.state);
    Answer {
        rows: state.as_ref().map(|state| sparse.rows(state)),
        displacements: state.map(|state| state.u),
        motion: motion.map(Motion::Displacements),
        ..Answer::new(info)
    }
}

fn describe(route: Route, found: &Found) -> String {
    let end = match found.status {
        Status::Solved => "solved".to_owned(),
        Status::Infeasible => "proved to have no solution".to_owned(),
        status => status.to_string(),
    };
    let counted = match route {
        Route::Qp => "programs",
        Route::Pgs => "rounds",
        Route::Alm => "iterations",
        _ => "steps",
    };
    format!(
        "{}: {end} after {} {counted} and {} factorisations, residual {:.1e}",
        route.name(),
        found.iterations,
        found.factorisations,
        found.residuals.worst()
    )
}
