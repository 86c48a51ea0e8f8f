//! The interior-point route, for walls of many blocks: every step factorises one sparse matrix.
//!
//! Where there seems to be no equilibrium, springs that carry their share of the load however soft they
//! are say so, and how blocks on the softest springs move is the mechanism. That is evidence, and with friction no
//! proof.

use lcp::{ContactState, InteriorPoint, InteriorPointSettings, Solver, WarmStart};

use super::sparse::Found;
use super::{Answer, Method, Observer, Request, RouteError, sparse};
use crate::method::forms::Sparse;
use crate::scene::Route;

/// The route on a sparse problem.
#[derive(Debug, Clone, Copy)]
pub struct Interior<'a> {
    /// The problem.
    pub sparse: &'a Sparse,
    /// The state of a similar problem, whose contacts are tried before anything else.
    pub start: Option<&'a ContactState>,
}

impl Method for Interior<'_> {
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError> {
        let start = self.start.map_or(WarmStart::None, |state| {
            let (t, y) = self.sparse.problem.to_pairs(state);
            WarmStart::Point { t, y }
        });
        let settings =
            InteriorPointSettings { tolerance: request.tolerance, start, ..Default::default() };
        let solution = InteriorPoint::new(settings)
            .solve_observed(&self.sparse.problem, &mut |at| observer(at.into()))?;
        Ok(sparse::answer(Route::Interior, self.sparse, Found::of(self.sparse, solution), None))
    }
}
