//! The mass of the blocks, lumped at their displacements.

use super::System;
use crate::element::quad4;
use crate::geometry;
use crate::model::{Block, Model};
use crate::system::rigid::Modes;
use nalgebra::Vector2;

/// The mass \[kg\] that moves with every displacement of the blocks, in the order of the system: of a node twice, of a rigid
/// block that of its two translations and of its rotation. A block without a density has 1 kg/m^3.
pub(crate) fn lumped(model: &Model, system: &System) -> Vec<f64> {
    let mut mass = Vec::new();
    for (block, body) in model.blocks.iter().zip(&system.bodies) {
        let density = block.density.unwrap_or(1.0);
        match (&block.mesh, body.stiffness) {
            (Some(mesh), Some(_)) => {
                let first = mass.len();
                mass.resize(first + 2 * mesh.nodes.len(), 0.0);
                for element in &mesh.elements {
                    let nodes = element.map(|n| mesh.nodes[n]);
                    let of_nodes =
                        quad4::body_load(&nodes, Vector2::x() * density, model.thickness);
                    for (k, node) in element.iter().enumerate() {
                        mass[first + 2 * node] += of_nodes[2 * k];
                        mass[first + 2 * node + 1] += of_nodes[2 * k];
                    }
                }
            }
            _ => mass.extend(rigid(block, density * model.thickness)),
        }
    }
    mass
}

/// Of the motions of a rigid block with a mass \[kg/m^2\] of its face.
fn rigid(block: &Block, density: f64) -> [f64; 3] {
    let modes = Modes::of(&block.corners);
    let mass = density * geometry::area(&block.corners);
    let inertia = density * geometry::polar_moment(&block.corners);
    [mass, mass, inertia / (modes.length * modes.length)]
}
