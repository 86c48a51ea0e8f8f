//! Which routes a scene is given, in which order, and what they take.

use super::choice::Choice;
use super::sizes::Sizes;
use crate::method::auto::{self, Facts};
use crate::model::Model;
use crate::scene::{Route, Scene};

/// The routes in the order in which they are tried.
pub(super) fn of(scene: &Scene, model: &Model, sizes: &Sizes) -> Vec<Choice> {
    let form = scene.solver.form;
    let facts = Facts {
        at_rest: sizes.is_rigid() && model.contacts.iter().all(|contact| contact.gap.abs() <= 0.0),
        largest_dense: sizes.choice(Route::Lemke, form).largest_order.max(sizes.largest_block),
    };
    let routes = auto::routes(&scene.solver, facts).into_iter();
    routes.map(|(route, because)| Choice { because, ..sizes.choice(route, form) }).collect()
}
