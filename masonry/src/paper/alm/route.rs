//! The augmented Lagrangian method as a route of scenes.

use lcp::Error;

use super::{AlmError, Settings, solve};
use crate::data::info::SolveInfo;
use crate::forms::Sparse;
use crate::method::sparse;
use crate::method::{Answer, Method, Observer, Request, RouteError, RouteProgress};
use crate::scene::Route;

/// The route on a sparse problem.
#[derive(Debug, Clone, Copy)]
pub struct Multipliers<'a> {
    /// The problem.
    pub sparse: &'a Sparse,
}

impl Method for Multipliers<'_> {
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError> {
        let problem = &self.sparse.problem;
        let settings = Settings { tolerance: request.tolerance, ..Settings::default() };
        let mut number = 0;
        let answer = solve(problem, &settings, &mut |at| {
            number += 1;
            observer(RouteProgress::Iteration { number, residual: at.unbalance })
        })?;
        let info = SolveInfo {
            iterations: answer.convergence.len(),
            factorisations: answer.factorisations,
            convergence: answer.convergence,
            ..SolveInfo::new(Route::Alm, answer.status, answer.residuals)
        };
        let mut answer = sparse::answer(self.sparse, info, answer.state);
        answer.info.order = problem.displacements();
        Ok(answer)
    }
}

impl From<AlmError> for RouteError {
    fn from(error: AlmError) -> Self {
        match error {
            AlmError::Tolerance { tolerance } => {
                Error::Setting { name: "tolerance", value: tolerance, range: "in (0, 1)" }.into()
            }
            AlmError::Data(error) => error.into(),
            other => Self::NotTreated { route: Route::Alm, reason: other.to_string() },
        }
    }
}
