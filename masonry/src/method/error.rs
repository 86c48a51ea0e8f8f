//! Why a route did not begin.

use crate::scene::Route;

/// A request that a route refuses.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RouteError {
    /// The solver refused its settings or the data.
    #[error(transparent)]
    Solver(#[from] lcp::Error),
    /// The route cannot treat the structure.
    #[error("{} cannot treat this problem: {reason}", .route.name())]
    NotTreated {
        /// The route.
        route: Route,
        /// The reason, and what to use instead.
        reason: String,
    },
}
