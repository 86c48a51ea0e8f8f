//! Q4 meshes of single blocks.

use nalgebra::Point2;

/// A structured mesh of `nx` by `ny` four-node quadrilaterals in one block.
///
/// Nodes are numbered row by row from corner 0: node `(i, j)` is `j * (nx + 1) + i`, with `i` along
/// edge 0 (corner 0 to corner 1) and `j` from edge 0 to edge 2.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMesh {
    /// Elements along edges 0 and 2.
    pub nx: usize,
    /// Elements along edges 1 and 3.
    pub ny: usize,
    /// Positions of the nodes \[m\].
    pub nodes: Vec<Point2<f64>>,
    /// Nodes of each element, counter-clockwise.
    pub elements: Vec<[usize; 4]>,
}
