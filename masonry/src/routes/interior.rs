//! The interior-point route, for walls of many blocks: every step factorises one sparse matrix.
//!
//! Where there seems to be no equilibrium, springs that carry their share of the load however soft they
//! are say so, and how blocks on the softest springs move is the mechanism. That is evidence, and with friction no
//! proof.

use lcp::{InteriorPoint, InteriorPointSettings, Solver};

use super::sparse::Found;
use super::{Answer, Method, Observer, Request, RouteError, sparse};
use crate::forms::Sparse;
use crate::scene::Route;

/// The route on a sparse problem.
#[derive(Debug, Clone, Copy)]
pub struct Interior<'a> {
    /// The problem.
    pub sparse: &'a Sparse,
}

impl Method for Interior<'_> {
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError> {
        let settings = InteriorPointSettings { tolerance: request.tolerance, ..Default::default() };
        let solution = InteriorPoint::new(settings)
            .solve_observed(&self.sparse.problem, &mut |at| observer(at.into()))?;
        Ok(sparse::answer(Route::Interior, self.sparse, Found::of(self.sparse, solution), None))
    }
}
