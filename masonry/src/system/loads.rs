//! Loads of a block: self weight and tractions on its edges.

use crate::element::quad4;
use crate::geometry;
use crate::model::mesh::BlockMesh;
use crate::model::{Block, EdgeLoad, Model};
use crate::rounding::{cleared, largest};
use crate::system::rigid::Modes;

/// Consistent nodal loads \[N\] of self weight and edge loads, two per node.
pub fn nodal_loads(model: &Model, block: &Block, mesh: &BlockMesh) -> Vec<f64> {
    let mut load = vec![0.0; 2 * mesh.nodes.len()];
    if let Some(density) = block.density
        && model.gravity.norm() > 0.0
    {
        for element in &mesh.elements {
            let nodes = element.map(|n| mesh.nodes[n]);
            let local = quad4::body_load(&nodes, model.gravity * density, model.thickness);
            for (k, node) in element.iter().enumerate() {
                load[2 * node] += local[2 * k];
                load[2 * node + 1] += local[2 * k + 1];
            }
        }
    }
    for edge_load in &block.edge_loads {
        let [p, q] = geometry::edge(&block.corners, edge_load.edge);
        let whole_edge = edge_load.traction * ((q - p).norm() * model.thickness);
        for (node, share) in edge_shares(mesh, edge_load) {
            load[2 * node] += share * whole_edge.x;
            load[2 * node + 1] += share * whole_edge.y;
        }
    }
    let size = largest(&load);
    load.into_iter().map(|v| cleared(v, size)).collect()
}

/// Integrals of the shape functions over the loaded part of the edge, as fractions of the edge.
fn edge_shares(mesh: &BlockMesh, load: &EdgeLoad) -> Vec<(usize, f64)> {
    let fractions = mesh.edge_fractions(load.edge);
    let parts = fractions.windows(2).filter_map(|part| {
        let (from, to) = (part[0].max(load.from), part[1].min(load.to));
        (from < to).then_some((from, to))
    });
    // A shape function is linear on each part: its value in the middle times the length is exact.
    parts
        .flat_map(|(from, to)| {
            let nodes = mesh.interpolate(load.edge, 0.5 * (from + to));
            nodes.map(|(node, n)| (node, n * (to - from)))
        })
        .collect()
}

/// Work of self weight and edge loads in the three rigid motions of a block, `N^T f` \[N\].
///
/// What rounding leaves of loads that cancel, or of the arm of a load through the centroid, is zero:
/// no contact might be able to balance it.
pub fn resultant(model: &Model, block: &Block) -> [f64; 3] {
    let modes = Modes::of(&block.corners);
    let (mut sum, mut size) = ([0.0; 3], 0.0);
    for (place, force) in model.forces_on(block) {
        let add = modes.resultant(place, force);
        sum.iter_mut().zip(add).for_each(|(s, a)| *s += a);
        size += force.norm();
    }
    sum.map(|value| cleared(value, size))
}
