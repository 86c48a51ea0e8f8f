//! Q4 meshes of single blocks.

use nalgebra::{Point2, Vector2};

use crate::element::quad4;
use crate::geometry::{self, Quad};

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

impl BlockMesh {
    /// Divides a quadrilateral by the bilinear map: every edge is divided evenly.
    ///
    /// # Panics
    /// If `nx` or `ny` is zero.
    pub fn new(corners: &Quad, nx: usize, ny: usize) -> Self {
        assert!(nx > 0 && ny > 0, "a mesh has at least one element in each direction");
        let nodes = (0..=ny)
            .flat_map(|j| (0..=nx).map(move |i| (i as f64 / nx as f64, j as f64 / ny as f64)))
            .map(|(r, s)| bilinear(corners, r, s))
            .collect();
        let row = nx + 1;
        let elements = (0..ny)
            .flat_map(|j| (0..nx).map(move |i| j * row + i))
            .map(|n| [n, n + 1, n + row + 1, n + row])
            .collect();
        Self { nx, ny, nodes, elements }
    }

    /// The corners of the block.
    pub fn corners(&self) -> Quad {
        [0, 1, 2, 3].map(|edge| self.nodes[self.edge_node(edge, 0)])
    }

    /// Number of elements along an edge, 0..4.
    pub fn edge_elements(&self, edge: usize) -> usize {
        if edge.is_multiple_of(2) { self.nx } else { self.ny }
    }

    /// The nodes on an edge, from its first corner to its second.
    ///
    /// # Panics
    /// If `edge > 3`.
    pub fn edge_nodes(&self, edge: usize) -> Vec<usize> {
        (0..=self.edge_elements(edge)).map(|k| self.edge_node(edge, k)).collect()
    }

    /// The places of the nodes on an edge as fractions of it, from 0 to 1.
    pub fn edge_fractions(&self, edge: usize) -> Vec<f64> {
        let n = self.edge_elements(edge);
        (0..=n).map(|k| k as f64 / n as f64).collect()
    }

    /// The two nodes between which a place on an edge lies, each with its shape function there.
    ///
    /// `at` is the fraction of the edge, clamped to 0..=1.
    ///
    /// # Panics
    /// If `edge > 3`.
    pub fn interpolate(&self, edge: usize, at: f64) -> [(usize, f64); 2] {
        let (first, s) = within(self.edge_elements(edge), at);
        [(self.edge_node(edge, first), 1.0 - s), (self.edge_node(edge, first + 1), s)]
    }

    /// The coordinates of a point \[m\] in the block ([`geometry::reference`]); exactly 0 or 1 if the point lies on an edge
    /// up to rounding.
    pub fn reference(&self, point: Point2<f64>) -> [f64; 2] {
        geometry::reference(&self.corners(), point).map(geometry::snap)
    }

    /// The four nodes of the element in which a place of the block lies, each with its shape function there.
    ///
    /// `r` and `s` are the coordinates of the place in the block ([`Self::reference`]), clamped to 0..=1. The map of an
    /// element is that of the block on its part of the unit square, so that the place in the element needs no search.
    pub fn interpolate_inside(&self, [r, s]: [f64; 2]) -> [(usize, f64); 4] {
        let ([a, b, c, d], [r, s]) = self.element_at([r, s]);
        [(a, (1.0 - r) * (1.0 - s)), (b, r * (1.0 - s)), (c, r * s), (d, (1.0 - r) * s)]
    }

    /// The same nodes, each with the gradient of its shape function there \[1/m\]. At a place between elements it is that in
    /// one of them.
    ///
    /// # Panics
    /// If the block is not convex.
    pub fn gradients_inside(&self, place: [f64; 2]) -> [(usize, Vector2<f64>); 4] {
        let (nodes, place) = self.element_at(place);
        let corners = nodes.map(|node| self.nodes[node]);
        let gradients = quad4::gradients(&corners, place.map(|at| 2.0 * at - 1.0));
        let (gradients, _) = gradients.expect("elements of a convex block");
        std::array::from_fn(|k| (nodes[k], gradients[k]))
    }

    /// The nodes of the element in which a place of the block lies, and the place in the unit square of this element.
    fn element_at(&self, [r, s]: [f64; 2]) -> ([usize; 4], [f64; 2]) {
        let ((i, r), (j, s)) = (within(self.nx, r), within(self.ny, s));
        (self.elements[j * self.nx + i], [r, s])
    }

    /// The node at position `k` of an edge, counted from the edge's first corner.
    fn edge_node(&self, edge: usize, k: usize) -> usize {
        let row = self.nx + 1;
        match edge {
            0 => k,
            1 => k * row + self.nx,
            2 => self.ny * row + self.nx - k,
            3 => (self.ny - k) * row,
            _ => panic!("a block has the edges 0 to 3, not {edge}"),
        }
    }
}

/// The one of `n` equal parts of an edge in which a fraction of it lies, and its place in this part.
fn within(n: usize, at: f64) -> (usize, f64) {
    let place = at.clamp(0.0, 1.0) * n as f64;
    let first = (1..n).take_while(|k| *k as f64 <= place).count();
    (first, place - first as f64)
}

/// The place with coordinates `r` (along edge 0) and `s` (along edge 3, reversed) in 0..=1.
fn bilinear(corners: &Quad, r: f64, s: f64) -> Point2<f64> {
    let [a, b, c, d] = corners.map(|p| p.coords);
    Point2::from((a * (1.0 - r) + b * r) * (1.0 - s) + (d * (1.0 - r) + c * r) * s)
}
