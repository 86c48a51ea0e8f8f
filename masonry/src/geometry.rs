//! Quadrilaterals and segments: area, centroid, shape checks, overlaps.
//!
//! A quadrilateral is given by its four corners, counter-clockwise; edge `k` runs from corner `k`
//! to corner `k + 1`. Tolerances are relative to the sizes of the shapes involved.

use nalgebra::{Point2, Vector2};

mod overlap;

pub use overlap::{SegmentOverlap, facing_normal, facing_overlap, overlap_area};

/// Corners of a quadrilateral, counter-clockwise.
pub type Quad = [Point2<f64>; 4];

/// Why four corners are not those of a convex quadrilateral in counter-clockwise order.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum QuadError {
    /// A coordinate is not a finite number.
    #[error("a corner has a coordinate that is not finite")]
    NotFinite,
    /// The corners run clockwise.
    #[error("the corners run clockwise (area {area:e} m2): list them counter-clockwise")]
    Clockwise {
        /// Signed area \[m^2\].
        area: f64,
    },
    /// The interior angle at a corner is 180 degrees or more, or two corners coincide.
    #[error(
        "the quadrilateral is not strictly convex at corner {corner}: \
         move it outwards or split the block"
    )]
    NotConvex {
        /// The first corner that fails, 0..4.
        corner: usize,
    },
}

/// Signed area, positive when the corners run counter-clockwise \[m^2\].
pub fn area(quad: &Quad) -> f64 {
    0.5 * cross(quad[2] - quad[0], quad[3] - quad[1])
}

/// Centroid of the area of a quadrilateral.
pub fn centroid(quad: &Quad) -> Point2<f64> {
    // Coordinates relative to corner 0: a small block far from the origin loses no digits.
    let [d1, d2, d3] = [quad[1] - quad[0], quad[2] - quad[0], quad[3] - quad[0]];
    let (w1, w2) = (cross(d1, d2), cross(d2, d3));
    quad[0] + ((d1 + d2) * w1 + (d2 + d3) * w2) / (3.0 * (w1 + w2))
}

/// Size of a quadrilateral: its longest diagonal \[m\].
pub fn size(quad: &Quad) -> f64 {
    (quad[2] - quad[0]).norm().max((quad[3] - quad[1]).norm())
}

/// Checks that the corners are finite, run counter-clockwise and span a strictly convex shape.
///
/// A corner counts as convex when twice the area of its triangle exceeds `1e-9` times the square of
/// the quadrilateral's size.
///
/// # Errors
/// [`QuadError`] tells what is wrong with which corner.
pub fn check_convex(quad: &Quad) -> Result<(), QuadError> {
    if quad.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(QuadError::NotFinite);
    }
    let area = area(quad);
    if area < 0.0 {
        return Err(QuadError::Clockwise { area });
    }
    let least = 1e-9 * size(quad).powi(2);
    let convex = |k: &usize| {
        let (before, here, after) = (quad[(k + 3) % 4], quad[*k], quad[(k + 1) % 4]);
        cross(here - before, after - here) > least
    };
    match (0..4).find(|k| !convex(k)) {
        Some(corner) => Err(QuadError::NotConvex { corner }),
        None => Ok(()),
    }
}

/// The two ends of edge `k`.
///
/// # Panics
/// If `k > 3`.
pub fn edge(quad: &Quad, k: usize) -> [Point2<f64>; 2] {
    [quad[k], quad[(k + 1) % 4]]
}

/// The place at a fraction of edge `k`, from its first corner.
///
/// # Panics
/// If `k > 3`.
pub fn on_edge(quad: &Quad, k: usize, at: f64) -> Point2<f64> {
    let [p, q] = edge(quad, k);
    p + (q - p) * at
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
    // Of two forms of the root the one without a difference of like numbers.
    let s = if linear >= 0.0 {
        -2.0 * constant / (linear + root)
    } else {
        (root - linear) / (2.0 * square)
    };
    let along = e + g * s;
    [(h - f * s).dot(&along) / along.norm_squared(), s]
}

/// The point of the boundary of a quadrilateral that is nearest to a point.
pub fn nearest_on_boundary(quad: &Quad, point: Point2<f64>) -> Point2<f64> {
    let nearest_on = |k: usize| {
        let [p, q] = edge(quad, k);
        let along = q - p;
        p + along * ((point - p).dot(&along) / along.norm_squared()).clamp(0.0, 1.0)
    };
    let near = |a: &Point2<f64>, b: &Point2<f64>| (a - point).norm().total_cmp(&(b - point).norm());
    (0..4).map(nearest_on).min_by(near).unwrap_or(point)
}

/// How far a point lies outside of a convex quadrilateral, across the edge beyond which it is farthest; negative
/// inside \[m\].
pub fn outside(quad: &Quad, point: Point2<f64>) -> f64 {
    (0..4)
        .map(|k| (point - quad[k]).dot(&outward_normal(quad, k)))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Unit outward normal of edge `k`.
///
/// # Panics
/// If `k > 3`.
pub fn outward_normal(quad: &Quad, k: usize) -> Vector2<f64> {
    let [p, q] = edge(quad, k);
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
