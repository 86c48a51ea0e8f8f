//! The route by Newton's method on the states of the contacts: every step factorises one sparse matrix.

use lcp::{SemismoothNewton, SemismoothNewtonSettings, Solver};

use super::sparse::Found;
use super::{Answer, Method, Observer, Request, RouteError, sparse};
use crate::method::forms::Sparse;
use crate::scene::Route;

/// The route on a sparse problem.
#[derive(Debug, Clone, Copy)]
pub struct Newton<'a> {
    /// The problem.
    pub sparse: &'a Sparse,
}

impl Method for Newton<'_> {
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError> {
        let settings =
            SemismoothNewtonSettings { tolerance: request.tolerance, ..Default::default() };
        let solution = SemismoothNewton::new(settings)
            .solve_observed(&self.sparse.problem, &mut |at| observer(at.into()))?;
        Ok(sparse::answer(Route::Newton, self.sparse, Found::of(self.sparse, solution), None))
    }
}
