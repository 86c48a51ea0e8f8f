//! Sums of the forces on every block, and their unbalanced part.

use nalgebra::{Point2, Vector2};

use super::elements::NodeForces;
use super::{LARGEST_ERROR, known, larger, relative};
use crate::data::state::State;
use crate::geometry;
use crate::model::{Anchor, Model, PlacedBlock};
use crate::recover;

/// The sums of the forces on every block, in the order of the model.
pub(super) struct Bodies(Vec<BodyForces>);

/// The sums of the forces on a block.
struct BodyForces {
    force: Vector2<f64>,
    /// The sum of the moments about the centroid, divided by the size of the block \[N\].
    moment: f64,
    /// The sum of the sizes of the block's loads \[N\].
    load: f64,
    /// The sum of the sizes of all forces on the block and of the tensile strengths of its points \[N\].
    size: f64,
    /// The number of forces in the sums.
    count: usize,
    /// Rounding error to expect in the balance of the block, due to errors of the forces on the block and its
    /// neighbours \[N\].
    rounding: f64,
}

impl BodyForces {
    fn of_loads(model: &Model, block: &PlacedBlock) -> Self {
        let mut body = Self {
            force: Vector2::zeros(),
            moment: 0.0,
            load: 0.0,
            size: 0.0,
            count: 0,
            rounding: 0.0,
        };
        for load in model.forces_on(block) {
            body.add(block, load.at, load.force);
            let size = geometry::size(&block.corners);
            body.moment += load.moment / size;
            body.size += load.moment.abs() / size;
        }
        body.load = body.size;
        body
    }

    fn add(&mut self, block: &PlacedBlock, place: Point2<f64>, force: Vector2<f64>) {
        let arm = (place - geometry::centroid(&block.corners)) / geometry::size(&block.corners);
        self.force += force;
        self.moment += geometry::cross(arm, force);
        self.size += force.norm();
        self.count += 1;
    }

    /// Returns the part `part` \[N\] of the forces, relative to the sum of the sizes of all forces on the block \[-\].
    fn share(&self, part: f64) -> f64 {
        known(part, self.size, self.rounding)
    }
}

impl Bodies {
    pub(super) fn of(model: &Model, state: &State, nodes: &[Option<NodeForces>]) -> Self {
        let mut list: Vec<BodyForces> =
            model.blocks.iter().map(|block| BodyForces::of_loads(model, block)).collect();
        for (contact, it) in model.contacts.iter().zip(&state.contacts) {
            let on_b = recover::contact_force(model, contact, it);
            for (anchor, force) in [(Some(contact.b), on_b), (contact.a, -on_b)] {
                let Some(Anchor { block, edge, at }) = anchor else { continue };
                let (body, block) = (&mut list[block.index()], &model.blocks[block.index()]);
                // The force acts on both faces of a film in the middle between them.
                let place = match contact.film {
                    Some(_) => contact.position,
                    None => geometry::on_edge(&block.corners, edge, at),
                };
                body.add(block, place, force);
                // A contact force is computed as its excess over the tensile strength.
                body.size += contact.law.tension;
            }
        }
        let sizes: Vec<(f64, usize)> = list.iter().map(|body| (body.size, body.count)).collect();
        let mut around = sizes.clone();
        for contact in &model.contacts {
            let Some(a) = contact.a else { continue };
            let [a, b] = [a, contact.b].map(|anchor| anchor.block.index());
            for (one, other) in [(a, b), (b, a)] {
                let (size, count) = sizes[other];
                around[one] = (around[one].0.max(size), around[one].1.max(count));
            }
        }
        for ((body, nodes), (around, count)) in list.iter_mut().zip(nodes).zip(around) {
            let terms = nodes.as_ref().map_or(0.0, |nodes| nodes.inside);
            let own = nodes.as_ref().map_or(0, |nodes| nodes.count);
            body.rounding = f64::EPSILON * (count + own) as f64 * around.max(terms);
            // A block without a load has only the forces of its neighbours, with their errors.
            if body.load <= 0.0 {
                body.rounding = body.rounding.max(LARGEST_ERROR * around);
            }
        }
        Self(list)
    }

    /// Returns for every block the rounding error to expect in its balance, from the forces on it and on its
    /// neighbours \[N\].
    pub(super) fn roundings(&self) -> impl Iterator<Item = f64> {
        self.0.iter().map(|body| body.rounding)
    }

    /// Returns for every block the sum of the sizes of the forces on it \[N\].
    pub(super) fn sizes(&self) -> impl Iterator<Item = f64> {
        self.0.iter().map(|body| body.size)
    }

    /// Returns the largest unbalanced force, relative to the forces on its block \[-\].
    pub(super) fn force_balance(&self) -> f64 {
        self.0.iter().map(|body| body.share(body.force.norm())).fold(0.0, larger)
    }

    /// Returns the largest unbalanced moment, divided by the size of the block and by the forces on it \[-\].
    pub(super) fn moment_balance(&self) -> f64 {
        self.0.iter().map(|body| body.share(body.moment.abs())).fold(0.0, larger)
    }

    /// Returns the largest part of a load that is not carried \[-\], relative to the loads on a block or to all loads.
    /// An unbalanced force below the part `none` of all forces on a block is not compared with the loads on the block.
    pub(super) fn uncarried(&self, none: f64) -> f64 {
        let total: f64 = self.0.iter().map(|body| body.load).sum();
        let of_body = |body: &BodyForces| {
            let left = body.force.norm();
            let is_known = left > none * body.size && body.load > 0.0;
            let of_its_own = if is_known { relative(left, body.load) } else { 0.0 };
            let of_all = if total > 0.0 { relative(left, total) } else { 0.0 };
            larger(of_its_own, of_all)
        };
        self.0.iter().map(of_body).fold(0.0, larger)
    }

    /// Returns a force between some blocks, relative to the forces on the lightest of these blocks \[-\].
    pub(super) fn share(&self, blocks: &[usize], part: f64) -> f64 {
        blocks.iter().map(|block| self.0[*block].share(part)).fold(0.0, larger)
    }

    /// Returns the ratio of the largest to the smallest sum of forces on a block \[-\].
    pub(super) fn spread(&self) -> f64 {
        let loaded = || self.sizes().filter(|size| *size > 0.0);
        let least = loaded().fold(f64::INFINITY, f64::min);
        if least.is_finite() { loaded().fold(0.0, larger) / least } else { 1.0 }
    }
}
