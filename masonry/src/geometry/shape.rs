//! Checks that corners are those of a block: a polygon that is simple, convex, or seen from its centroid.

use std::f64::consts::PI;

use nalgebra::Point2;

use super::{SAME_PLACE, area, centroid, cross, edge, nearest_on_segment, size};

/// The reasons for which corners are not those of a polygon that runs counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PolygonError {
    /// There are only two corners or fewer; the number is that of the corners.
    TooFew(usize),
    /// A coordinate is not a finite number.
    NotFinite,
    /// The corners run clockwise; the number is their signed area \[m^2\].
    Clockwise(f64),
    /// The polygon is not convex at the corner with this index, from 0: the interior angle is 180 degrees or more, or
    /// two corners coincide.
    NotConvex(usize),
    /// The polygon has no width at the corner with this index, from 0: both edges lie on each other, or the corner
    /// coincides with a neighbour.
    NoWidth(usize),
    /// Edges cross or touch, as those of a star that is drawn in one stroke.
    Crossing,
}

/// Returns the corners at which a polygon turns, without those between two edges on one straight line.
pub fn without_straight(polygon: &[Point2<f64>]) -> Vec<Point2<f64>> {
    let count = polygon.len();
    let slack = SAME_PLACE * size(polygon);
    let turns = |k: &usize| {
        let ends = [polygon[(k + count - 1) % count], polygon[(k + 1) % count]];
        (nearest_on_segment(ends, polygon[*k]) - polygon[*k]).norm() > slack
    };
    (0..count).filter(turns).map(|k| polygon[k]).collect()
}

/// Checks that the corners are finite, run counter-clockwise once, and are those of a strictly convex polygon.
///
/// A corner counts as convex if twice the area of the triangle with its neighbours exceeds `1e-9` times the square of
/// the polygon's size.
///
/// # Errors
/// [`PolygonError`] has the kind of the error and its corner.
pub fn check_convex(polygon: &[Point2<f64>]) -> Result<(), PolygonError> {
    let count = polygon.len();
    check_corners(polygon)?;
    let area = area(polygon);
    if area < 0.0 {
        return Err(PolygonError::Clockwise(area));
    }
    let least = SAME_PLACE * size(polygon).powi(2);
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

/// Checks that the corners are finite and run counter-clockwise, and that edges meet only in their common corners.
///
/// Corners may point inwards or lie on a straight line. Parts count as touching if they are nearer than `1e-9` of the
/// polygon's size.
///
/// # Errors
/// [`PolygonError`] has the kind of the error, which is never [`PolygonError::NotConvex`].
pub fn check_simple(polygon: &[Point2<f64>]) -> Result<(), PolygonError> {
    if check_convex(polygon).is_ok() {
        return Ok(());
    }
    check_corners(polygon)?;
    let count = polygon.len();
    let near = SAME_PLACE * size(polygon);
    for k in 0..count {
        let [before, after] = [(k + count - 1) % count, k].map(|k| edge(polygon, k));
        if distance(before[0], after) <= near || distance(after[1], before) <= near {
            return Err(PolygonError::NoWidth(k));
        }
    }
    for k in 0..count {
        // The edge before the first edge is its neighbour.
        let last = if k == 0 { count.saturating_sub(1) } else { count };
        if (k + 2..last).any(|other| touch(edge(polygon, k), edge(polygon, other), near)) {
            return Err(PolygonError::Crossing);
        }
    }
    let area = area(polygon);
    if area < 0.0 { Err(PolygonError::Clockwise(area)) } else { Ok(()) }
}

/// Finds the first edge that cannot be seen from the centroid; `None` if all edges can be seen.
pub fn edge_behind_centroid(polygon: &[Point2<f64>]) -> Option<usize> {
    let (centre, least) = (centroid(polygon), SAME_PLACE * size(polygon).powi(2));
    let is_behind = |k: &usize| {
        let [a, b] = edge(polygon, *k).map(|corner| corner - centre);
        cross(a, b) <= least
    };
    (0..polygon.len()).find(is_behind)
}

fn check_corners(polygon: &[Point2<f64>]) -> Result<(), PolygonError> {
    if polygon.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(PolygonError::NotFinite);
    }
    if polygon.len() < 3 {
        return Err(PolygonError::TooFew(polygon.len()));
    }
    Ok(())
}

/// Whether two segments cross, or an end of one is nearer to the other than `near` \[m\].
fn touch(one: [Point2<f64>; 2], other: [Point2<f64>; 2], near: f64) -> bool {
    let side = |[p, q]: [Point2<f64>; 2], x: Point2<f64>| cross(q - p, x - p);
    let divides = |line: [Point2<f64>; 2], [p, q]: [Point2<f64>; 2]| {
        (side(line, p) > 0.0) != (side(line, q) > 0.0)
    };
    let is_near = |end: Point2<f64>, segment| distance(end, segment) <= near;
    (divides(one, other) && divides(other, one))
        || one.iter().any(|end| is_near(*end, other))
        || other.iter().any(|end| is_near(*end, one))
}

fn distance(point: Point2<f64>, segment: [Point2<f64>; 2]) -> f64 {
    (nearest_on_segment(segment, point) - point).norm()
}
