//! The plan: which effects a scene calls for, why, and what they cost.

mod effects;

use serde::Serialize;

use crate::model::Model;
use crate::scene::{Form, Scene};

/// One physical effect, on or off, and the reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Name of the effect, such as `friction`.
    pub name: &'static str,
    /// Whether it is built.
    pub on: bool,
    /// What in the scene calls for it, or what is missing.
    pub because: String,
    /// Unknowns that it adds.
    pub unknowns: usize,
}

/// What will be built for a scene, known before anything is assembled.
///
/// Nothing that is off is built: no mesh and no stiffness without an elastic material, no
/// tangential unknowns without friction, no films without a thickness of joints, no stresses when no output shows them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// Effects, each with its reason.
    pub effects: Vec<Effect>,
    /// Number of blocks.
    pub blocks: usize,
    /// Number of nodes of all deformable blocks.
    pub nodes: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of contact points (m).
    pub contact_points: usize,
    /// Number of contact points with friction.
    pub frictional_points: usize,
    /// Rigid amplitudes: three per block, and as many isostatic rows (3.18).
    pub rigid_modes: usize,
    /// Order of the complementarity problem: m, and two more per frictional point (3m); in the
    /// Stewart-Trinkle form three more (4m), in the mixed form also two per rigid amplitude.
    pub order: usize,
    /// Order of the largest form that the solver may turn to.
    pub largest_order: usize,
    /// Displacement unknowns of the block with the finest mesh.
    pub largest_block: usize,
    /// The solver that will be used.
    pub solver: String,
    /// Why this solver.
    pub because: String,
}

impl Plan {
    /// The plan for a scene and the model made of it.
    pub fn of(scene: &Scene, model: &Model) -> Self {
        let contact_points = model.contacts.len();
        let frictional_points = model.contacts.iter().filter(|point| point.mu > 0.0).count();
        let rigid_modes = 3 * model.blocks.len();
        let form = scene.solver.form;
        let order_of = |form| {
            contact_points
                + unknowns_per_friction(form) * frictional_points
                // Each free rigid amplitude is a difference of two nonnegative unknowns.
                + if form == Form::Mixed { 2 * rigid_modes } else { 0 }
        };
        let last = if form == Form::Auto { Form::Mixed } else { form };
        let (solver, because) = solver(form, frictional_points);
        Self {
            effects: effects::of(scene, model),
            blocks: model.blocks.len(),
            nodes: nodes(model),
            joints: model.joints.len(),
            contact_points,
            frictional_points,
            rigid_modes,
            order: order_of(form),
            largest_order: order_of(last),
            largest_block: 2 * block_nodes(model).max().unwrap_or(0),
            solver: solver.to_owned(),
            because: because.to_owned(),
        }
    }

    /// Memory \[bytes\] at the peak: about nine dense matrices of the largest order that the pivoting
    /// solver may come to (the problem, its equilibrated copy, the tableau at the start and now,
    /// factors), as measured on walls, and the stiffness and factor of the largest block.
    pub fn dense_bytes(&self) -> usize {
        let square = |n: usize| n.saturating_mul(n);
        let matrices = square(self.largest_order).saturating_mul(9);
        let stiffness = square(self.largest_block).saturating_mul(3);
        matrices.saturating_add(stiffness).saturating_mul(size_of::<f64>())
    }
}

/// Unknowns that a frictional point has besides its normal force.
fn unknowns_per_friction(form: Form) -> usize {
    match form {
        Form::Auto | Form::Coulomb => 2,
        Form::StewartTrinkle | Form::Mixed => 3,
    }
}

fn nodes(model: &Model) -> usize {
    block_nodes(model).sum()
}

fn block_nodes(model: &Model) -> impl Iterator<Item = usize> {
    model.blocks.iter().filter_map(|block| block.mesh.as_ref()).map(|mesh| mesh.nodes.len())
}

fn solver(form: Form, frictional_points: usize) -> (&'static str, &'static str) {
    match form {
        Form::Auto if frictional_points == 0 => {
            ("lemke", "no joint has friction: the normal contacts alone make a symmetric problem")
        }
        Form::Auto => (
            "lemke, Coulomb form; mixed form if it ends on rays",
            "with friction a ray of the Coulomb form does not mean that there is no equilibrium",
        ),
        Form::Coulomb => ("lemke, Coulomb form", "solver.form = \"coulomb\""),
        Form::StewartTrinkle => {
            ("lemke, Stewart-Trinkle form", "solver.form = \"stewart_trinkle\"")
        }
        Form::Mixed => ("lemke, mixed form", "solver.form = \"mixed\""),
    }
}
