//! One block of a system.

use nalgebra::Vector2;

use super::rigid::Modes;
use crate::model::Anchor;
use crate::model::mesh::BlockMesh;
use crate::rounding::cleared;

/// The part of one block in a contact row.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyRow {
    /// The row of the system.
    pub row: usize,
    /// Degrees of freedom of the block and their coefficients; empty for a rigid block.
    pub entries: Vec<(usize, f64)>,
    /// The relative displacement of the three rigid motions: the block's part of the row of `G = C N`.
    pub modes: [f64; 3],
}

/// The part of one elastic block in the elongation of a strip.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyStretch {
    /// The row, an index into [`System::stretches`](super::System::stretches).
    pub row: usize,
    /// Degrees of freedom of the block and their coefficients.
    pub entries: Vec<(usize, f64)>,
}

/// One block of the system.
#[derive(Debug, Clone)]
pub struct BodySystem {
    /// The rigid motions of the block.
    pub modes: Modes,
    /// The stiffness of the block, an index into [`System::stiffnesses`](super::System::stiffnesses); `None` for a rigid block.
    pub stiffness: Option<usize>,
    /// Nodal loads `f` \[N\], two per node; empty for a rigid block.
    pub load: Vec<f64>,
    /// Work of the loads in the three rigid motions, `N^T f` \[N\].
    pub resultant: [f64; 3],
    /// The contact rows of the block, increasing.
    pub rows: Vec<BodyRow>,
    /// The strips that stretch with the block; empty for a rigid block.
    pub stretches: Vec<BodyStretch>,
}

/// A direction at a place of an edge in the degrees of freedom of the mesh.
pub(super) fn entries(
    mesh: &BlockMesh,
    anchor: Anchor,
    direction: Vector2<f64>,
) -> Vec<(usize, f64)> {
    let size = direction.norm();
    mesh.interpolate(anchor.edge, anchor.at)
        .into_iter()
        .flat_map(|(node, n)| [(2 * node, n * direction.x), (2 * node + 1, n * direction.y)])
        .filter(|(_, coefficient)| cleared(*coefficient, size) != 0.0)
        .collect()
}
