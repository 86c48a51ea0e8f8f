//! Loads of a block: the forces of accelerations on its mass, and other forces on the block.

use crate::element::quad4;
use crate::model::mesh::BlockMesh;
use crate::model::{Model, PlacedBlock};
use crate::rounding::{cleared, largest};
use crate::system::rigid::Modes;

/// Returns the consistent nodal loads \[N\], two per node, of everything that acts on a block except its contacts.
pub fn nodal_loads(model: &Model, block: &PlacedBlock, mesh: &BlockMesh) -> Vec<f64> {
    let mut load = vec![0.0; 2 * mesh.nodes.len()];
    let acceleration = model.acceleration();
    if let Some(density) = block.density
        && acceleration.norm() > 0.0
    {
        for element in &mesh.elements {
            let nodes = element.map(|n| mesh.nodes[n]);
            let local = quad4::body_load(&nodes, acceleration * density, model.thickness);
            for (k, node) in element.iter().enumerate() {
                load[2 * node] += local[2 * k];
                load[2 * node + 1] += local[2 * k + 1];
            }
        }
    }
    for on_block in &block.loads {
        for (node, force) in on_block.nodal_forces(&block.corners, mesh, model.thickness) {
            load[2 * node] += force.x;
            load[2 * node + 1] += force.y;
        }
    }
    let size = largest(&load);
    load.into_iter().map(|v| cleared(v, size)).collect()
}

/// Returns the work of weight and loads in the three rigid motions of a block, `N^T f` \[N\].
///
/// Rounding errors are set to zero, since contacts may be unable to balance them: those of loads that cancel, and
/// those of the lever arm of a load through the centroid.
pub fn resultant(model: &Model, block: &PlacedBlock) -> [f64; 3] {
    let modes = Modes::of(&block.corners);
    let (mut sum, mut size) = ([0.0; 3], 0.0);
    for force in model.forces_on(block) {
        sum.iter_mut().zip(modes.work_of(&force)).for_each(|(s, a)| *s += a);
        size += force.size(modes.length);
    }
    sum.map(|value| cleared(value, size))
}
