//! Values of an answer that are unique, so that they can be compared: forces at nodes, stresses, energy.

use nalgebra::Vector2;
use serde::Serialize;

use crate::data::state::State;
use crate::geometry;
use crate::model::{Anchor, Model, PlacedBlock};
use crate::recover;
use crate::rounding::largest;

/// Errors of an answer relative to a reference \[-\]. An error is `None` if the reference has only zeros.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// Largest error of a component of the contact forces on the blocks, relative to the largest component. The forces
    /// are summed at every node of an elastic block, and to a resultant on a rigid block. Forces that circulate between
    /// blocks around one place are not unique and not included.
    pub force: Option<f64>,
    /// Largest error of a component of stress at the centre of an element, relative to the largest component.
    pub stress: Option<f64>,
    /// Error of the strain energy, relative to the strain energy of the reference.
    pub energy: Option<f64>,
}

impl Errors {
    /// Computes the errors of an answer relative to another answer for the same model.
    pub fn of(model: &Model, state: &State, reference: &State) -> Self {
        Figures::of(model, state).errors(&Figures::of(model, reference))
    }

    /// Returns the largest of the errors; `None` if there are none.
    pub fn worst(&self) -> Option<f64> {
        [self.force, self.stress, self.energy].into_iter().flatten().reduce(f64::max)
    }
}

/// The values of an answer that are unique if displacements are.
#[derive(Debug, Clone)]
pub(super) struct Figures {
    /// Contact forces \[N\] on every block: at the nodes of an elastic block; the resultant force, and its moment
    /// divided by the size of the block, on a rigid block.
    forces: Vec<Vec<f64>>,
    /// Components of stress \[Pa\] at the centres of all elements.
    stresses: Vec<f64>,
    /// Strain energy \[J\].
    energy: f64,
}

/// A block counts as unloaded if no contact force on it is larger than this part of the largest contact force on any
/// block.
const IDLE: f64 = 1e-6;

impl Figures {
    pub(super) fn of(model: &Model, state: &State) -> Self {
        Self {
            forces: forces_on_blocks(model, state),
            stresses: state.stresses.iter().flat_map(|stress| stress.sigma).collect(),
            energy: state.strain_energy,
        }
    }

    pub(super) fn errors(&self, reference: &Self) -> Errors {
        let [forces, expected] = [self, reference].map(|it| it.forces.concat());
        Errors {
            force: relative(&forces, &expected),
            stress: relative(&self.stresses, &reference.stresses),
            energy: relative(&[self.energy], &[reference.energy]),
        }
    }

    /// Returns for each block whether it carries load; a block that is loose in its gaps has no unique place.
    pub(super) fn loaded_blocks(&self) -> Vec<bool> {
        let most: Vec<f64> = self.forces.iter().map(largest).collect();
        let all = largest(&most);
        most.into_iter().map(|most| most > IDLE * all).collect()
    }
}

/// Computes the contact forces on the blocks: `C^T t` for elastic blocks, and `N^T C^T t` for rigid ones.
fn forces_on_blocks(model: &Model, state: &State) -> Vec<Vec<f64>> {
    let numbers = |block: &PlacedBlock| elastic_nodes(block).map_or(3, |nodes| 2 * nodes);
    let mut forces: Vec<Vec<f64>> =
        model.blocks.iter().map(|block| vec![0.0; numbers(block)]).collect();
    for (contact, found) in model.contacts.iter().zip(&state.contacts) {
        let on_b = recover::contact_force(model, contact, found);
        for (anchor, force) in [(Some(contact.b), on_b), (contact.a, -on_b)] {
            if let Some(anchor) = anchor {
                let block = anchor.block.index();
                add(&mut forces[block], &model.blocks[block], anchor, force);
            }
        }
    }
    forces
}

fn add(forces: &mut [f64], block: &PlacedBlock, anchor: Anchor, force: Vector2<f64>) {
    let Anchor { edge, at, .. } = anchor;
    if let (Some(_), Some(mesh)) = (block.elasticity, &block.mesh) {
        for (node, share) in mesh.interpolate(edge, at) {
            forces[2 * node] += share * force.x;
            forces[2 * node + 1] += share * force.y;
        }
    } else {
        let arm = geometry::on_edge(&block.corners, edge, at) - geometry::centroid(&block.corners);
        let size = (block.corners[2] - block.corners[0]).norm();
        forces[0] += force.x;
        forces[1] += force.y;
        forces[2] += (arm.x * force.y - arm.y * force.x) / size;
    }
}

fn elastic_nodes(block: &PlacedBlock) -> Option<usize> {
    block.mesh.as_ref().filter(|_| block.elasticity.is_some()).map(|mesh| mesh.nodes.len())
}

/// Returns the largest difference between values and a reference, divided by the largest value of the reference; `None`
/// if that is zero or the lengths differ.
pub(super) fn relative(values: &[f64], reference: &[f64]) -> Option<f64> {
    let size = largest(reference);
    let differences = values.iter().zip(reference).map(|(value, expected)| value - expected);
    let error = largest(differences) / size;
    (values.len() == reference.len() && error.is_finite()).then_some(error)
}
