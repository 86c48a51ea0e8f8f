//! The data of one block in a system: loads, and its parts in the contact rows.

use nalgebra::Vector2;

use super::rigid::Modes;
use crate::model::Anchor;
use crate::model::mesh::BlockMesh;
use crate::rounding::cleared;

/// The part of one block in a contact row: the coefficients of its displacements.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyRow {
    /// The index of the contact row in the system.
    pub row: usize,
    /// The degrees of freedom of the block in the row, each with its coefficient; empty for a rigid block.
    pub entries: Vec<(usize, f64)>,
    /// The relative displacement of the row in each of the three rigid motions of the block: its part of a row of `G =
    /// C N`.
    pub modes: [f64; 3],
}

/// The part of one elastic block in the elongation of a strip: the coefficients of its displacements.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyStretch {
    /// The elongation, an index into [`System::stretches`](super::System::stretches).
    pub row: usize,
    /// The degrees of freedom of the block in the elongation, each with its coefficient.
    pub entries: Vec<(usize, f64)>,
}

/// One block of the system, with its loads and its parts in the contact rows.
#[derive(Debug, Clone)]
pub struct BodySystem {
    /// The rigid motions of the block.
    pub modes: Modes,
    /// The stiffness of the block, as an index into [`System::stiffnesses`](super::System::stiffnesses); `None` for a
    /// rigid block.
    pub stiffness: Option<usize>,
    /// Nodal loads `f` \[N\], two per node; empty for a rigid block.
    pub load: Vec<f64>,
    /// Work of the loads in each of the three rigid motions, `N^T f` \[N\].
    pub resultant: [f64; 3],
    /// The contact rows to which the block belongs, with increasing index.
    pub rows: Vec<BodyRow>,
    /// The elongations of strips to which the block contributes; empty for a rigid block.
    pub stretches: Vec<BodyStretch>,
}

/// Returns the degrees of freedom of the mesh, each with its coefficient, for the component of the displacement in
/// `direction` at a place on an edge.
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
