//! The sizes of the movements of blocks, with which gaps and slips are compared.

use nalgebra::Vector2;

use super::bodies::Bodies;
use super::elements::NodeForces;
use super::{known, larger};
use crate::data::state::{PointState, State};
use crate::model::{JointPoint, Model};

/// The largest lengths of every block, and their rounding errors \[m\].
pub(super) struct Lengths {
    /// For every block, the largest length \[m\]: displacements, and initial gaps and slips and compressions of joints
    /// at its points. The lengths at the points count because a block may be at rest between joints and supports that
    /// move. Rigid blocks have the largest length of all blocks: their movements follow only from those of other
    /// blocks, and many do not move.
    blocks: Vec<f64>,
    /// For every block, the larger of two rounding errors \[m\]: that of the largest length in the model, and, for an
    /// elastic block, the deformation that rounding errors of the forces on it cause. A block that carries nothing is
    /// deformed only by such errors.
    roundings: Vec<f64>,
}

impl Lengths {
    pub(super) fn of(
        model: &Model,
        state: &State,
        nodes: &[Option<NodeForces>],
        bodies: &Bodies,
    ) -> Self {
        let moved = |u: &Vec<Vector2<f64>>| u.iter().map(Vector2::norm).fold(0.0, larger);
        let mut blocks: Vec<f64> = state.displacements.iter().map(moved).collect();
        let by_forces = |((nodes, own), force): ((&Option<NodeForces>, &f64), f64)| {
            let inside = nodes.as_ref().map_or(0.0, |nodes| nodes.inside);
            if inside > 0.0 { own * force / inside } else { 0.0 }
        };
        let by_forces = nodes.iter().zip(&blocks).zip(bodies.roundings()).map(by_forces);
        let mut roundings: Vec<f64> = by_forces.collect();
        for (contact, it) in model.contacts.iter().zip(&state.contacts) {
            let at_point = lengths(contact, it).into_iter().fold(0.0, larger);
            for anchor in [Some(contact.b), contact.a].into_iter().flatten() {
                let of_block = &mut blocks[anchor.block.index()];
                *of_block = larger(*of_block, at_point);
            }
        }
        let largest = blocks.iter().copied().fold(0.0, larger);
        for (own, block) in blocks.iter_mut().zip(&model.blocks) {
            if block.elasticity.is_none() {
                *own = largest;
            }
        }
        let count = state.displacements.iter().map(Vec::len).sum::<usize>();
        let least = f64::EPSILON * count as f64 * largest;
        for rounding in &mut roundings {
            *rounding = rounding.max(least);
        }
        Self { blocks, roundings }
    }

    /// Returns a length at a contact point of some blocks, relative to the largest length of these blocks \[-\].
    pub(super) fn share(&self, blocks: &[usize], part: f64) -> f64 {
        let largest = |of: &[f64]| blocks.iter().map(|block| of[*block]).fold(0.0, larger);
        known(part, largest(&self.blocks), largest(&self.roundings))
    }
}

fn lengths(contact: &JointPoint, it: &PointState) -> [f64; 4] {
    let [c_n, c_t] = contact.gives();
    [contact.gap, contact.slip, c_n * it.t_n, c_t * it.t_t].map(f64::abs)
}
