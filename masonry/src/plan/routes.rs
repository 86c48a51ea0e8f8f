//! Which routes a scene is given, in which order, and what they take.

use serde::Serialize;

use super::sizes::Sizes;
use crate::routes::pgs;
use crate::scene::{Form, Route, Scene};

/// Dense matrices of the reduced problem and of blocks up to this order take seconds; the time grows with
/// the cube.
const FEW: usize = 4000;

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
pub(super) fn of(scene: &Scene, sizes: &Sizes) -> Vec<Choice> {
    let form = scene.solver.form;
    let largest = sizes.choice(Route::Lemke, form).largest_order.max(sizes.largest_block);
    let given = |route: Route| format!("solver.route = \"{}\"", route.name());
    let list = match scene.solver.route {
        Route::Auto if form != Form::Auto => {
            vec![(Route::Lemke, "solver.form is given, which is a form of this route".to_owned())]
        }
        Route::Auto if scene.solver.max_pivots.is_some() => {
            vec![(Route::Lemke, "solver.max_pivots is given, which limits this route".to_owned())]
        }
        Route::Auto if largest <= FEW => vec![
            (
                Route::Lemke,
                format!(
                    "pivots take seconds on dense matrices of order up to {FEW}, and the largest is of \
                     order {largest}"
                ),
            ),
            (Route::Interior, "where pivots end without equilibrium and mechanism".to_owned()),
            (Route::Qp, "where the interior points come to no end either".to_owned()),
        ],
        Route::Auto => vec![
            (
                Route::Interior,
                format!(
                    "pivots are slow on dense matrices of order above {FEW}, and the largest would be of \
                     order {largest}; the sparse problem takes tens of factorisations"
                ),
            ),
            (Route::Qp, "where the interior points come to no end".to_owned()),
        ],
        route @ (Route::Lemke | Route::Interior | Route::Newton | Route::Qp | Route::Alm) => {
            vec![(route, given(route))]
        }
        Route::Pgs if scene.solver.soft.is_some() => vec![(Route::Pgs, given(Route::Pgs))],
        Route::Pgs => vec![(
            Route::Pgs,
            format!(
                "{}; blocks float, so springs hold them, solver.soft = {}",
                given(Route::Pgs),
                pgs::SOFT
            ),
        )],
    };
    list.into_iter()
        .map(|(route, because)| Choice { because, ..sizes.choice(route, form) })
        .collect()
}
