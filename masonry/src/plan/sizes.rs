//! Sizes of the problem of a model on each route, with all effects or with one of them left out.

use serde::Serialize;

use crate::forms::FormKind;
use crate::method::auto;
use crate::model::{Anchor, JointPoint, Model, PlacedBlock};
use crate::scene::{Form, Route};

/// A route of a plan, with its order and memory.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlannedRoute {
    /// The route of the solution.
    pub route: Route,
    /// The reason why the route has its place in the order of routes.
    pub because: String,
    /// Order of the first complementarity problem of the route, or of the linear systems of the augmented Lagrangian
    /// method.
    pub order: usize,
    /// Order of the largest problem that the route may use.
    pub largest_order: usize,
    /// How many numbers the dense matrices of the route have: matrices of reduction, forms and pivots, and stiffnesses
    /// of blocks. Zero on the sparse routes, which build no dense matrices.
    pub dense_numbers: usize,
    /// Peak memory \[bytes\], estimated from measurements on walls.
    pub memory_bytes: usize,
}

/// The numbers of blocks, points and unknowns of a model, which determine the cost of routes.
#[derive(Debug, Clone)]
pub(super) struct Sizes {
    blocks: usize,
    rigid_blocks: usize,
    /// Number of displacements of the nodes of all elastic blocks.
    pub(super) nodal: usize,
    /// Number of displacements of the elastic block with the finest mesh.
    pub(super) largest_block: usize,
    points: Vec<Point>,
    /// Number of bars of mortar strips, which couple the blocks.
    pub(super) bars: usize,
    /// Whether mortar films are strips.
    strips: bool,
}

/// The properties of a contact point that determine its cost.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is an effect that may be left out")]
pub(super) struct Point {
    /// Whether the point has a normal force.
    pub(super) presses: bool,
    /// Whether the point has a resistance to sliding that grows with the normal force.
    pub(super) coulomb: bool,
    /// Whether the point has a resistance to sliding without a normal force.
    pub(super) cohesive: bool,
    /// Whether the point, if it has a compliance perpendicular to the joint, also has one along the joint.
    pub(super) sheared: bool,
    /// Whether the point has a film of mortar, which has a compliance.
    pub(super) film: bool,
    /// Whether the joint itself has a finite stiffness, and so a compliance.
    pub(super) stiff: bool,
}

impl Point {
    fn of(point: &JointPoint) -> Self {
        Self {
            presses: true,
            coulomb: point.law.mu > 0.0,
            cohesive: point.law.cone().cap().is_some(),
            sheared: point.law.resists_sliding(),
            film: point.film.is_some(),
            stiff: point.compliance.iter().any(|c| *c > 0.0),
        }
    }

    fn gives_way(self) -> bool {
        self.film || self.stiff
    }
}

impl Sizes {
    pub(super) fn of(model: &Model) -> Self {
        let nodal = |block: &PlacedBlock| {
            let mesh = block.mesh.as_ref().filter(|_| block.elasticity.is_some())?;
            Some(2 * mesh.nodes.len())
        };
        let elastic: Vec<usize> = model.blocks.iter().filter_map(nodal).collect();
        Self {
            blocks: model.blocks.len(),
            rigid_blocks: model.blocks.len() - elastic.len(),
            nodal: elastic.iter().sum(),
            largest_block: elastic.iter().copied().max().unwrap_or(0),
            points: model.contacts.iter().map(Point::of).collect(),
            bars: stretching_points(model),
            strips: model.has_strips(),
        }
    }

    /// Returns whether no block is elastic and no joint has a compliance.
    pub(super) fn is_rigid(&self) -> bool {
        self.rigid_blocks == self.blocks && !self.points.iter().any(|it| it.gives_way())
    }

    pub(super) fn rigid_modes(&self) -> usize {
        3 * self.blocks
    }

    /// Counts the points that resist sliding.
    pub(super) fn frictional(&self) -> usize {
        self.count(|it| it.coulomb || it.cohesive)
    }

    fn count(&self, is_such: impl Fn(&Point) -> bool) -> usize {
        self.points.iter().filter(|it| is_such(it)).count()
    }

    /// Counts the rows of the system with a compliance at the points for which `is_such` is true: one row
    /// perpendicular to the joint, and one along the joint if the point is `sheared`.
    pub(super) fn rows(&self, is_such: impl Fn(&Point) -> bool) -> usize {
        self.count(&is_such) + self.count(|it| is_such(it) && it.sheared)
    }

    /// Returns the sizes after `change` is made to every point.
    pub(super) fn with(&self, change: impl Fn(&mut Point)) -> Self {
        let mut changed = self.clone();
        changed.points.iter_mut().for_each(change);
        changed
    }

    pub(super) fn without_films(&self) -> Self {
        self.without_bars().with(|it| it.film = false)
    }

    pub(super) fn without_bars(&self) -> Self {
        Self { bars: 0, strips: false, ..self.clone() }
    }

    /// Returns the sizes for rigid blocks with the same contact points, although some points may exist only because of
    /// a mesh.
    pub(super) fn without_deformation(&self) -> Self {
        Self { rigid_blocks: self.blocks, nodal: 0, largest_block: 0, bars: 0, ..self.clone() }
    }

    pub(super) fn choice(&self, route: Route, form: Form) -> PlannedRoute {
        let points = self.count(|it| it.presses);
        let (coulomb, cohesive) = (self.count(|it| it.coulomb), self.count(|it| it.cohesive));
        let displacements = self.displacements();
        let of_order = |order: usize, memory_bytes: usize| PlannedRoute {
            route,
            because: String::new(),
            order,
            largest_order: order,
            dense_numbers: 0,
            memory_bytes,
        };
        // Cohesion adds a point with a displacement and three pairs.
        let order = displacements + points + 2 * coulomb + 4 * cohesive;
        let bytes = sparse_bytes(displacements, points);
        match route {
            Route::Lemke => self.lemke(form),
            Route::Interior => of_order(order, bytes),
            // There is an edge of the cone for every normal force, and one more with friction; cohesion adds a force
            // between two bounds.
            Route::Forces => of_order(self.rigid_modes() + points + coulomb + 2 * cohesive, bytes),
            // The unknowns of the linear systems are displacements and the deformations of points that give way, except
            // strips.
            Route::Alm => {
                let gives_way = |it: &Point| it.gives_way() && !(self.strips && it.film);
                of_order(self.of_blocks() + self.rows(gives_way), bytes)
            }
            // The matrix of a program, and that of a proof, also have the rows of the contacts.
            Route::Qp => of_order(order, bytes.saturating_mul(6)),
            Route::Pgs => of_order(order, bytes.saturating_add(self.columns(points))),
        }
    }

    /// Returns the number of displacements: of blocks, and of points at which friction and cohesion share the
    /// deformation along the joint.
    fn displacements(&self) -> usize {
        self.of_blocks() + self.count(|it| it.gives_way() && it.coulomb && it.cohesive)
    }

    fn of_blocks(&self) -> usize {
        self.nodal + 3 * self.rigid_blocks
    }

    fn lemke(&self, form: Form) -> PlannedRoute {
        let points = self.count(|it| it.presses);
        let order_of = |kind: &FormKind| {
            points
                + kind.unknowns_per_friction() * self.frictional()
                // Each free unknown, rigid amplitude or bar, is a difference of two nonnegative ones.
                + if *kind == FormKind::Mixed { 2 * (self.rigid_modes() + self.bars) } else { 0 }
        };
        let orders: Vec<usize> = auto::forms(form).iter().map(order_of).collect();
        let largest_order = orders.iter().copied().max().unwrap_or(0);
        // About nine matrices of the largest order at the peak (the problem, its equilibrated copy, the tableau at the
        // start and now, factors), and stiffness and factor of the largest block.
        let square = |n: usize| n.saturating_mul(n);
        let matrices = square(largest_order).saturating_mul(9);
        let dense_numbers = matrices.saturating_add(square(self.largest_block).saturating_mul(3));
        PlannedRoute {
            route: Route::Lemke,
            because: String::new(),
            order: orders[0],
            largest_order,
            dense_numbers,
            memory_bytes: dense_numbers.saturating_mul(size_of::<f64>()),
        }
    }

    /// Estimates the memory of the columns of the sweeps \[bytes\]: each force moves two blocks, or all blocks if bars
    /// couple them.
    fn columns(&self, points: usize) -> usize {
        const PER_NUMBER: usize = 12;
        let forces = points + self.frictional();
        let moved =
            if self.bars > 0 { self.displacements() } else { 2 * self.largest_block.max(3) };
        forces.saturating_mul(moved).saturating_mul(PER_NUMBER)
    }
}

/// Estimates the memory of the sparse routes \[bytes\]: factors of a matrix with the pattern of `K + C^T C` grow with
/// `n log n`, data of the points linearly.
fn sparse_bytes(displacements: usize, points: usize) -> usize {
    const PER_DISPLACEMENT: usize = 150;
    const PER_POINT: usize = 3000;
    let logarithm = displacements.max(2).ilog2() as usize;
    let factors = displacements.saturating_mul(logarithm * PER_DISPLACEMENT);
    factors.saturating_add(points.saturating_mul(PER_POINT))
}

/// Counts the points of strips at elastic blocks, which couple the displacements of the blocks on their two sides.
fn stretching_points(model: &Model) -> usize {
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let strips =
        model.contacts.iter().filter_map(|point| point.film.filter(|it| it.stretch.is_some()));
    strips.filter(|film| film.faces().iter().flatten().any(is_elastic)).count()
}
