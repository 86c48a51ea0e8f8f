//! How large the problem of a model is on each route, and what it would be without an effect.

use super::choice::Choice;
use crate::forms::FormKind;
use crate::method::auto;
use crate::model::{Anchor, Block, ContactPoint, Model};
use crate::scene::{Form, Route};

/// Numbers of a model that decide what routes take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sizes {
    pub(super) blocks: usize,
    pub(super) rigid_blocks: usize,
    /// Displacements of the nodes of all elastic blocks.
    pub(super) nodal: usize,
    /// Displacements of the elastic block with the finest mesh.
    pub(super) largest_block: usize,
    pub(super) points: usize,
    /// Points that resist sliding.
    pub(super) frictional: usize,
    /// Those that do so by the normal force,
    coulomb: usize,
    /// and those that do so without one.
    cohesive: usize,
    /// Points of mortar films whose joints have no stiffness of their own,
    in_films: Giving,
    /// of joints with a stiffness and no film,
    in_stiff_joints: Giving,
    /// and of those with both, which are in series and give way together.
    in_both: Giving,
    /// Bars of mortar strips, which couple the blocks.
    pub(super) bars: usize,
    /// Films are whole strips.
    strips: bool,
}

/// Points that give way.
#[derive(Debug, Clone, Copy, Default)]
struct Giving {
    /// All of them, which give way across their joints.
    points: usize,
    /// Those that resist sliding, which give way along them too.
    sheared: usize,
    /// Those that do so by friction and by cohesion, which share what gives way along the joint.
    shared: usize,
}

impl Giving {
    fn of<'a>(points: impl Iterator<Item = &'a ContactPoint>) -> Self {
        points.fold(Self::default(), |it, point| Self {
            points: it.points + 1,
            sheared: it.sheared + usize::from(point.law.resists_sliding()),
            shared: it.shared + usize::from(point.law.mu > 0.0 && point.law.cone().cap().is_some()),
        })
    }

    fn and(self, other: Self) -> Self {
        Self {
            points: self.points + other.points,
            sheared: self.sheared + other.sheared,
            shared: self.shared + other.shared,
        }
    }

    fn without_friction(self) -> Self {
        Self { sheared: 0, shared: 0, ..self }
    }

    fn without_cohesion(self) -> Self {
        Self { shared: 0, ..self }
    }

    /// Rows of the system in which they give way.
    fn rows(self) -> usize {
        self.points + self.sheared
    }
}

impl Sizes {
    pub(super) fn of(model: &Model) -> Self {
        let nodal = |block: &Block| {
            let mesh = block.mesh.as_ref().filter(|_| block.elasticity.is_some())?;
            Some(2 * mesh.nodes.len())
        };
        let of_blocks: Vec<Option<usize>> = model.blocks.iter().map(nodal).collect();
        let elastic = of_blocks.iter().flatten();
        let points = model.contacts.iter();
        let frictional = points.clone().filter(|point| point.law.resists_sliding());
        let giving = |film: bool, stiffness: bool| {
            let has_stiffness = |point: &ContactPoint| point.compliance.iter().any(|c| *c > 0.0);
            let is_such = |point: &&ContactPoint| {
                point.film.is_some() == film && has_stiffness(point) == stiffness
            };
            Giving::of(points.clone().filter(is_such))
        };
        Self {
            blocks: of_blocks.len(),
            rigid_blocks: of_blocks.len() - elastic.clone().count(),
            nodal: elastic.clone().sum(),
            largest_block: elastic.copied().max().unwrap_or(0),
            points: points.len(),
            frictional: frictional.clone().count(),
            coulomb: frictional.clone().filter(|point| point.law.mu > 0.0).count(),
            cohesive: frictional.clone().filter(|point| point.law.cone().cap().is_some()).count(),
            in_films: giving(true, false),
            in_stiff_joints: giving(false, true),
            in_both: giving(true, true),
            bars: stretching_points(model),
            strips: model.has_strips(),
        }
    }

    /// Whether no block is elastic and no joint gives way.
    pub(super) fn is_rigid(&self) -> bool {
        self.rigid_blocks == self.blocks && self.giving().rows() == 0
    }

    pub(super) fn rigid_modes(&self) -> usize {
        3 * self.blocks
    }

    fn giving(&self) -> Giving {
        self.in_films.and(self.in_stiff_joints).and(self.in_both)
    }

    /// Rows of the system in which films give way.
    pub(super) fn of_films(&self) -> usize {
        self.in_films.and(self.in_both).rows()
    }

    /// Rows of the system in which joints themselves give way.
    pub(super) fn of_stiff_joints(&self) -> usize {
        self.in_stiff_joints.and(self.in_both).rows()
    }

    /// Sizes without the normal forces: terms of friction, joints and films at the points remain.
    pub(super) fn without_contact(self) -> Self {
        Self { points: 0, ..self }
    }

    pub(super) fn without_friction(self) -> Self {
        Self {
            frictional: 0,
            coulomb: 0,
            cohesive: 0,
            in_films: self.in_films.without_friction(),
            in_stiff_joints: self.in_stiff_joints.without_friction(),
            in_both: self.in_both.without_friction(),
            ..self
        }
    }

    /// Sizes without cohesion, but with the compliances of points that only cohesion keeps from sliding.
    pub(super) fn without_cohesion(self) -> Self {
        Self {
            frictional: self.coulomb,
            cohesive: 0,
            in_films: self.in_films.without_cohesion(),
            in_stiff_joints: self.in_stiff_joints.without_cohesion(),
            in_both: self.in_both.without_cohesion(),
            ..self
        }
    }

    pub(super) fn without_films(self) -> Self {
        let in_stiff_joints = self.in_stiff_joints.and(self.in_both);
        let none = Giving::default();
        Self { in_films: none, in_both: none, in_stiff_joints, ..self.without_bars() }
    }

    pub(super) fn without_joint_stiffness(self) -> Self {
        let in_films = self.in_films.and(self.in_both);
        Self { in_stiff_joints: Giving::default(), in_both: Giving::default(), in_films, ..self }
    }

    pub(super) fn without_bars(self) -> Self {
        Self { bars: 0, strips: false, ..self }
    }

    /// Sizes for rigid blocks with these points, although a mesh may have brought some of them.
    pub(super) fn without_deformation(self) -> Self {
        Self { rigid_blocks: self.blocks, nodal: 0, largest_block: 0, bars: 0, ..self }
    }

    pub(super) fn choice(&self, route: Route, form: Form) -> Choice {
        let displacements = self.displacements();
        // A point of its own for cohesion, with a displacement and three pairs.
        let order = displacements + self.points + 2 * self.coulomb + 4 * self.cohesive;
        let sparse = Choice {
            route,
            because: String::new(),
            order,
            largest_order: order,
            dense_numbers: 0,
            memory_bytes: self.sparse_bytes(),
        };
        match route {
            Route::Lemke => self.lemke(form),
            Route::Interior => sparse,
            // An edge of the cone for every normal force, and one more with friction; a force between two bounds for
            // cohesion.
            Route::Forces => {
                let order = self.rigid_modes() + self.points + self.coulomb + 2 * self.cohesive;
                Choice { order, largest_order: order, ..sparse }
            }
            // Contact forces are no unknowns of its linear systems, but all that gives way is, except strips.
            Route::Alm => {
                let giving = if self.strips { self.in_stiff_joints } else { self.giving() };
                let order = self.of_blocks() + giving.rows();
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

    fn displacements(&self) -> usize {
        self.of_blocks() + self.giving().shared
    }

    fn of_blocks(&self) -> usize {
        self.nodal + 3 * self.rigid_blocks
    }

    fn lemke(&self, form: Form) -> Choice {
        let order_of = |kind: &FormKind| {
            self.points
                + kind.unknowns_per_friction() * self.frictional
                // Each free unknown, rigid amplitude or bar, is a difference of two nonnegative ones.
                + if *kind == FormKind::Mixed { 2 * (self.rigid_modes() + self.bars) } else { 0 }
        };
        let orders: Vec<usize> = auto::forms(form).iter().map(order_of).collect();
        let largest_order = orders.iter().copied().max().unwrap_or(0);
        // At the peak about nine matrices of the largest order (the problem, its equilibrated copy, the
        // tableau at the start and now, factors), and stiffness and factor of the largest block.
        let square = |n: usize| n.saturating_mul(n);
        let matrices = square(largest_order).saturating_mul(9);
        let dense_numbers = matrices.saturating_add(square(self.largest_block).saturating_mul(3));
        Choice {
            route: Route::Lemke,
            because: String::new(),
            order: orders[0],
            largest_order,
            dense_numbers,
            memory_bytes: dense_numbers.saturating_mul(size_of::<f64>()),
        }
    }

    /// Factors of a matrix of the pattern of `K + C^T C` grow like `n log n`, points linearly.
    fn sparse_bytes(&self) -> usize {
        const PER_DISPLACEMENT: usize = 150;
        const PER_POINT: usize = 3000;
        let displacements = self.displacements();
        let logarithm = displacements.max(2).ilog2() as usize;
        let factors = displacements.saturating_mul(logarithm * PER_DISPLACEMENT);
        factors.saturating_add(self.points.saturating_mul(PER_POINT))
    }

    /// Memory of the sweeps: displacements of two blocks for every force, of all blocks if these are coupled.
    fn columns(&self) -> usize {
        const PER_NUMBER: usize = 12;
        let forces = self.points + self.frictional;
        let moved =
            if self.bars > 0 { self.displacements() } else { 2 * self.largest_block.max(3) };
        forces.saturating_mul(moved).saturating_mul(PER_NUMBER)
    }
}

/// Points of strips at elastic blocks, which couple the displacements of their two sides.
fn stretching_points(model: &Model) -> usize {
    let is_elastic = |face: &[Anchor; 2]| model.blocks[face[0].block.index()].elasticity.is_some();
    let strips =
        model.contacts.iter().filter_map(|point| point.film.filter(|it| it.stretch.is_some()));
    strips.filter(|film| film.faces().iter().flatten().any(is_elastic)).count()
}
