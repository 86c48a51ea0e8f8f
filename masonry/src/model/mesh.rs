//! Meshes of single blocks by four-node quadrilateral elements (Q4).
//!
//! A block is divided into quadrilaterals, its patches. The bilinear map of each patch divides it into equal numbers
//! of elements. A convex quadrilateral is one patch. Another convex polygon has one patch per corner, whose vertices
//! are the corner, the middles of the two edges at the corner, and the centroid. These patches are convex, since the
//! centroid lies beyond the line between the two middles. A polygon that is star-shaped about its centroid but not
//! convex has three patches in the triangle of each edge with the centroid. Corners on straight edges are removed
//! beforehand.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point2, Vector2};

use crate::element::quad4;
use crate::geometry::{self, Quad};

/// A mesh of four-node quadrilaterals in one block, with the nodes on its edges.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMesh {
    /// Numbers of elements of every patch along its two directions.
    divisions: [usize; 2],
    /// Coordinates of the nodes \[m\].
    pub nodes: Vec<Point2<f64>>,
    /// Nodes of each element, counter-clockwise; elements come patch by patch, and row by row from the first side of
    /// the patch.
    pub elements: Vec<[usize; 4]>,
    /// Nodes on each edge of the block, from the first corner of the edge to the second.
    edges: Vec<Vec<usize>>,
}

impl BlockMesh {
    /// Divides a quadrilateral by its bilinear map: every edge is divided evenly.
    ///
    /// Nodes are numbered row by row from corner 0: node `(i, j)` is `j * (nx + 1) + i`, with `i` along
    /// edge 0 (corner 0 to corner 1) and `j` from edge 0 to edge 2.
    ///
    /// # Panics
    /// If `nx` or `ny` is zero.
    pub fn new(corners: &Quad, nx: usize, ny: usize) -> Self {
        let edges = (0..4).map(|k| vec![k, (k + 1) % 4]).collect();
        let patches = Patches { vertices: corners.to_vec(), quads: vec![[0, 1, 2, 3]], edges };
        patches.divided([nx, ny])
    }

    /// Divides a block. A convex quadrilateral gets `nx` by `ny` elements, `nx` along edges 0 and 2. Any other block
    /// is divided into patches of `nx` by `nx` elements.
    ///
    /// Returns `None` if the block is not a convex quadrilateral and the two numbers differ, or if it is not convex
    /// and an edge lies [behind its centroid](geometry::edge_behind_centroid).
    ///
    /// # Panics
    /// If a number of elements is zero.
    pub fn of(corners: &[Point2<f64>], divisions: [usize; 2]) -> Option<Self> {
        let [nx, ny] = divisions;
        let is_convex = geometry::check_convex(corners).is_ok();
        if let (true, Ok(quad)) = (is_convex, Quad::try_from(corners)) {
            return Some(Self::new(&quad, nx, ny));
        }
        let patches = if is_convex {
            Patches::at_corners(corners)
        } else if geometry::edge_behind_centroid(corners).is_none() {
            Patches::at_edges(corners)
        } else {
            return None;
        };
        (nx == ny).then(|| patches.divided(divisions))
    }

    /// Returns the numbers of elements of every patch along its two directions.
    pub fn divisions(&self) -> [usize; 2] {
        self.divisions
    }

    /// Returns the number of elements along an edge of the block.
    ///
    /// # Panics
    /// If the block has no such edge.
    pub fn edge_elements(&self, edge: usize) -> usize {
        self.edges[edge].len() - 1
    }

    /// Returns the nodes on an edge of the block, from the first corner of the edge to the second.
    ///
    /// # Panics
    /// If the block has no such edge.
    pub fn edge_nodes(&self, edge: usize) -> &[usize] {
        &self.edges[edge]
    }

    /// Returns the node at every corner of the block.
    pub fn corner_nodes(&self) -> impl Iterator<Item = usize> {
        self.edges.iter().map(|nodes| nodes[0])
    }

    /// Returns the nodes around the block, counter-clockwise from corner 0.
    pub fn rim(&self) -> impl Iterator<Item = usize> {
        self.edges.iter().flat_map(|nodes| &nodes[..nodes.len() - 1]).copied()
    }

    /// Returns the lines between elements, each as a list of nodes.
    pub fn lines(&self) -> Vec<Vec<usize>> {
        let [nx, ny] = self.divisions;
        let rim: BTreeSet<usize> = self.rim().collect();
        let mut drawn = BTreeSet::new();
        let mut lines = Vec::new();
        for patch in 0..self.patches() {
            let upright = (0..=nx).map(|i| (i % nx == 0, (0..=ny).map(|j| [i, j]).collect()));
            let level = (0..=ny).map(|j| (j % ny == 0, (0..=nx).map(|i| [i, j]).collect()));
            for (is_side, places) in upright.chain(level) {
                let places: Vec<[usize; 2]> = places;
                let line: Vec<usize> = places.into_iter().map(|at| self.node(patch, at)).collect();
                let [a, b] = [line[0], line[line.len() - 1]];
                // A side inside the block belongs to two patches; a side on the rim has both ends on the rim.
                let is_on_rim = rim.contains(&a) && rim.contains(&b);
                if !is_side || (!is_on_rim && drawn.insert([a.min(b), a.max(b)])) {
                    lines.push(line);
                }
            }
        }
        lines
    }

    /// Returns the places of the nodes on an edge as fractions of the edge, from 0 to 1.
    ///
    /// # Panics
    /// If the block has no such edge.
    pub fn edge_fractions(&self, edge: usize) -> Vec<f64> {
        let n = self.edge_elements(edge);
        (0..=n).map(|k| k as f64 / n as f64).collect()
    }

    /// Returns the two nodes between which a place on an edge lies, each with the value of its shape function at the
    /// place.
    ///
    /// `at` is the place as a fraction of the edge, clamped to 0..=1.
    ///
    /// # Panics
    /// If the block has no such edge.
    pub fn interpolate(&self, edge: usize, at: f64) -> [(usize, f64); 2] {
        let nodes = &self.edges[edge];
        let (first, s) = within(self.edge_elements(edge), at);
        [(nodes[first], 1.0 - s), (nodes[first + 1], s)]
    }

    /// Returns the four nodes of the element in which a point \[m\] of the block lies, each with the value of its
    /// shape function at the point. The value is exactly zero if the point lies, up to rounding, on a side of the
    /// element that does not contain the node.
    ///
    /// Every element is the image of a rectangle in the unit square of its patch. The coordinates of the point in this
    /// square give the element without a search.
    pub fn interpolate_inside(&self, point: Point2<f64>) -> [(usize, f64); 4] {
        let ([a, b, c, d], [r, s]) = self.element_at(point);
        [(a, (1.0 - r) * (1.0 - s)), (b, r * (1.0 - s)), (c, r * s), (d, (1.0 - r) * s)]
    }

    /// Returns the four nodes of the element at a point, each with the gradient of its shape function at the point
    /// \[1/m\]. A point between elements belongs to one of these elements.
    ///
    /// # Panics
    /// If an element is folded, which does not occur in the mesh of a checked block.
    pub fn gradients_inside(&self, point: Point2<f64>) -> [(usize, Vector2<f64>); 4] {
        let (nodes, place) = self.element_at(point);
        let corners = nodes.map(|node| self.nodes[node]);
        let gradients = quad4::gradients(&corners, place.map(|at| 2.0 * at - 1.0));
        let (gradients, _) = gradients.expect("elements that are not folded");
        std::array::from_fn(|k| (nodes[k], gradients[k]))
    }

    /// Returns the nodes of the element in which a point of the block lies, and the place of the point in the unit
    /// square of the element.
    fn element_at(&self, point: Point2<f64>) -> ([usize; 4], [f64; 2]) {
        let [nx, ny] = self.divisions;
        let outside = |patch: usize| geometry::outside(&self.quad(patch), point);
        let patches = 0..self.patches();
        let patch = patches.min_by(|a, b| outside(*a).total_cmp(&outside(*b))).unwrap_or(0);
        let [r, s] = geometry::reference(&self.quad(patch), point).map(geometry::snap);
        let ((i, r), (j, s)) = (within(nx, r), within(ny, s));
        (self.elements[(patch * ny + j) * nx + i], [r, s])
    }

    fn patches(&self) -> usize {
        self.elements.len() / (self.divisions[0] * self.divisions[1])
    }

    /// Returns the corners of a patch.
    fn quad(&self, patch: usize) -> Quad {
        let [nx, ny] = self.divisions;
        [[0, 0], [nx, 0], [nx, ny], [0, ny]].map(|at| self.nodes[self.node(patch, at)])
    }

    /// Returns the node of a patch at column `i` and row `j` of its grid.
    fn node(&self, patch: usize, [i, j]: [usize; 2]) -> usize {
        let [nx, ny] = self.divisions;
        let (column, row) = (i.min(nx - 1), j.min(ny - 1));
        let [a, b, c, d] = self.elements[(patch * ny + row) * nx + column];
        match (i > column, j > row) {
            (false, false) => a,
            (true, false) => b,
            (true, true) => c,
            (false, true) => d,
        }
    }
}

/// The patches of a block, before they are divided into elements.
struct Patches {
    /// The vertices of all patches; the corners of the block come first.
    vertices: Vec<Point2<f64>>,
    /// The corners of each patch, counter-clockwise.
    quads: Vec<[usize; 4]>,
    /// The vertices on each edge of the block, in order.
    edges: Vec<Vec<usize>>,
}

impl Patches {
    /// Makes one patch per corner, from the corner to the middles of its edges and to the centroid.
    fn at_corners(corners: &[Point2<f64>]) -> Self {
        let count = corners.len();
        let centre = 2 * count;
        let mut vertices = corners.to_vec();
        vertices.extend((0..count).map(|k| geometry::on_edge(corners, k, 0.5)));
        vertices.push(geometry::centroid(corners));
        let quad = |k: usize| [k, count + k, centre, count + (k + count - 1) % count];
        let edge = |k: usize| vec![k, count + k, (k + 1) % count];
        let quads = (0..count).map(quad).collect();
        Self { vertices, quads, edges: (0..count).map(edge).collect() }
    }

    /// Makes three patches in the triangle of each edge with the centroid, one at each corner of the triangle.
    fn at_edges(corners: &[Point2<f64>]) -> Self {
        let count = corners.len();
        let [middles, spokes, triangles, centre] = [1, 2, 3, 4].map(|k| k * count);
        let centroid = geometry::centroid(corners);
        let mut vertices = corners.to_vec();
        vertices.extend((0..count).map(|k| geometry::on_edge(corners, k, 0.5)));
        vertices.extend(corners.iter().map(|corner| nalgebra::center(corner, &centroid)));
        vertices.extend((0..count).map(|k| {
            let [a, b] = geometry::edge(corners, k);
            centroid + ((a - centroid) + (b - centroid)) / 3.0
        }));
        vertices.push(centroid);
        let of_triangle = |k: usize| {
            let next = (k + 1) % count;
            let (middle, inside) = (middles + k, triangles + k);
            [
                [k, middle, inside, spokes + k],
                [next, spokes + next, inside, middle],
                [centre, spokes + k, inside, spokes + next],
            ]
        };
        let edge = |k: usize| vec![k, middles + k, (k + 1) % count];
        let quads = (0..count).flat_map(of_triangle).collect();
        Self { vertices, quads, edges: (0..count).map(edge).collect() }
    }

    /// Divides every patch into elements; patches share the nodes on their common sides.
    fn divided(&self, divisions: [usize; 2]) -> BlockMesh {
        let [nx, ny] = divisions;
        assert!(nx > 0 && ny > 0, "a mesh has at least one element in each direction");
        let (mut nodes, mut elements) = (Vec::new(), Vec::new());
        let mut on_sides: BTreeMap<OnSide, usize> = BTreeMap::new();
        for quad in &self.quads {
            let corners = quad.map(|vertex| self.vertices[vertex]);
            let mut grid = Vec::with_capacity((nx + 1) * (ny + 1));
            for (i, j) in (0..=ny).flat_map(|j| (0..=nx).map(move |i| (i, j))) {
                let new = nodes.len();
                let node = match OnSide::of(quad, [i, j], divisions) {
                    Some(place) => *on_sides.entry(place).or_insert(new),
                    None => new,
                };
                if node == new {
                    nodes.push(bilinear(&corners, i as f64 / nx as f64, j as f64 / ny as f64));
                }
                grid.push(node);
            }
            let row = nx + 1;
            let first = (0..ny).flat_map(|j| (0..nx).map(move |i| j * row + i));
            elements.extend(first.map(|n| [n, n + 1, n + row + 1, n + row].map(|n| grid[n])));
        }
        let edges = self.edges.iter().enumerate().map(|(k, vertices)| {
            // Patches of blocks that are not convex quadrilaterals have as many elements in both directions.
            let count = divisions[k % 2];
            let steps = vertices.windows(2).flat_map(|ends| {
                (0..count).map(|step| OnSide::step([ends[0], ends[1]], step, count))
            });
            let last = OnSide { side: [vertices[vertices.len() - 1]; 2], step: 0 };
            steps.chain([last]).map(|place| on_sides[&place]).collect()
        });
        let edges = edges.collect();
        BlockMesh { divisions, nodes, elements, edges }
    }
}

/// A place on a side of a patch, described in the same way for both patches beside the side.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct OnSide {
    /// The vertices at the ends of the side, in increasing order; at a corner twice the same vertex.
    side: [usize; 2],
    /// Number of elements between the first end and the place.
    step: usize,
}

impl OnSide {
    fn of([a, b, c, d]: &[usize; 4], [i, j]: [usize; 2], [nx, ny]: [usize; 2]) -> Option<Self> {
        if j == 0 {
            Some(Self::step([*a, *b], i, nx))
        } else if j == ny {
            Some(Self::step([*d, *c], i, nx))
        } else if i == 0 {
            Some(Self::step([*a, *d], j, ny))
        } else {
            (i == nx).then(|| Self::step([*b, *c], j, ny))
        }
    }

    /// Returns the place after `step` of the `count` elements from the end `from` to the end `to`.
    fn step([from, to]: [usize; 2], step: usize, count: usize) -> Self {
        if step == 0 || step == count {
            Self { side: [if step == 0 { from } else { to }; 2], step: 0 }
        } else if from < to {
            Self { side: [from, to], step }
        } else {
            Self { side: [to, from], step: count - step }
        }
    }
}

/// Finds the part in which a fraction of an edge lies if the edge has `n` equal parts; returns the index of the part,
/// and the place as a fraction of the part.
fn within(n: usize, at: f64) -> (usize, f64) {
    let place = at.clamp(0.0, 1.0) * n as f64;
    let first = (1..n).take_while(|k| *k as f64 <= place).count();
    (first, place - first as f64)
}

/// Returns the point with bilinear coordinates `r` (along edge 0) and `s` (along edge 3, reversed), both from 0 to 1.
fn bilinear(corners: &Quad, r: f64, s: f64) -> Point2<f64> {
    let [a, b, c, d] = corners.map(|p| p.coords);
    Point2::from((a * (1.0 - r) + b * r) * (1.0 - s) + (d * (1.0 - r) + c * r) * s)
}
