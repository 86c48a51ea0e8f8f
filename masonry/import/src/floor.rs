//! A floor for drawings without a support.

use nalgebra::Point2;

use super::outline::distance;
use super::sheet::Sheet;
use super::stones::{Piece, shapes};
use super::{ImportError, ImportErrorKind};
use masonry::geometry::{self, cross};
use masonry_drawing::Place;

/// The length by which the floor extends beyond the blocks on each side, divided by its length. Chosen: visible in
/// pictures.
const BEYOND: f64 = 0.05;

/// Adds a floor below the blocks if no support is drawn: the straight line on which most blocks rest, among all lines
/// without a block below them.
///
/// # Errors
/// No block has an edge on such a line.
pub(crate) fn add(sheet: &mut Sheet) -> Result<Option<String>, ImportError> {
    if !sheet.supports.is_empty() {
        return Ok(None);
    }
    let hull = lower_hull(shapes(&sheet.stones).into_iter().flatten().copied().collect());
    let lines = (0..hull.len()).filter_map(|k| flat_from(&hull[k..], sheet.tolerance));
    // Among lines on which the same blocks rest, the longest is taken, since it goes below all of them.
    let rank = |[from, to]: [Point2<f64>; 2]| (resting(sheet, [from, to]), (to - from).norm());
    let ranked = lines.map(|ends| (rank(ends), ends));
    let best = ranked.max_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let Some((_, [from, to])) = best.filter(|((length, _), _)| *length > 0.0) else {
        return Err(ImportErrorKind::NoFloor.at(&[]));
    };
    let more = (to - from) * BEYOND;
    let ends = [from - more, to + more];
    let (name, place) = ("floor".to_owned(), Place::new("floor", None));
    sheet.supports.push(Piece { name, ends, place, is_of_scene: false });
    let [from, to] = ends
        .map(|it| format!("({}, {})", super::report::metres(it.x), super::report::metres(it.y)));
    Ok(Some(format!(
        "a floor from {from} to {to} m, below all blocks: draw supports on a layer \"support\""
    )))
}

/// Returns the lower side of the convex hull of points, from left to right.
fn lower_hull(mut points: Vec<Point2<f64>>) -> Vec<Point2<f64>> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut hull: Vec<Point2<f64>> = Vec::new();
    for point in points {
        while let [.., a, b] = hull[..]
            && cross(b - a, point - b) <= 0.0
        {
            hull.pop();
        }
        hull.push(point);
    }
    hull
}

/// Finds the longest line from the first corner of a hull to another corner for which the distances of all corners
/// between are at most the tolerance. `None` if the line is steeper than 45 degrees.
fn flat_from(hull: &[Point2<f64>], tolerance: f64) -> Option<[Point2<f64>; 2]> {
    let line = |end: usize| [hull[0], hull[end]];
    let is_flat =
        |end: &usize| hull[1..*end].iter().all(|it| distance(*it, line(*end)) <= tolerance);
    let longest = (1..hull.len()).take_while(is_flat).last().map(line);
    // A side of the hull that is steeper than 45 degrees is a wall, not a floor.
    longest.filter(|[from, to]| (to.x - from.x) > (to.y - from.y).abs())
}

/// Returns the total length of the edges that lie on a line within the tolerance.
fn resting(sheet: &Sheet, [from, to]: [Point2<f64>; 2]) -> f64 {
    let along = to - from;
    let reach = sheet.tolerance * along.norm();
    let is_on = |point: &Point2<f64>| cross(along, point - from).abs() <= reach;
    let edges = sheet
        .stones
        .iter()
        .flat_map(|stone| (0..stone.corners.len()).map(|k| geometry::edge(&stone.corners, k)));
    edges.filter(|ends| ends.iter().all(is_on)).map(|[from, to]| (to - from).norm()).sum()
}
