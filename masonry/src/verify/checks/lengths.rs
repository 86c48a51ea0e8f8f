//! How far blocks move: what gaps and slips are compared with.

use nalgebra::Vector2;

use super::{known, larger};
use crate::model::Model;
use crate::state::State;

/// The largest displacements \[m\].
pub(super) struct Lengths {
    blocks: Vec<f64>,
    /// What rounding errors of the largest of all and of the initial gaps may be.
    rounding: f64,
}

impl Lengths {
    pub(super) fn of(model: &Model, state: &State) -> Self {
        let blocks: Vec<f64> = state
            .displacements
            .iter()
            .map(|u| u.iter().map(Vector2::norm).fold(0.0, larger))
            .collect();
        let gaps = model.contacts.iter().map(|contact| contact.gap.abs());
        let largest = blocks.iter().copied().chain(gaps).fold(0.0, larger);
        let count = state.displacements.iter().map(Vec::len).sum::<usize>();
        Self { blocks, rounding: f64::EPSILON * count as f64 * largest }
    }

    /// A length at a contact point of some blocks, relative to their displacements and to what it was at first.
    pub(super) fn share(&self, blocks: &[usize], initial: [f64; 2], part: f64) -> f64 {
        let moved = blocks.iter().map(|block| self.blocks[*block]);
        let own = moved.chain(initial.map(f64::abs)).fold(0.0, larger);
        known(part, own, self.rounding)
    }
}
