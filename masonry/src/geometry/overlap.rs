//! Intersections of simple polygons with each other and with segments, and the overlap of two facing segments.

use nalgebra::{Point2, Vector2};

use super::{area, check_convex, cross, edge, outside, turn_right};

/// Rounding error of a distance, relative to the coordinates of the ends of the distance.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Computes the area of the intersection of two simple polygons \[m^2\], whose corners run counter-clockwise.
///
/// The first polygon is clipped by the half planes of the edges of the second (Sutherland and Hodgman), so that only
/// the second needs to be convex. Separate parts of the first remain joined by edges without area. If neither polygon
/// is convex, the second is divided into triangles with signed areas, which cancel outside of it.
pub fn overlap_area(a: &[Point2<f64>], b: &[Point2<f64>]) -> f64 {
    let is_convex = |polygon| check_convex(polygon).is_ok();
    let total = if is_convex(b) {
        clipped_area(a, b)
    } else if is_convex(a) {
        clipped_area(b, a)
    } else {
        let of_triangle = |k: usize| {
            let mut triangle = [b[0], b[k], b[k + 1]];
            let sign = area(&triangle).signum();
            if sign < 0.0 {
                triangle.swap(1, 2);
            }
            sign * clipped_area(a, &triangle)
        };
        (1..b.len().saturating_sub(1)).map(of_triangle).sum()
    };
    total.max(0.0)
}

/// Computes the area of the intersection of a polygon with a convex polygon \[m^2\].
fn clipped_area(polygon: &[Point2<f64>], convex: &[Point2<f64>]) -> f64 {
    let mut part = polygon.to_vec();
    for k in 0..convex.len() {
        let [p, q] = edge(convex, k);
        part = clip(&part, |x| cross(q - p, x - p));
    }
    area(&part)
}

/// Computes the length of the part of a segment that is deeper than `depth` \[m\] in a simple polygon.
///
/// The lines of all edges cut the segment into pieces, and the depth of a piece is that of its middle.
pub fn length_inside(segment: [Point2<f64>; 2], polygon: &[Point2<f64>], depth: f64) -> f64 {
    let [from, to] = segment;
    let along = to - from;
    let cut = |k: usize| {
        let [p, q] = edge(polygon, k);
        let [at_from, at_to] = segment.map(|end| cross(q - p, end - p));
        let at = at_from / (at_from - at_to);
        (0.0..=1.0).contains(&at).then_some(at)
    };
    let mut cuts: Vec<f64> =
        [0.0, 1.0].into_iter().chain((0..polygon.len()).filter_map(cut)).collect();
    cuts.sort_by(f64::total_cmp);
    let is_inside =
        |piece: &[f64]| outside(polygon, from + along * (0.5 * (piece[0] + piece[1]))) < -depth;
    let pieces = cuts.windows(2).filter(|piece| is_inside(piece));
    pieces.map(|piece| piece[1] - piece[0]).sum::<f64>() * along.norm()
}

/// Returns the part of a polygon in which the linear function `inside` is not negative.
fn clip(polygon: &[Point2<f64>], inside: impl Fn(Point2<f64>) -> f64) -> Vec<Point2<f64>> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        let (f_p, f_q) = (inside(p), inside(q));
        if f_p >= 0.0 {
            kept.push(p);
        }
        if (f_p > 0.0 && f_q < 0.0) || (f_p < 0.0 && f_q > 0.0) {
            kept.push(p + (q - p) * (f_p / (f_p - f_q)));
        }
    }
    kept
}

/// The overlap of two facing segments, given by its ends on both segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentOverlap {
    /// Fractions of the length of the first segment at both ends of the overlap, increasing.
    pub on_first: [f64; 2],
    /// Fractions of the length of the second segment at the same two ends, decreasing.
    pub on_second: [f64; 2],
    /// Unit normal from the first segment to the second: the mean of the right-hand normal of the first and the
    /// left-hand normal of the second.
    pub normal: Vector2<f64>,
    /// Distance of the segments along the normal at both ends of the overlap \[m\]; exactly zero if the segments touch
    /// within the tolerance.
    pub gap: [f64; 2],
}

/// Computes the unit normal from the first of two facing segments to the second: the mean of the right-hand normal of
/// the first and the left-hand normal of the second. `None` if the segments do not run in opposite directions.
pub fn facing_normal(first: [Point2<f64>; 2], second: [Point2<f64>; 2]) -> Option<Vector2<f64>> {
    let [e1, e2] = [first, second].map(|[from, to]| (to - from).normalize());
    (e1.dot(&e2) < 0.0).then(|| turn_right((e1 - e2).normalize()))
}

/// Finds the overlap of two segments that run in opposite directions and face each other, such as two edges of
/// counter-clockwise blocks; the second must be on the right-hand side of the first.
///
/// Segments touch if their distance is at most `slack` \[m\]; `limit` \[m\] is the largest gap of segments that face
/// each other without touching. If `limit` is zero, all gaps are set to zero; otherwise gaps are kept, and only those
/// within the rounding errors of the coordinates are set to zero. `None` if the segments are not antiparallel, lie
/// apart, penetrate by more than `slack`, or share no more than `slack` of length.
pub fn facing_overlap(
    first: [Point2<f64>; 2],
    second: [Point2<f64>; 2],
    slack: f64,
    limit: f64,
) -> Option<SegmentOverlap> {
    let (d1, d2) = (first[1] - first[0], second[1] - second[0]);
    let (l1, l2) = (d1.norm(), d2.norm());
    let (e1, e2) = (d1 / l1, d2 / l2);
    // The angle between the segments must not open the shorter one, over its whole length, by more than the admitted
    // gap.
    let turned = cross(e1, e2).abs() * l1.min(l2);
    if e1.dot(&e2) >= 0.0 || turned > slack + limit {
        return None;
    }
    let along = (e1 - e2).normalize();
    let normal = turn_right(along);
    let place = |p: Point2<f64>| (p - first[0]).dot(&along);
    let (start, end) = (place(first[0]), place(first[1]));
    let (second_start, second_end) = (place(second[0]), place(second[1]));
    let (low, high) = (start.max(second_end), end.min(second_start));
    if high - low <= slack {
        return None;
    }
    let on_first = [low, high].map(|s| ((s - start) / (end - start)).clamp(0.0, 1.0));
    let on_second =
        [low, high].map(|s| ((s - second_start) / (second_end - second_start)).clamp(0.0, 1.0));
    let distance =
        |k: usize| (second[0] + d2 * on_second[k] - (first[0] + d1 * on_first[k])).dot(&normal);
    let gap = [distance(0), distance(1)];
    if gap.iter().any(|g| *g < -slack || *g > slack + limit) {
        return None;
    }
    // Gaps are kept if they are admitted, down to the rounding errors of the coordinates.
    let ends = first.iter().chain(&second).flat_map(|p| [p.x, p.y]);
    let rounding = ROUNDING * ends.fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let touching = if limit > 0.0 { rounding.min(slack) } else { slack };
    let gap = gap.map(|g| if g <= touching { 0.0 } else { g });
    Some(SegmentOverlap { on_first, on_second, normal, gap })
}
