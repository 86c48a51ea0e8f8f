//! The plan of an analysis: the effects that a scene uses with reasons, the routes, and the cost.

mod effects;
mod memory;
mod sizes;

use serde::Serialize;

pub use effects::Effect;
pub use memory::TooLarge;
pub use sizes::PlannedRoute;
use sizes::Sizes;

use crate::method::auto::{self, Facts};
use crate::model::Model;
use crate::scene::{Form, Route, Scene};

/// The parts of the equations that a scene needs, and their sizes, determined before anything is assembled.
///
/// Parts that are not needed are not built: there is no mesh and no stiffness without an elastic material, no
/// tangential unknown without friction, no film without a thickness of joints, and no stress if no output shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// The physical effects, such as friction: whether each is on, and why.
    pub effects: Vec<Effect>,
    /// Number of blocks.
    pub blocks: usize,
    /// Number of nodes of all deformable blocks.
    pub nodes: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of contact points, `m`.
    pub contact_points: usize,
    /// Number of contact points with friction.
    pub frictional_points: usize,
    /// Number of rigid amplitudes: three per block. The number of isostatic rows is the same (3.18).
    pub rigid_modes: usize,
    /// Order of the complementarity problem of the first route. The order by Lemke's method is m plus two per
    /// frictional point (3m with friction at all points); in the Stewart-Trinkle form m plus three per frictional
    /// point (4m); in the mixed form additionally two per rigid amplitude and per bar of mortar strips. The order on
    /// the sparse routes is m, two per frictional point, and the number of all displacements.
    pub order: usize,
    /// Order of the largest form of the complementarity problem that the first route may try.
    pub largest_order: usize,
    /// Number of displacement unknowns of the block with the finest mesh.
    pub largest_block: usize,
    /// Number of steps of the load history that are solved: one if the solution does not depend on the load path.
    pub steps: usize,
    /// The solver that will be used.
    pub solver: String,
    /// The reason for this solver.
    pub because: String,
    /// The routes in the order in which they are tried, until one has a result.
    pub routes: Vec<PlannedRoute>,
    /// The reason why the scene is not solved on this machine; `None` if it is solved.
    pub refused: Option<String>,
}

impl Plan {
    /// Makes the plan for a scene and its model.
    pub fn of(scene: &Scene, model: &Model) -> Self {
        let sizes = Sizes::of(model);
        let routes = routes(scene, model, &sizes);
        let PlannedRoute { route, order, largest_order, .. } = routes[0];
        let frictional = sizes.frictional();
        let (solver, because) = solver(route, scene.solver.form, frictional > 0);
        let mut plan = Self {
            effects: effects::of(scene, model, &sizes, &routes[0]),
            blocks: model.blocks.len(),
            nodes: sizes.nodal / 2,
            joints: model.joints.len(),
            contact_points: model.contacts.len(),
            frictional_points: frictional,
            rigid_modes: sizes.rigid_modes(),
            order,
            largest_order,
            largest_block: sizes.largest_block,
            steps: effects::steps(scene, model),
            solver: solver.to_owned(),
            because: because.to_owned(),
            routes,
            refused: None,
        };
        plan.refused = plan.fits().err().map(|error| error.to_string());
        plan
    }

    /// Returns how many numbers the dense matrices have, over all routes that may be used; zero if all routes are
    /// sparse.
    pub fn dense_numbers(&self) -> usize {
        self.routes.iter().map(|choice| choice.dense_numbers).max().unwrap_or(0)
    }

    /// Returns the peak memory \[bytes\] of the route that needs most.
    pub fn memory_bytes(&self) -> usize {
        self.routes.iter().map(|choice| choice.memory_bytes).max().unwrap_or(0)
    }

    /// Checks that the scene fits into the memory of this machine; a scene that does not fit is not solved.
    ///
    /// # Errors
    /// [`TooLarge`] if the scene does not fit.
    pub fn fits(&self) -> Result<(), TooLarge> {
        memory::fits(self.memory_bytes())
    }
}

/// Returns the routes in the order in which they are tried.
fn routes(scene: &Scene, model: &Model, sizes: &Sizes) -> Vec<PlannedRoute> {
    let form = scene.solver.form;
    let facts = Facts {
        at_rest: sizes.is_rigid() && model.contacts.iter().all(|contact| contact.gap.abs() <= 0.0),
        largest_dense: sizes.choice(Route::Lemke, form).largest_order.max(sizes.largest_block),
    };
    let routes = auto::routes(&scene.solver, facts).into_iter();
    routes.map(|(route, because)| PlannedRoute { because, ..sizes.choice(route, form) }).collect()
}

/// Returns the name of the solver of a route, and the reason for using it.
fn solver(route: Route, form: Form, has_friction: bool) -> (&'static str, &'static str) {
    match (route, form) {
        (Route::Forces, _) => {
            ("admissible forces", "one convex program with three unknowns per block")
        }
        (Route::Interior, _) => (
            "interior points",
            "every step factorises one sparse matrix of the order of the displacements",
        ),
        (Route::Qp, _) if has_friction => (
            "quadratic programs",
            "every program has fixed bounds of friction; the fixed point of the bounds is the solution",
        ),
        (Route::Qp, _) => ("quadratic program", "one convex program is enough without friction"),
        (Route::Pgs, _) => (
            "projected Gauss-Seidel sweeps",
            "springs make the stiffness definite, and are re-centred until they carry nothing",
        ),
        (Route::Alm, _) => (
            "augmented Lagrangian method",
            "every iteration solves for the displacements and projects the forces on the friction cones",
        ),
        (_, Form::Auto) if !has_friction => {
            ("lemke", "no joint has friction: the normal contacts alone make a symmetric problem")
        }
        (_, Form::Auto) => (
            "lemke, Coulomb form; if that ends on rays, the mixed form",
            "there may be an equilibrium despite a ray of the Coulomb form, because of friction",
        ),
        (_, Form::Coulomb) => ("lemke, Coulomb form", "solver.form = \"coulomb\""),
        (_, Form::StewartTrinkle) => {
            ("lemke, Stewart-Trinkle form", "solver.form = \"stewart_trinkle\"")
        }
        (_, Form::Mixed) => ("lemke, mixed form", "solver.form = \"mixed\""),
    }
}
