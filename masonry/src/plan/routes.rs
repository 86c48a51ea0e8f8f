//! Which routes a scene is given, in which order, and what they take.

use serde::Serialize;

use super::{film_compliances, stretching_points, unknowns_per_friction};
use crate::model::Model;
use crate::routes::alm::Strips;
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
    let largest = sizes.lemke(form).largest_order.max(sizes.largest_block);
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

/// Numbers of a model that decide what routes take.
pub(super) struct Sizes {
    pub(super) points: usize,
    pub(super) frictional: usize,
    pub(super) rigid_modes: usize,
    pub(super) displacements: usize,
    pub(super) largest_block: usize,
    /// Bars of mortar strips, which couple the blocks.
    bars: usize,
    /// Rows in which films give way.
    compliances: usize,
    /// Films are whole strips.
    strips: bool,
}

impl Sizes {
    pub(super) fn of(model: &Model) -> Self {
        let unknowns = |block: &crate::model::Block| {
            block.mesh.as_ref().filter(|_| block.elasticity.is_some()).map(|it| 2 * it.nodes.len())
        };
        let blocks = model.blocks.iter();
        Self {
            points: model.contacts.len(),
            frictional: model.contacts.iter().filter(|point| point.mu > 0.0).count(),
            rigid_modes: 3 * model.blocks.len(),
            displacements: blocks.clone().map(|block| unknowns(block).unwrap_or(3)).sum::<usize>()
                + film_compliances(model),
            largest_block: blocks.filter_map(unknowns).max().unwrap_or(0),
            bars: stretching_points(model),
            compliances: film_compliances(model),
            strips: Strips::are_in(model),
        }
    }

    fn choice(&self, route: Route, form: Form) -> Choice {
        let sparse = Choice {
            route,
            because: String::new(),
            order: self.displacements + self.points + 2 * self.frictional,
            largest_order: self.displacements + self.points + 2 * self.frictional,
            dense_numbers: 0,
            memory_bytes: self.sparse_bytes(),
        };
        match route {
            Route::Auto | Route::Lemke => self.lemke(form),
            Route::Interior | Route::Newton => sparse,
            // Contact forces are no unknowns of its linear systems, and neither is what strips do.
            Route::Alm => {
                let order = self.displacements - if self.strips { self.compliances } else { 0 };
                Choice { order, largest_order: order, ..sparse }
            }
            // The matrix of a program, and that of a proof, have the rows of the contacts too.
            Route::Qp => Choice { memory_bytes: sparse.memory_bytes.saturating_mul(6), ..sparse },
            Route::Pgs => Choice {
                memory_bytes: sparse.memory_bytes.saturating_add(self.columns()),
                ..sparse
            },
        }
    }

    fn lemke(&self, form: Form) -> Choice {
        let order_of = |form| {
            self.points
                + unknowns_per_friction(form) * self.frictional
                // Each free unknown, rigid amplitude or bar, is a difference of two nonnegative ones.
                + if form == Form::Mixed { 2 * (self.rigid_modes + self.bars) } else { 0 }
        };
        let largest_order = order_of(if form == Form::Auto { Form::Mixed } else { form });
        // At the peak about nine matrices of the largest order (the problem, its equilibrated copy, the
        // tableau at the start and now, factors), and stiffness and factor of the largest block.
        let square = |n: usize| n.saturating_mul(n);
        let matrices = square(largest_order).saturating_mul(9);
        let dense_numbers = matrices.saturating_add(square(self.largest_block).saturating_mul(3));
        Choice {
            route: Route::Lemke,
            because: String::new(),
            order: order_of(form),
            largest_order,
            dense_numbers,
            memory_bytes: dense_numbers.saturating_mul(size_of::<f64>()),
        }
    }

    /// Factors of a matrix of the pattern of `K + C^T C` grow like `n log n`, points linearly.
    fn sparse_bytes(&self) -> usize {
        const PER_DISPLACEMENT: usize = 150;
        const PER_POINT: usize = 3000;
        let logarithm = self.displacements.max(2).ilog2() as usize;
        let factors = self.displacements.saturating_mul(logarithm * PER_DISPLACEMENT);
        factors.saturating_add(self.points.saturating_mul(PER_POINT))
    }

    /// What the sweeps keep: the displacements of two blocks for every force, of all where blocks are coupled.
    fn columns(&self) -> usize {
        const PER_NUMBER: usize = 12;
        let forces = self.points + self.frictional;
        let moved = if self.bars > 0 { self.displacements } else { 2 * self.largest_block.max(3) };
        forces.saturating_mul(moved).saturating_mul(PER_NUMBER)
    }
}
