//! The masses of the blocks, lumped at their degrees of freedom.

use super::System;
use crate::element::quad4;
use crate::geometry;
use crate::model::{Model, PlacedBlock};
use crate::system::rigid::Modes;
use nalgebra::Vector2;

/// Density that moving blocks get if they have none \[kg/m^3\]. Chosen: the motion hardly depends on the density,
/// since drag is proportional to the mass.
const UNIT: f64 = 1.0;

/// Returns the warning about blocks that move without a density; `None` if there are no such blocks.
pub(crate) fn of_unit_density(model: &Model) -> Option<String> {
    let mut without = model.blocks.iter().filter(|block| block.density.is_none());
    let first = &without.next()?.name;
    let blocks = match without.count() {
        0 => format!("Block \"{first}\" has no density"),
        more => format!("Block \"{first}\" and {more} more have no density"),
    };
    Some(format!(
        "{blocks}: they have no weight, and the mass of {UNIT} kg/m3 while they move. Give `density` to the material if \
         it is known."
    ))
}

/// Returns the lumped mass \[kg\] of every displacement of the blocks, in the order of the system: the mass of each
/// node twice, and for a rigid block the masses of its two translations and of its rotation.
pub(crate) fn lumped(model: &Model, system: &System) -> Vec<f64> {
    let mut mass = Vec::new();
    for (block, body) in model.blocks.iter().zip(&system.bodies) {
        let density = block.density.unwrap_or(UNIT);
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

/// Returns the masses \[kg\] of the three motions of a rigid block; `density` is the mass per area of its face
/// \[kg/m^2\].
fn rigid(block: &PlacedBlock, density: f64) -> [f64; 3] {
    let modes = Modes::of(&block.corners);
    let mass = density * geometry::area(&block.corners);
    let inertia = density * geometry::polar_moment(&block.corners);
    [mass, mass, inertia / (modes.length * modes.length)]
}
