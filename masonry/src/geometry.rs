//! Convex polygons and segments: area, centroid, shape checks, overlaps.
//!
//! A polygon is given by its corners, counter-clockwise; edge `k` runs from corner `k` to the next one, and the last
//! edge back to corner 0. Tolerances are relative to the sizes of the shapes involved.

use std::f64::consts::PI;

use nalgebra::{Point2, Vector2};

mod extent;
mod overlap;

pub(crate) use extent::Extent;
pub use overlap::{SegmentOverlap, facing_normal, facing_overlap, overlap_area};

/// Lengths below this part of those around them are rounding errors: places that are as near to each other are one.
pub(crate) const SAME_PLACE: f64 = 1e-9;

/// Corners of a quadrilateral, counter-clockwise.
pub type Quad = [Point2<f64>; 4];

/// Why corners are not those of a convex polygon in counter-clockwise order.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PolygonError {
    /// So many corners, two or less.
    TooFew(usize),
    /// A coordinate is not a finite number.
    NotFinite,
    /// The corners run clockwise around this signed area \[m^2\].
    Clockwise(f64),
    /// The interior angle at this corner, from 0, is 180 degrees or more, or two corners coincide.
    NotConvex(usize),
    /// The edges go around more than once, as those of a star do.
    Crossing,
}

/// Signed area, positive when the corners run counter-clockwise \[m^2\].
pub fn area(polygon: &[Point2<f64>]) -> f64 {
    fan(polygon).map(|[a, b]| 0.5 * cross(a, b)).sum()
}

/// Centroid of the area of a polygon.
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

/// The sides of the triangles that corner 0 makes with the edges. Relative to it a small block far from the origin loses
/// no digits.
fn fan(polygon: &[Point2<f64>]) -> impl Iterator<Item = [Vector2<f64>; 2]> {
    let pairs = polygon.get(1..).unwrap_or_default().windows(2);
    pairs.map(|pair| [pair[0] - polygon[0], pair[1] - polygon[0]])
}

/// Size of a polygon: the largest distance between two corners \[m\].
pub fn size(polygon: &[Point2<f64>]) -> f64 {
    let pairs =
        polygon.iter().enumerate().flat_map(|(k, p)| polygon[..k].iter().map(move |q| p - q));
    pairs.map(|apart| apart.norm()).fold(0.0, f64::max)
}

/// Checks that the corners are finite, run counter-clockwise once and span a strictly convex shape.
///
/// A corner counts as convex when twice the area of its triangle exceeds `1e-9` times the square of the polygon's size.
///
/// # Errors
/// [`PolygonError`] tells what is wrong with which corner.
pub fn check_convex(polygon: &[Point2<f64>]) -> Result<(), PolygonError> {
    let count = polygon.len();
    if polygon.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(PolygonError::NotFinite);
    }
    if count < 3 {
        return Err(PolygonError::TooFew(count));
    }
    let area = area(polygon);
    if area < 0.0 {
        return Err(PolygonError::Clockwise(area));
    }
    let least = 1e-9 * size(polygon).powi(2);
    let sides = |k: usize| {
        let (before, here) = (polygon[(k + count - 1) % count], polygon[k]);
        (here - before, polygon[(k + 1) % count] - here)
    };
    let mut turned = 0.0;
    for corner in 0..count {
        let (before, after) = sides(corner);
        if cross(before, after) <= least {
            return Err(PolygonError::NotConvex(corner));
        }
        turned += cross(before, after).atan2(before.dot(&after));
    }
    if turned < 3.0 * PI { Ok(()) } else { Err(PolygonError::Crossing) }
}

/// The two ends of edge `k`.
///
/// # Panics
/// If there is no such edge.
pub fn edge(polygon: &[Point2<f64>], k: usize) -> [Point2<f64>; 2] {
    [polygon[k], polygon[(k + 1) % polygon.len()]]
}

/// The place at a fraction of edge `k`, from its first corner.
///
/// # Panics
/// If there is no such edge.
pub fn on_edge(polygon: &[Point2<f64>], k: usize, at: f64) -> Point2<f64> {
    let [p, q] = edge(polygon, k);
    p + (q - p) * at
}

/// A fraction of an edge, set to 0 or 1 if only rounding separates them.
pub(crate) fn snap(fraction: f64) -> f64 {
    if fraction < SAME_PLACE {
        0.0
    } else if fraction > 1.0 - SAME_PLACE {
        1.0
    } else {
        fraction
    }
}

/// The coordinates `[r, s]` of a point of a strictly convex quadrilateral: the place to which the bilinear map takes
/// them, `r` along edge 0 and `s` along edge 3 from its end, both in 0..=1 for a point inside.
pub fn reference(quad: &Quad, point: Point2<f64>) -> [f64; 2] {
    // With h = e r + f s + g r s the cross product of h - f s and e + g s is zero: a quadratic equation in s. The map
    // keeps its orientation inside, where the left side increases with s, so that the root is the larger one.
    let [e, f, h] = [quad[1] - quad[0], quad[3] - quad[0], point - quad[0]];
    let g = (quad[2] - quad[3]) - e;
    let (square, linear, constant) = (cross(g, f), cross(e, f) + cross(h, g), cross(h, e));
    let root = (linear * linear - 4.0 * constant * square).max(0.0).sqrt();
    // The form of the root without a difference of like numbers.
    let s = if linear >= 0.0 {
        -2.0 * constant / (linear + root)
    } else {
        (root - linear) / (2.0 * square)
    };
    let along = e + g * s;
    [(h - f * s).dot(&along) / along.norm_squared(), s]
}

/// The point of the boundary of a polygon that is nearest to a point.
pub fn nearest_on_boundary(polygon: &[Point2<f64>], point: Point2<f64>) -> Point2<f64> {
    let nearest_on = |k: usize| {
        let [p, q] = edge(polygon, k);
        let along = q - p;
        p + along * ((point - p).dot(&along) / along.norm_squared()).clamp(0.0, 1.0)
    };
    let near = |a: &Point2<f64>, b: &Point2<f64>| (a - point).norm().total_cmp(&(b - point).norm());
    (0..polygon.len()).map(nearest_on).min_by(near).unwrap_or(point)
}

/// How far a point lies outside of a convex polygon, across the edge beyond which it is farthest; negative inside \[m\].
pub fn outside(polygon: &[Point2<f64>], point: Point2<f64>) -> f64 {
    (0..polygon.len())
        .map(|k| (point - polygon[k]).dot(&outward_normal(polygon, k)))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Unit outward normal of edge `k`.
///
/// # Panics
/// If there is no such edge.
pub fn outward_normal(polygon: &[Point2<f64>], k: usize) -> Vector2<f64> {
    let [p, q] = edge(polygon, k);
    turn_right((q - p).normalize())
}

/// A vector turned by -90 degrees.
pub fn turn_right(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(v.y, -v.x)
}

/// The out-of-plane component of the cross product.
pub fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The polar moment of area of a polygon about its centroid \[m^4\].
pub fn polar_moment(polygon: &[Point2<f64>]) -> f64 {
    let centre = centroid(polygon);
    let of_triangle = |k: usize| {
        let [a, b] = edge(polygon, k).map(|p| p - centre);
        cross(a, b) * (a.dot(&a) + a.dot(&b) + b.dot(&b)) / 12.0
    };
    (0..polygon.len()).map(of_triangle).sum()
}
