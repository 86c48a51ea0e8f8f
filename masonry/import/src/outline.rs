//! Cleans single outlines: near corners are joined, nearly straight corners are removed, and the direction becomes
//! counter-clockwise.

use nalgebra::Point2;

use masonry::geometry::{self, PolygonError};
use masonry_drawing::{Change, Place};

/// Distances below this part of the tolerance count as rounding errors. Chosen: far above rounding errors of
/// coordinates, far below all changes that a report should show.
const EXACT: f64 = 1e-6;

/// The result of cleaning an outline.
pub(crate) enum Cleaned {
    /// A polygon whose edges and corners are larger than the tolerance.
    Polygon(Vec<Point2<f64>>),
    /// No polygon: the outline is thinner than the tolerance.
    Sliver,
    /// No polygon: edges cross, so that the areas on both sides of the crossing cancel each other.
    Crossing,
}

/// Cleans an outline, and adds what was changed to `changes`.
pub(crate) fn clean(
    outline: &[Point2<f64>],
    place: &Place,
    tolerance: f64,
    changes: &mut Vec<Change>,
) -> Cleaned {
    let mut corners = outline.to_vec();
    if let Some(by) = without_near(&mut corners, tolerance) {
        changes.push(Change::by("near corners became one", place, by));
    }
    // The removal of corners on straight edges, at which other blocks begin, does not count as a change.
    let straight = without_straight(&mut corners, tolerance);
    if let Some(by) = straight.filter(|by| *by > EXACT * tolerance) {
        changes.push(Change::by("nearly straight corners vanished", place, by));
    }
    if corners.len() < 3 {
        return Cleaned::Sliver;
    }
    if width(&corners) <= tolerance {
        let is_crossing = geometry::check_simple(&corners) == Err(PolygonError::Crossing);
        return if is_crossing { Cleaned::Crossing } else { Cleaned::Sliver };
    }
    if geometry::area(&corners) < 0.0 {
        // The first corner remains the first.
        corners[1..].reverse();
        changes.push(Change::new("clockwise outlines were turned", place));
    }
    Cleaned::Polygon(corners)
}

/// Returns the width of an outline: the area divided by half the perimeter, which is nearly the width of a long
/// rectangle.
fn width(corners: &[Point2<f64>]) -> f64 {
    let perimeter: f64 = super::size::edges(corners).sum();
    2.0 * geometry::area(corners).abs() / perimeter
}

/// Removes each corner that is nearer than the tolerance to the previous corner, and returns the largest such distance;
/// `None` if no corner was removed.
fn without_near(corners: &mut Vec<Point2<f64>>, tolerance: f64) -> Option<f64> {
    let mut largest: Option<f64> = None;
    let mut kept: Vec<Point2<f64>> = Vec::with_capacity(corners.len());
    let mut is_near = |a: &Point2<f64>, b: &Point2<f64>| {
        let apart = (a - b).norm();
        let near = apart <= tolerance;
        if near && apart > 0.0 {
            largest = Some(apart.max(largest.unwrap_or(0.0)));
        }
        near
    };
    for corner in corners.iter() {
        if !kept.last().is_some_and(|last| is_near(last, corner)) {
            kept.push(*corner);
        }
    }
    while kept.len() > 1 && is_near(&kept[0], &kept[kept.len() - 1]) {
        kept.pop();
    }
    *corners = kept;
    largest
}

/// Removes the straightest corner repeatedly, as long as all removed corners are within the tolerance of the remaining
/// edges. Returns the largest distance between a removed corner and such an edge; `None` if no corner was removed.
fn without_straight(corners: &mut Vec<Point2<f64>>, tolerance: f64) -> Option<f64> {
    let mut largest: Option<f64> = None;
    let mut ring = Ring::of(corners);
    while ring.corners.len() >= 3 {
        let offs = ring.offs.iter().copied().enumerate();
        let straightest = offs.min_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some((k, by)) = straightest.filter(|(_, by)| *by <= tolerance) else { break };
        ring.leave_out(k);
        largest = Some(by.max(largest.unwrap_or(0.0)));
    }
    *corners = ring.corners;
    largest
}

/// The remaining corners of an outline from which corners are removed.
struct Ring {
    corners: Vec<Point2<f64>>,
    /// For every remaining corner, the removed corners between it and the next one.
    out: Vec<Vec<Point2<f64>>>,
    /// For every remaining corner, the distance between the edge that would replace it, and the farthest of the corner
    /// itself and the removed corners beside it.
    offs: Vec<f64>,
}

impl Ring {
    fn of(corners: &[Point2<f64>]) -> Self {
        let out = vec![Vec::new(); corners.len()];
        let mut ring = Self { corners: corners.to_vec(), out, offs: Vec::new() };
        ring.offs = (0..corners.len()).map(|k| ring.off(k)).collect();
        ring
    }

    fn off(&self, k: usize) -> f64 {
        let (before, after) = self.beside(k);
        let ends = [self.corners[before], self.corners[after]];
        let passed = self.out[before].iter().chain(&self.out[k]).chain([&self.corners[k]]);
        passed.map(|it| distance(*it, ends)).fold(0.0, f64::max)
    }

    fn beside(&self, k: usize) -> (usize, usize) {
        let count = self.corners.len();
        ((k + count - 1) % count, (k + 1) % count)
    }

    fn leave_out(&mut self, k: usize) {
        let (before, _) = self.beside(k);
        let gone = [self.corners[k]].into_iter().chain(std::mem::take(&mut self.out[k]));
        self.out[before].extend(gone);
        self.corners.remove(k);
        self.out.remove(k);
        self.offs.remove(k);
        let before = if before > k { before - 1 } else { before };
        for beside in [before, (before + 1) % self.corners.len()] {
            self.offs[beside] = self.off(beside);
        }
    }
}

/// Returns the distance between a point and a segment.
pub(crate) fn distance(point: Point2<f64>, ends: [Point2<f64>; 2]) -> f64 {
    (point - geometry::nearest_on_segment(ends, point)).norm()
}
