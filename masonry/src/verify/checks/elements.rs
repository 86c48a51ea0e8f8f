//! Equilibrium of the nodes of elastic blocks, computed from their elements.

use nalgebra::Vector2;

use super::{known, larger, relative};
use crate::data::state::State;
use crate::element::quad4;
use crate::material::constitutive;
use crate::model::{Anchor, Model, PlacedBlock};
use crate::recover;
use crate::system::kinematics::{shares, stretched, terms};
use crate::system::nodal_loads;

/// The number of terms in the sum of forces at a node: eight from each of four elements.
const TERMS: f64 = 32.0;

/// The sum of forces at a node, and the sum of the sizes of its terms \[N\]; terms may circulate and cancel.
#[derive(Clone)]
pub(super) struct Nodal {
    force: Vector2<f64>,
    size: f64,
}

impl Nodal {
    fn of(force: Vector2<f64>) -> Self {
        Self { force, size: force.norm() }
    }

    fn add(&mut self, force: Vector2<f64>) {
        self.force += force;
        self.size += force.norm();
    }
}

/// The largest forces at the nodes of an elastic block.
pub(super) struct NodeForces {
    /// The largest unbalanced force \[N\].
    left: f64,
    /// The largest sum of the sizes of loads and contact forces at a node \[N\].
    outside: f64,
    /// The largest sum of the sizes of terms of the elements at a node \[N\]; each term is stiffness times
    /// displacement.
    pub(super) inside: f64,
    /// The number of nodes of the block.
    pub(super) count: usize,
}

impl NodeForces {
    /// Returns the largest unbalanced force, relative to the terms of the elements and the forces from outside \[-\].
    pub(super) fn backward(&self) -> f64 {
        relative(self.left, self.inside.max(self.outside))
    }

    /// Returns the largest unbalanced force at a node, relative to the forces from outside \[-\]; `size` is the sum of
    /// their sizes on the block. An unbalanced force within the rounding errors of the terms of the elements, and of
    /// the forces around the block (`around`), counts as 1e-9 at most.
    pub(super) fn error(&self, size: f64, around: f64) -> f64 {
        // Forces on a block that act elsewhere count as spread over all its nodes.
        let outside = self.outside.max(size / self.count as f64);
        let rounding = around.max(f64::EPSILON * TERMS * self.inside);
        known(self.left, outside, rounding)
    }
}

/// Computes the largest nodal forces of every block; `None` for rigid blocks.
pub(super) fn nodes(model: &Model, state: &State) -> Vec<Option<NodeForces>> {
    let outside = outside(model, state);
    let blocks = model.blocks.iter().zip(&state.displacements).zip(&outside);
    let of_block = |((block, u), outside): ((&PlacedBlock, &Vec<Vector2<f64>>), &Vec<Nodal>)| {
        let inside = inside(model, block, u)?;
        let rest = inside.iter().zip(outside).map(|(a, b)| (a.force - b.force).norm());
        let largest = |list: &[Nodal]| list.iter().map(|it| it.size).fold(0.0, larger);
        Some(NodeForces {
            left: rest.fold(0.0, larger),
            outside: largest(outside),
            inside: largest(&inside),
            count: inside.len(),
        })
    };
    blocks.map(of_block).collect()
}

/// Returns the forces from outside at the nodes of every block: loads, contact forces, and forces of the bars of
/// mortar strips. Empty for rigid blocks.
fn outside(model: &Model, state: &State) -> Vec<Vec<Nodal>> {
    let loads = |block: &PlacedBlock| -> Vec<Nodal> {
        let mesh = block.mesh.as_ref();
        let loads = mesh.map_or_else(Vec::new, |mesh| nodal_loads(model, block, mesh));
        loads.chunks(2).map(|f| Nodal::of(Vector2::new(f[0], f[1]))).collect()
    };
    let mut list: Vec<Vec<Nodal>> = model.blocks.iter().map(loads).collect();
    let mut add = |anchor: Anchor, force: Vector2<f64>| {
        let block = anchor.block.index();
        for (node, part) in shares(&model.blocks[block], anchor) {
            if let Some(nodal) = list[block].get_mut(node) {
                nodal.add(force * part);
            }
        }
    };
    for (contact, it) in model.contacts.iter().zip(&state.contacts) {
        for term in terms(model, contact) {
            add(term.anchor, term.normal * it.t_n + term.tangent * it.t_t);
        }
        // The bar of a strip acts even if the joint is open.
        let stiffness = contact.film.and_then(|film| film.stretch).map_or(0.0, |it| it.stiffness);
        let pull = stiffness * recover::film_elongation(model, &state.displacements, contact);
        for (anchor, along) in stretched(model, contact) {
            add(anchor, along * -pull);
        }
    }
    list
}

/// Computes the forces of the elements on the nodes of a block; `None` for a rigid block.
fn inside(model: &Model, block: &PlacedBlock, u: &[Vector2<f64>]) -> Option<Vec<Nodal>> {
    let (mesh, elasticity) = (block.mesh.as_ref()?, block.elasticity?);
    let d = constitutive(elasticity, model.plane);
    let mut list = vec![Nodal::of(Vector2::zeros()); u.len()];
    for element in &mesh.elements {
        let nodes = element.map(|n| mesh.nodes[n]);
        // Folded elements were refused when the stiffness was built.
        let Some(stiffness) = quad4::stiffness(&nodes, &d, model.thickness) else { continue };
        for (i, node) in element.iter().enumerate() {
            for (j, other) in element.iter().enumerate() {
                list[*node].add(stiffness.fixed_view::<2, 2>(2 * i, 2 * j) * u[*other]);
            }
        }
    }
    Some(list)
}
