//! Fill on blocks, and axles on the fill, as loads on the edges that face upwards.
//!
//! The weight of the column of fill above an edge varies linearly along the edge. The force of an axle spreads along
//! straight rays. Let `u` be the horizontal distance divided by the depth; there are equally many rays for every unit
//! of `u`, up to `u = tan angle`, so that the pressure on a horizontal plane is uniform. Each ray loads the edge that
//! it meets first: an edge met by the rays from `u_1` to `u_2` takes `(u_2 - u_1) / (2 tan angle)` of the force. An
//! edge below another edge of the structure, such as the sill of a window, carries no fill.

use nalgebra::{Point2, Vector2};

use super::{EdgeLoad, PlacedBlock, PointLoad};
use crate::geometry::{self, SAME_PLACE};
use crate::ids::LoadId;

/// A part of an edge that faces upwards; its ends are in order from left to right.
#[derive(Debug, Clone, Copy)]
pub(super) struct Top {
    block: usize,
    edge: usize,
    ends: [Point2<f64>; 2],
    /// The ends as fractions of the edge, which runs from right to left.
    fractions: [f64; 2],
}

/// The part of a force that one edge or one place of a block takes.
#[derive(Debug, Clone, Copy)]
pub(super) enum Share {
    /// The whole force, at one place of a block.
    Place { block: usize, at: Point2<f64> },
    /// A part of the force, distributed on an edge.
    Strip {
        on: Top,
        /// The densities at both ends, per unit of length along the edge, with linear variation between the ends:
        /// \[1/m\] for a part of a force, \[m\] for a fill.
        density: [f64; 2],
    },
}

/// An axle: its place, and the fill below it.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlacedAxle {
    /// The place of the axle along x \[m\].
    pub(super) x: f64,
    /// The height of the top of the fill \[m\]; `None` if there is no fill.
    pub(super) level: Option<f64>,
    /// The tangent of the angle at which the fill spreads the force \[-\].
    pub(super) slope: f64,
}

/// Returns the free parts of the edges of a body that face upwards, without the parts that lie below other edges of
/// the structure.
pub(super) fn tops(
    blocks: &[PlacedBlock],
    over: &str,
    free: impl Fn(usize, usize) -> Vec<[f64; 2]>,
) -> Vec<Top> {
    let all: Vec<Top> = (0..blocks.len()).flat_map(|block| Top::of(blocks, block)).collect();
    let is_block = blocks.iter().any(|it| it.name == over);
    let is_of = |name: &str| {
        let rest = name.strip_prefix(over);
        rest.is_some_and(|rest| rest.is_empty() || !is_block && rest.starts_with('/'))
    };
    let seen = |top: &Top| {
        let hidden: Vec<_> = all.iter().filter_map(|other| top.below_other(other)).collect();
        let free = free(top.block, top.edge).into_iter();
        let seen =
            free.flat_map(move |[from, to]| geometry::without([1.0 - to, 1.0 - from], &hidden));
        let top = *top;
        seen.map(move |part| top.part(part)).collect::<Vec<_>>()
    };
    all.iter().filter(|top| is_of(&blocks[top.block].name)).flat_map(seen).collect()
}

impl Top {
    /// Returns the edges of a block that face upwards, at full length.
    fn of(blocks: &[PlacedBlock], block: usize) -> Vec<Self> {
        let corners = &blocks[block].corners;
        let top = |edge: usize| {
            let [right, left] = geometry::edge(corners, edge);
            // An edge that is vertical up to rounding has no fill above it.
            let is_top = right.x - left.x > SAME_PLACE * geometry::size(corners);
            is_top.then_some(Self { block, edge, ends: [left, right], fractions: [1.0, 0.0] })
        };
        (0..corners.len()).filter_map(top).collect()
    }

    /// Returns the part of the edge that lies below another edge, in fractions of the edge; `None` if there is no such
    /// part.
    fn below_other(&self, other: &Self) -> Option<[f64; 2]> {
        let [from, to] = [self.ends[0].x.max(other.ends[0].x), self.ends[1].x.min(other.ends[1].x)];
        let [low, high] = [self, other].map(|it| it.at(it.part_at(0.5 * (from + to))).y);
        let near = SAME_PLACE * (self.ends[1].x - self.ends[0].x);
        (from < to && low < high - near).then(|| [from, to].map(|x| self.part_at(x)))
    }

    /// Returns the place on the edge with the coordinate `x` \[m\], as a fraction of the edge.
    fn part_at(&self, x: f64) -> f64 {
        let [a, b] = self.ends;
        (x - a.x) / (b.x - a.x)
    }

    fn at(&self, part: f64) -> Point2<f64> {
        let [a, b] = self.ends;
        a + (b - a) * part
    }

    fn part(&self, part: [f64; 2]) -> Self {
        let [first, last] = self.fractions;
        let ends = part.map(|it| self.at(it));
        Self { ends, fractions: part.map(|it| first + (last - first) * it), ..*self }
    }

    /// Returns the part of the edge that lies below a level, with the depths of its two ends \[m\]; `None` if all of
    /// the edge lies above the level.
    fn below(&self, level: f64) -> Option<(Self, [f64; 2])> {
        let [depth, other] = self.ends.map(|end| level - end.y);
        let crossing = depth / (depth - other);
        match (depth > 0.0, other > 0.0) {
            (true, true) => Some((*self, [depth, other])),
            (true, false) => Some((self.part([0.0, crossing]), [depth, 0.0])),
            (false, true) => Some((self.part([crossing, 1.0]), [0.0, other])),
            (false, false) => None,
        }
    }

    fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

impl Share {
    /// Adds the share to the loads of its block, as a downward load. `force` is the total force \[N\], or the weight
    /// of a fill divided by its area \[N/m^2\].
    pub(super) fn press(
        &self,
        blocks: &mut [PlacedBlock],
        force: f64,
        thickness: f64,
        load: LoadId,
    ) {
        let down = |size: f64| Vector2::new(0.0, -force * size);
        match *self {
            Self::Place { block, at } => {
                blocks[block]
                    .loads
                    .push(PointLoad { at, force: down(1.0), moment: 0.0, load }.into());
            }
            Self::Strip { on: Top { block, edge, fractions: [to, from], .. }, density } => {
                // The edge runs from right to left.
                let traction = [density[1], density[0]].map(|it| down(it) / thickness);
                blocks[block].loads.push(EdgeLoad { edge, from, to, traction, load }.into());
            }
        }
    }
}

/// Returns for each edge the column of fill above it, up to a level.
pub(super) fn columns(tops: &[Top], level: f64) -> Vec<Share> {
    let column = |top: &Top| {
        let (on, depths) = top.below(level)?;
        // A column is as wide as its edge is along x.
        let width = (on.ends[1].x - on.ends[0].x) / on.length();
        Some(Share::Strip { on, density: depths.map(|depth| depth * width) })
    };
    tops.iter().filter_map(column).collect()
}

/// An edge that rays of an axle reach through the fill.
struct Reached {
    top: Top,
    /// The depths of the ends of the edge \[m\].
    depths: [f64; 2],
    /// The rays to the two ends of the edge, as distances divided by depths (`u`).
    rays_to_ends: [f64; 2],
    /// The first and the last ray that meet the edge within the angle of spread.
    rays: [f64; 2],
}

impl PlacedAxle {
    /// Returns the parts of the axle's force on edges. Rays that meet no edge carry nothing.
    pub(super) fn shares(&self, tops: &[Top]) -> Vec<Share> {
        let highest = tops.iter().filter_map(|top| Some((top, self.above(top)?)));
        let highest = highest.max_by(|a, b| a.1.y.total_cmp(&b.1.y));
        let foot = highest.map(|(top, at)| Share::Place { block: top.block, at });
        let width: f64 = tops.iter().map(|top| top.ends[1].x - top.ends[0].x).sum();
        match (self.level, highest) {
            (Some(level), Some((_, at))) if at.y >= level - SAME_PLACE * width => {
                foot.into_iter().collect()
            }
            (Some(level), _) => self.through(level, tops),
            (None, _) => foot.into_iter().collect(),
        }
    }

    /// Returns the place on an edge straight below the axle; `None` if the axle is beside the edge.
    fn above(&self, top: &Top) -> Option<Point2<f64>> {
        let part = top.part_at(self.x);
        (0.0..=1.0).contains(&part).then(|| top.at(part))
    }

    /// Returns the parts of the force that edges take through the fill, whose top is above the edge below the axle;
    /// each edge takes the rays that meet it first.
    fn through(&self, level: f64, tops: &[Top]) -> Vec<Share> {
        let reached: Vec<_> = tops.iter().filter_map(|top| self.reached(level, top)).collect();
        let shares = |it: &Reached| {
            let behind: Vec<_> =
                reached.iter().filter_map(|other| self.behind(it, other)).collect();
            let parts = geometry::without(it.rays, &behind).into_iter();
            parts.flat_map(|rays| self.linear(it, rays)).collect::<Vec<_>>()
        };
        reached.iter().flat_map(shares).collect()
    }

    fn reached(&self, level: f64, top: &Top) -> Option<Reached> {
        let (top, depths) = top.below(level)?;
        let rays_to_ends = [0, 1].map(|k| (top.ends[k].x - self.x) / depths[k]);
        let rays = [rays_to_ends[0].max(-self.slope), rays_to_ends[1].min(self.slope)];
        // No ray meets an edge that faces away from the axle.
        (rays[0] < rays[1]).then_some(Reached { top, depths, rays_to_ends, rays })
    }

    /// Returns the rays that meet the edge `other` before the edge `it`; `None` if there are no such rays.
    fn behind(&self, it: &Reached, other: &Reached) -> Option<[f64; 2]> {
        let [from, to] = [it.rays[0].max(other.rays[0]), it.rays[1].min(other.rays[1])];
        let [deep, less] = [it, other].map(|it| it.depth(self.met(it, 0.5 * (from + to))));
        (from < to && less < deep).then_some([from, to])
    }

    /// Returns the place at which a ray meets an edge, as a fraction of the edge.
    fn met(&self, it: &Reached, ray: f64) -> f64 {
        let ([a, b], [depth, other]) = (it.top.ends, it.depths);
        (self.x + ray * depth - a.x) / (b.x - a.x - ray * (other - depth))
    }

    /// Returns the load of some rays on an edge, linear along pieces of the edge; the load of each piece has the
    /// resultant of its rays.
    fn linear(&self, it: &Reached, rays: [f64; 2]) -> Vec<Share> {
        let [first, last] = it.rays_to_ends;
        let start = if first >= rays[0] { 0.0 } else { self.met(it, rays[0]) };
        let end = if last <= rays[1] { 1.0 } else { self.met(it, rays[1]) };
        let middle = mean_of_rays(it.depth(end) / it.depth(start) - 1.0);
        // A linear density whose resultant lies outside of the middle third would be negative at one end.
        if !(1.0 / 3.0..=2.0 / 3.0).contains(&middle) {
            let half = f64::midpoint(rays[0], rays[1]);
            let halves = [[rays[0], half], [half, rays[1]]];
            return halves.into_iter().flat_map(|rays| self.linear(it, rays)).collect();
        }
        let on = it.top.part([start, end]);
        let mean = (rays[1] - rays[0]) / (2.0 * self.slope * on.length());
        let density = [4.0 - 6.0 * middle, 6.0 * middle - 2.0].map(|it| it * mean);
        vec![Share::Strip { on, density }]
    }
}

impl Reached {
    fn depth(&self, part: f64) -> f64 {
        self.depths[0] + (self.depths[1] - self.depths[0]) * part
    }
}

/// Returns the mean of the places at which rays meet a segment, as a fraction of the segment, if the depth grows by
/// the factor `1 + r` along the segment.
///
/// The density of rays at the fraction `s` is proportional to `1 / (1 + r s)^2`: the mean is
/// `((1 + r) ln(1 + r) - r) / r^2`.
fn mean_of_rays(r: f64) -> f64 {
    // Chosen: at this value series and formula agree to twelve digits.
    if r.abs() > 0.1 {
        return ((1.0 + r) * r.ln_1p() - r) / (r * r);
    }
    // The next term is below the rounding of one half.
    (0..16).map(|k| (-r).powi(k) / f64::from((k + 1) * (k + 2))).sum()
}
