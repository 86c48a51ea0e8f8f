//! A route of a plan.

use serde::Serialize;

use crate::scene::Route;

/// A route of a plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Choice {
    /// The route.
    pub route: Route,
    /// Why it has this place.
    pub because: String,
    /// Order of the complementarity problem that it begins with; of the augmented Lagrangian method, of its
    /// linear systems.
    pub order: usize,
    /// Order of the largest problem that it may turn to.
    pub largest_order: usize,
    /// Numbers in its dense matrices: of reduction, forms and pivots, and of the stiffnesses of blocks.
    /// None on the sparse routes, which build none.
    pub dense_numbers: usize,
    /// Memory at the peak \[bytes\], as measured on walls.
    pub memory_bytes: usize,
}
