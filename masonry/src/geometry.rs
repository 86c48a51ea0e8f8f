//! Polygons and segments: area, centroid, checks of shapes, overlaps.
//!
//! A polygon is given by its corners, counter-clockwise; edge `k` runs from corner `k` to the next one, and the last
//! edge back to corner 0. Tolerances are relative to the sizes of the shapes involved.

use nalgebra::{Point2, Vector2};

mod extent;
mod overlap;
mod shape;

pub(crate) use extent::Extent;
pub use overlap::{SegmentOverlap, facing_normal, facing_overlap, length_inside, overlap_area};
pub use shape::{PolygonError, check_convex, check_simple, edge_behind_centroid, without_straight};

/// Lengths below this part of the lengths around them are rounding errors: places that are closer together than this
/// part of the size are one place.
pub(crate) const SAME_PLACE: f64 = 1e-9;

/// Corners of a quadrilateral, counter-clockwise \[m\].
pub type Quad = [Point2<f64>; 4];

/// Computes the signed area of a polygon \[m^2\], positive if the corners run counter-clockwise.
pub fn area(polygon: &[Point2<f64>]) -> f64 {
    fan(polygon).map(|[a, b]| 0.5 * cross(a, b)).sum()
}

/// Computes the centroid of the area of a polygon \[m\].
///
/// # Panics
/// If there is no corner.
pub fn centroid(polygon: &[Point2<f64>]) -> Point2<f64> {
    let (moment, twice) = fan(polygon).fold((Vector2::zeros(), 0.0), |(moment, twice), [a, b]| {
        let w = cross(a, b);
        (moment + (a + b) * w, twice + w)
    });
    polygon[0] + moment / (3.0 * twice)
}

/// Returns two sides of each triangle that corner 0 makes with an edge. The sides are vectors from corner 0, so that a
/// small block far from the origin loses no digits.
fn fan(polygon: &[Point2<f64>]) -> impl Iterator<Item = [Vector2<f64>; 2]> {
    let pairs = polygon.get(1..).unwrap_or_default().windows(2);
    pairs.map(|pair| [pair[0] - polygon[0], pair[1] - polygon[0]])
}

/// Computes the size of a polygon: the largest distance between two corners \[m\].
pub fn size(polygon: &[Point2<f64>]) -> f64 {
    let pairs =
        polygon.iter().enumerate().flat_map(|(k, p)| polygon[..k].iter().map(move |q| p - q));
    pairs.map(|apart| apart.norm()).fold(0.0, f64::max)
}

/// Returns the two ends of edge `k`.
///
/// # Panics
/// If the polygon has no edge `k`.
pub fn edge(polygon: &[Point2<f64>], k: usize) -> [Point2<f64>; 2] {
    [polygon[k], polygon[(k + 1) % polygon.len()]]
}

/// Returns the point on edge `k` at a fraction of its length from its first corner.
///
/// # Panics
/// If the polygon has no edge `k`.
pub fn on_edge(polygon: &[Point2<f64>], k: usize, at: f64) -> Point2<f64> {
    let [p, q] = edge(polygon, k);
    p + (q - p) * at
}

/// Returns a fraction of an edge; it is set to 0 or 1 if it differs only by rounding errors.
pub(crate) fn snap(fraction: f64) -> f64 {
    if fraction < SAME_PLACE {
        0.0
    } else if fraction > 1.0 - SAME_PLACE {
        1.0
    } else {
        fraction
    }
}

/// Returns the coordinates `[r, s]` of a point in a strictly convex quadrilateral, which the bilinear map takes to this
/// point: `r` along edge 0, and `s` along edge 3 from its end. Both are in 0..=1 for a point inside.
pub fn reference(quad: &Quad, point: Point2<f64>) -> [f64; 2] {
    // The cross product of h - f s and e + g s is zero for h = e r + f s + g r s: a quadratic equation in s. The map
    // keeps its orientation inside, and the left side increases with s there, so that the root is the larger one.
    let [e, f, h] = [quad[1] - quad[0], quad[3] - quad[0], point - quad[0]];
    let g = (quad[2] - quad[3]) - e;
    let (square, linear, constant) = (cross(g, f), cross(e, f) + cross(h, g), cross(h, e));
    let root = (linear * linear - 4.0 * constant * square).max(0.0).sqrt();
    // This form of the root has no difference of almost equal numbers.
    let s = if linear >= 0.0 {
        -2.0 * constant / (linear + root)
    } else {
        (root - linear) / (2.0 * square)
    };
    let along = e + g * s;
    [(h - f * s).dot(&along) / along.norm_squared(), s]
}

/// Returns the point of a segment that is nearest to a given point.
pub fn nearest_on_segment([p, q]: [Point2<f64>; 2], point: Point2<f64>) -> Point2<f64> {
    let along = q - p;
    let square = along.norm_squared();
    let at = if square > 0.0 { (point - p).dot(&along) / square } else { 0.0 };
    p + along * at.clamp(0.0, 1.0)
}

/// Returns the point of the boundary of a polygon that is nearest to a given point.
pub fn nearest_on_boundary(polygon: &[Point2<f64>], point: Point2<f64>) -> Point2<f64> {
    let nearest_on = |k: usize| nearest_on_segment(edge(polygon, k), point);
    let near = |a: &Point2<f64>, b: &Point2<f64>| (a - point).norm().total_cmp(&(b - point).norm());
    (0..polygon.len()).map(nearest_on).min_by(near).unwrap_or(point)
}

/// Computes the distance of a point from the boundary of a simple polygon \[m\], negative inside.
pub fn outside(polygon: &[Point2<f64>], point: Point2<f64>) -> f64 {
    let distance = (nearest_on_boundary(polygon, point) - point).norm();
    if contains(polygon, point) { -distance } else { distance }
}

/// Whether a point is inside of a polygon: a ray to the right crosses the boundary an odd number of times.
fn contains(polygon: &[Point2<f64>], point: Point2<f64>) -> bool {
    let is_crossed = |k: &usize| {
        let [p, q] = edge(polygon, *k);
        let is_right = (cross(q - p, point - p) > 0.0) == (q.y > p.y);
        (p.y > point.y) != (q.y > point.y) && is_right
    };
    (0..polygon.len()).filter(is_crossed).count() % 2 == 1
}

/// Returns the unit outward normal of edge `k`.
///
/// # Panics
/// If the polygon has no edge `k`.
pub fn outward_normal(polygon: &[Point2<f64>], k: usize) -> Vector2<f64> {
    let [p, q] = edge(polygon, k);
    turn_right((q - p).normalize())
}

/// Computes half the central angle \[rad\] of a circular arc with this rise and span.
pub(crate) fn half_angle(rise: f64, span: f64) -> f64 {
    2.0 * (2.0 * rise / span).atan()
}

/// Turns a vector by -90 degrees, which is clockwise.
pub fn turn_right(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(v.y, -v.x)
}

/// Computes the out-of-plane component of the cross product of two vectors.
pub fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Computes the polar moment of area of a polygon about its centroid \[m^4\].
pub fn polar_moment(polygon: &[Point2<f64>]) -> f64 {
    let centre = centroid(polygon);
    let of_triangle = |k: usize| {
        let [a, b] = edge(polygon, k).map(|p| p - centre);
        cross(a, b) * (a.dot(&a) + a.dot(&b) + b.dot(&b)) / 12.0
    };
    (0..polygon.len()).map(of_triangle).sum()
}

/// Returns the parts of an interval that are outside of other intervals, without parts shorter than 1e-9.
pub fn without(whole: [f64; 2], others: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut left = vec![whole];
    for [from, to] in others {
        left = left
            .into_iter()
            .flat_map(|[a, b]| [[a, b.min(*from)], [a.max(*to), b]])
            .filter(|[a, b]| b - a > SAME_PLACE)
            .collect();
    }
    left
}
