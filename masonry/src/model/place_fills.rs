//! Fill over blocks, and axles on it, as forces on the edges that face upwards.
//!
//! The weight of the column of fill above an edge varies linearly along the edge, and its resultant goes through the centroid of
//! the column. The force of an axle spreads along straight rays, as many for every unit of `u`, the horizontal
//! distance over the depth, up to `u = tan angle`: on a horizontal plane the pressure is uniform. An edge takes the rays that
//! meet it first, `(u_2 - u_1) / (2 tan angle)` of the force. An edge below another one of the same body, such as the sill of
//! a window, carries no fill.

use nalgebra::Point2;

use super::PlacedBlock;
use crate::geometry::{self, SAME_PLACE};

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

/// The free parts of edges that face upwards, of the blocks of a body, without those below others.
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
            if right.x - left.x <= SAME_PLACE * geometry::size(&it.corners) {
                continue;
            }
            let place = |part| geometry::on_edge(&it.corners, edge, part);
            let parts = free(block, edge).into_iter();
            list.extend(parts.map(|[from, to]| Top { block, ends: [place(to), place(from)] }));
        }
    }
    let seen = |top: &Top| {
        let hidden: Vec<_> = list.iter().filter_map(|other| top.below_other(other)).collect();
        let top = *top;
        geometry::without([0.0, 1.0], &hidden).into_iter().map(move |part| top.part(part))
    };
    list.iter().flat_map(seen).collect()
}

impl Top {
    /// The part of the edge that lies below another edge.
    fn below_other(&self, other: &Self) -> Option<[f64; 2]> {
        let [from, to] = [self.ends[0].x.max(other.ends[0].x), self.ends[1].x.min(other.ends[1].x)];
        let [low, high] = [self, other].map(|it| it.at(it.part_at(0.5 * (from + to))).y);
        (from < to && low < high).then(|| [from, to].map(|x| self.part_at(x)))
    }

    /// The part of the edge up to a place along x \[m\].
    fn part_at(&self, x: f64) -> f64 {
        let [a, b] = self.ends;
        (x - a.x) / (b.x - a.x)
    }

    fn at(&self, part: f64) -> Point2<f64> {
        let [a, b] = self.ends;
        a + (b - a) * part
    }

    fn part(self, part: [f64; 2]) -> Self {
        Self { ends: part.map(|it| self.at(it)), ..self }
    }

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

/// An edge that rays of an axle reach through a fill.
struct Reached {
    block: usize,
    ends: [Point2<f64>; 2],
    /// The depths of its ends \[m\].
    depths: [f64; 2],
    /// The rays to its ends.
    rays_to_ends: [f64; 2],
    /// The rays that meet it within the angle of spread.
    rays: [f64; 2],
}

impl PlacedAxle {
    /// The parts of its force on edges. Rays that meet no edge are left out.
    pub(super) fn shares(&self, tops: &[Top]) -> Vec<Share> {
        let highest = tops.iter().filter_map(|top| self.above(top));
        let highest = highest.max_by(|a, b| a.at.y.total_cmp(&b.at.y));
        let width: f64 = tops.iter().map(|top| top.ends[1].x - top.ends[0].x).sum();
        match (self.level, highest) {
            (Some(level), Some(foot)) if foot.at.y >= level - SAME_PLACE * width => vec![foot],
            (Some(level), _) => self.through(level, tops),
            (None, foot) => foot.into_iter().collect(),
        }
    }

    /// The whole force on an edge straight below it.
    fn above(&self, top: &Top) -> Option<Share> {
        let part = top.part_at(self.x);
        let is_above = (0.0..=1.0).contains(&part);
        is_above.then(|| Share { block: top.block, at: top.at(part), size: 1.0 })
    }

    /// The parts that edges take through a fill up to a level above the axle's foot, each of the rays that meet it first.
    fn through(&self, level: f64, tops: &[Top]) -> Vec<Share> {
        let reached: Vec<_> = tops.iter().filter_map(|top| self.reached(level, top)).collect();
        let shares = |it: &Reached| {
            let behind: Vec<_> =
                reached.iter().filter_map(|other| self.behind(it, other)).collect();
            let parts = geometry::without(it.rays, &behind).into_iter();
            parts.map(|rays| self.share(it, rays)).collect::<Vec<_>>()
        };
        reached.iter().flat_map(shares).collect()
    }

    fn reached(&self, level: f64, top: &Top) -> Option<Reached> {
        let (ends, depths) = top.below(level)?;
        let rays_to_ends = [0, 1].map(|k| (ends[k].x - self.x) / depths[k]);
        let rays = [rays_to_ends[0].max(-self.slope), rays_to_ends[1].min(self.slope)];
        // An edge that faces away from the axle is met by none.
        (rays[0] < rays[1]).then_some(Reached {
            block: top.block,
            ends,
            depths,
            rays_to_ends,
            rays,
        })
    }

    /// The rays that meet another edge before this one.
    fn behind(&self, it: &Reached, other: &Reached) -> Option<[f64; 2]> {
        let [from, to] = [it.rays[0].max(other.rays[0]), it.rays[1].min(other.rays[1])];
        let [deep, less] = [it, other].map(|it| it.depth(self.met(it, 0.5 * (from + to))));
        (from < to && less < deep).then_some([from, to])
    }

    /// The part of an edge up to the place at which a ray meets it.
    fn met(&self, it: &Reached, ray: f64) -> f64 {
        let ([a, b], [depth, other]) = (it.ends, it.depths);
        (self.x + ray * depth - a.x) / (b.x - a.x - ray * (other - depth))
    }

    fn share(&self, it: &Reached, rays: [f64; 2]) -> Share {
        let [first, last] = it.rays_to_ends;
        let start = if first >= rays[0] { 0.0 } else { self.met(it, rays[0]) };
        let end = if last <= rays[1] { 1.0 } else { self.met(it, rays[1]) };
        let growth = it.depth(end) / it.depth(start) - 1.0;
        let part = start + (end - start) * mean_of_rays(growth);
        let ([a, b], size) = (it.ends, (rays[1] - rays[0]) / (2.0 * self.slope));
        Share { block: it.block, at: a + (b - a) * part, size }
    }
}

impl Reached {
    fn depth(&self, part: f64) -> f64 {
        self.depths[0] + (self.depths[1] - self.depths[0]) * part
    }
}

/// The mean of the places on a segment, as parts of it, at which rays meet it, if the depth grows by `r` of itself along it.
///
/// The density of rays at the part `s` is proportional to `1 / (1 + r s)^2`: the mean is `((1 + r) ln(1 + r) - r) / r^2`.
fn mean_of_rays(r: f64) -> f64 {
    // Chosen: series and formula agree to twelve digits there.
    if r.abs() > 0.1 {
        return ((1.0 + r) * r.ln_1p() - r) / (r * r);
    }
    // The next term is below the rounding of one half.
    (0..16).map(|k| (-r).powi(k) / f64::from((k + 1) * (k + 2))).sum()
}
