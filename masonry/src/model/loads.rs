//! The forces that act on a block, apart from those of its contacts.

use nalgebra::{Point2, Vector2};

use super::{Block, Model};
use crate::geometry;

/// A force \[N\] and where it acts \[m\].
pub type PlacedForce = (Point2<f64>, Vector2<f64>);

impl Model {
    /// The resultant of every load of a block: of its weight, and of each edge load.
    pub fn forces_on(&self, block: &Block) -> Vec<PlacedForce> {
        let weight = block.density.map(|density| {
            let mass = density * geometry::area(&block.corners) * self.thickness;
            (geometry::centroid(&block.corners), self.gravity * mass)
        });
        let edges = block.edge_loads.iter().map(|load| {
            let [start, end] = geometry::edge(&block.corners, load.edge);
            let loaded = (load.to - load.from) * (end - start).norm() * self.thickness;
            let middle = geometry::on_edge(&block.corners, load.edge, 0.5 * (load.from + load.to));
            (middle, load.traction * loaded)
        });
        weight.into_iter().chain(edges).collect()
    }
}
