//! Fill over blocks, and axles on it, as forces on the edges that face upwards.
//!
//! The weight of the column of fill above an edge varies linearly along the edge, and its resultant goes through the centroid of
//! the column. The force of an axle spreads along straight rays, as many for every unit of `u`, the horizontal
//! distance over the depth, up to `u = tan angle`: on a horizontal plane the pressure is uniform. An edge takes the rays that
//! meet it, `(u_2 - u_1) / (2 tan angle)` of the force.

use nalgebra::Point2;

use super::PlacedBlock;
use crate::geometry;

/// A free part of an edge that faces upwards, from left to right.
#[derive(Debug, Clone, Copy)]
pub(super) struct Top {
    pub(super) block: usize,
    pub(super) ends: [Point2<f64>; 2],
}

/// A part of a force, and the place at which it acts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share {
    pub(super) block: usize,
    pub(super) at: Point2<f64>,
    /// The area of the column \[m^2\], or the part of the force \[-\].
    pub(super) size: f64,
}

/// An axle in its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlacedAxle {
    /// Its place along x \[m\].
    pub(super) x: f64,
    /// The top of the fill \[m\], if there is one.
    pub(super) level: Option<f64>,
    /// The tangent of the angle of spread.
    pub(super) slope: f64,
}

/// The free parts of edges that face upwards, of the blocks of a body.
pub(super) fn tops<'a>(
    blocks: &'a [PlacedBlock],
    over: &'a str,
    free: impl Fn(usize, usize) -> Vec<[f64; 2]> + 'a,
) -> Vec<Top> {
    let is_of = |name: &str| {
        name.strip_prefix(over).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    let mut list = Vec::new();
    for (block, it) in blocks.iter().enumerate().filter(|(_, it)| is_of(&it.name)) {
        for edge in 0..it.corners.len() {
            let [right, left] = geometry::edge(&it.corners, edge);
            // An edge that is vertical but for rounding has no fill above it.
            if right.x - left.x <= geometry::SAME_PLACE * geometry::size(&it.corners) {
                continue;
            }
            let place = |part| geometry::on_edge(&it.corners, edge, part);
            let parts = free(block, edge).into_iter();
            list.extend(parts.map(|[from, to]| Top { block, ends: [place(to), place(from)] }));
        }
    }
    list
}

impl Top {
    /// The part that lies below a level, with the depths of its ends.
    fn below(self, level: f64) -> Option<([Point2<f64>; 2], [f64; 2])> {
        let [a, b] = self.ends;
        let (depth, other) = (level - a.y, level - b.y);
        let crossing = || a + (b - a) * (depth / (depth - other));
        match (depth > 0.0, other > 0.0) {
            (true, true) => Some(([a, b], [depth, other])),
            (true, false) => Some(([a, crossing()], [depth, 0.0])),
            (false, true) => Some(([crossing(), b], [0.0, other])),
            (false, false) => None,
        }
    }
}

/// The columns of fill up to a level.
pub(super) fn columns(tops: &[Top], level: f64) -> Vec<Share> {
    let column = |top: &Top| {
        let ([a, b], [depth, other]) = top.below(level)?;
        let size = 0.5 * (b.x - a.x) * (depth + other);
        let at = a + (b - a) * ((depth + 2.0 * other) / (3.0 * (depth + other)));
        Some(Share { block: top.block, at, size })
    };
    tops.iter().filter_map(column).collect()
}

impl PlacedAxle {
    /// The parts of its force on edges. Rays that meet none are not there.
    pub(super) fn shares(&self, tops: &[Top]) -> Vec<Share> {
        let highest = tops.iter().filter_map(|top| self.above(top));
        let highest = highest.max_by(|a, b| a.at.y.total_cmp(&b.at.y));
        match (self.level, highest) {
            (Some(level), Some(foot)) if foot.at.y >= level => vec![foot],
            (Some(level), _) => tops.iter().filter_map(|top| self.through(level, top)).collect(),
            (None, foot) => foot.into_iter().collect(),
        }
    }

    /// The whole force on an edge straight below it.
    fn above(&self, top: &Top) -> Option<Share> {
        let [a, b] = top.ends;
        let part = (self.x - a.x) / (b.x - a.x);
        let is_above = (0.0..=1.0).contains(&part);
        is_above.then(|| Share { block: top.block, at: a + (b - a) * part, size: 1.0 })
    }

    /// The part that an edge takes through a fill up to a level above the axle's foot.
    fn through(&self, level: f64, top: &Top) -> Option<Share> {
        let ([a, b], [depth, other]) = top.below(level)?;
        let [first, last] = [(a.x - self.x) / depth, (b.x - self.x) / other];
        let [from, to] = [first.max(-self.slope), last.min(self.slope)];
        // Rays meet an edge that faces away from the axle after another one, if at all.
        if from >= to {
            return None;
        }
        let place = |u: f64| (self.x + u * depth - a.x) / (b.x - a.x - u * (other - depth));
        let start = if first >= from { 0.0 } else { place(from) };
        let end = if last <= to { 1.0 } else { place(to) };
        let deep = |part: f64| depth + (other - depth) * part;
        let part = start + (end - start) * mean_of_rays(deep(end) / deep(start) - 1.0);
        let size = (to - from) / (2.0 * self.slope);
        Some(Share { block: top.block, at: a + (b - a) * part, size })
    }
}

/// The mean of the places on a segment, as parts of it, at which rays meet it, if the depth grows by `r` of itself along it.
///
/// The rays on a piece `ds` are as `ds / (1 + r s)^2`: the mean is `((1 + r) ln(1 + r) - r) / r^2`.
fn mean_of_rays(r: f64) -> f64 {
    // Chosen: the series and the formula both have twelve digits there.
    if r.abs() > 0.1 {
        return ((1.0 + r) * r.ln_1p() - r) / (r * r);
    }
    // Its next term is below the rounding of one half.
    (0..16).map(|k| (-r).powi(k) / f64::from((k + 1) * (k + 2))).sum()
}
