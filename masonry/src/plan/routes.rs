//! Which routes a scene is given, in which order, and what they take.

use serde::Serialize;

use super::sizes::Sizes;
use crate::model::Model;
use crate::policy::{self, Facts};
use crate::scene::{Route, Scene};

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

/// The routes in the order in which they are tried.
pub(super) fn of(scene: &Scene, model: &Model, sizes: &Sizes) -> Vec<Choice> {
    let form = scene.solver.form;
    let facts = Facts {
        at_rest: sizes.is_rigid() && model.contacts.iter().all(|contact| contact.gap.abs() <= 0.0),
        largest_dense: sizes.choice(Route::Lemke, form).largest_order.max(sizes.largest_block),
    };
    let routes = policy::routes(&scene.solver, facts).into_iter();
    routes.map(|(route, because)| Choice { because, ..sizes.choice(route, form) }).collect()
}
