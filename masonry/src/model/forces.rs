//! The forces that act on a block, without the contact forces.

use nalgebra::Vector2;

use super::{BlockLoad, Model, PlacedBlock, PlacedForce};
use crate::geometry;
use crate::ids::LoadId;

/// The cause of a force on a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// The weight of the block.
    Weight,
    /// A load of the scene.
    Load(LoadId),
}

impl Model {
    /// Returns the acceleration of all mass \[m/s^2\]: the sum of gravity and of the accelerations among the loads.
    pub fn acceleration(&self) -> Vector2<f64> {
        // The sum starts from gravity: -0 would become 0 in a sum from zero.
        self.accelerations.iter().fold(self.gravity, |sum, it| sum + it.value)
    }

    /// Returns the resultants of all forces on a block with their causes: its weight, each acceleration of its mass,
    /// and each load on it.
    pub fn causes_on(&self, block: &PlacedBlock) -> Vec<(Cause, PlacedForce)> {
        let mut forces = Vec::with_capacity(1 + self.accelerations.len() + block.loads.len());
        if let Some(density) = block.density {
            let mass = density * geometry::area(&block.corners) * self.thickness;
            let centroid = geometry::centroid(&block.corners);
            forces.push((Cause::Weight, PlacedForce::new(centroid, self.gravity * mass)));
            let inertia = self.accelerations.iter();
            forces.extend(
                inertia
                    .map(|it| (Cause::Load(it.load), PlacedForce::new(centroid, it.value * mass))),
            );
        }
        let resultant = |load: &BlockLoad| {
            (Cause::Load(load.load()), load.resultant(&block.corners, self.thickness))
        };
        forces.extend(block.loads.iter().map(resultant));
        forces
    }

    /// Returns the resultants of [`causes_on`](Self::causes_on) without their causes.
    pub fn forces_on(&self, block: &PlacedBlock) -> Vec<PlacedForce> {
        self.causes_on(block).into_iter().map(|(_, force)| force).collect()
    }
}
