//! Checks of where blocks and supports lie relative to each other.

use std::collections::BTreeMap;

use nalgebra::Point2;

use super::{Block, Body, Joint, Support};
use crate::geometry::{self, Quad};
use crate::scene::{Fault, KeyPath, SceneErrorKind};
use crate::units::Units;

/// Overlaps below this fraction of the smaller block are rounding errors.
const TOLERANCE: f64 = 1e-9;

/// Refuses two blocks of one name: a single block named as a brick of a wall, say.
pub(super) fn check_names(blocks: &[Block], keys: &[KeyPath]) -> Result<(), Fault> {
    let mut taken = BTreeMap::new();
    for (block, key) in blocks.iter().zip(keys) {
        if let Some(first) = taken.insert(&block.name, key) {
            let (name, first) = (block.name.clone(), first.to_string());
            let kind = SceneErrorKind::Duplicate { what: "block", name, first };
            return Err(Fault::new(key.clone(), kind));
        }
    }
    Ok(())
}

/// Refuses blocks that overlap.
pub(super) fn check_overlaps(
    blocks: &[Block],
    keys: &[KeyPath],
    units: Units,
) -> Result<(), Fault> {
    for (i, j) in near_pairs(blocks) {
        let (first, second) = (&blocks[i], &blocks[j]);
        let area = geometry::overlap_area(&first.corners, &second.corners);
        let size = geometry::size(&first.corners).min(geometry::size(&second.corners));
        if area > TOLERANCE * size * size {
            let kind = SceneErrorKind::Overlap {
                first: first.name.clone(),
                second: second.name.clone(),
                area: area / (units.length_to_si() * units.length_to_si()),
                unit: units.length_name(),
            };
            return Err(Fault::new(keys[j].clone(), kind));
        }
    }
    Ok(())
}

/// Pairs of blocks whose bounding boxes overlap, found by a sweep from left to right; in increasing
/// order, so that the first overlap reported does not depend on the sweep.
fn near_pairs(blocks: &[Block]) -> Vec<(usize, usize)> {
    let boxes: Vec<[[f64; 2]; 2]> = blocks.iter().map(|block| bounds(&block.corners)).collect();
    let mut order: Vec<usize> = (0..blocks.len()).collect();
    order.sort_by(|i, j| boxes[*i][0][0].total_cmp(&boxes[*j][0][0]));
    let mut open: Vec<usize> = Vec::new();
    let mut pairs = Vec::new();
    for new in order {
        let ([left, low], [_, high]) = (boxes[new][0], boxes[new][1]);
        open.retain(|old| boxes[*old][1][0] > left);
        let meets = |old: &&usize| boxes[**old][0][1] < high && boxes[**old][1][1] > low;
        pairs.extend(open.iter().filter(meets).map(|old| (new.min(*old), new.max(*old))));
        open.push(new);
    }
    pairs.sort_unstable();
    pairs
}

/// Lower left and upper right corner of the bounding box.
fn bounds(quad: &Quad) -> [[f64; 2]; 2] {
    let fold = |f: fn(f64, f64) -> f64| {
        let of = |axis: usize| quad[1..].iter().fold(quad[0][axis], |x, p| f(x, p[axis]));
        [of(0), of(1)]
    };
    [fold(f64::min), fold(f64::max)]
}

/// Refuses supports that run through the inside of a block.
pub(super) fn check_supports(
    blocks: &[Block],
    supports: &[Support],
    units: Units,
) -> Result<(), Fault> {
    for (k, support) in supports.iter().enumerate() {
        for block in blocks {
            let length = length_inside(support.from, support.to, &block.corners);
            if length > TOLERANCE * geometry::size(&block.corners) {
                let kind = SceneErrorKind::Pierced {
                    support: support.name.clone(),
                    block: block.name.clone(),
                    length: length / units.length_to_si(),
                    unit: units.length_name(),
                };
                return Err(Fault::new(KeyPath::of("supports").item(k), kind));
            }
        }
    }
    Ok(())
}

/// Length of the part of a segment that is deeper in a block than rounding errors.
fn length_inside(from: Point2<f64>, to: Point2<f64>, quad: &Quad) -> f64 {
    let depth = TOLERANCE * geometry::size(quad);
    let along = to - from;
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for k in 0..4 {
        let inwards = -geometry::outward_normal(quad, k);
        let at_start = (from - quad[k]).dot(&inwards) - depth;
        let slope = along.dot(&inwards);
        if slope > 0.0 {
            start = start.max(-at_start / slope);
        } else if slope < 0.0 {
            end = end.min(-at_start / slope);
        } else if at_start < 0.0 {
            return 0.0;
        }
    }
    (end - start).max(0.0) * along.norm()
}

/// Refuses blocks and supports that meet nothing.
pub(super) fn check_touching(
    blocks: &[Block],
    keys: &[KeyPath],
    supports: &[Support],
    joints: &[Joint],
) -> Result<(), Fault> {
    let mut block_meets = vec![false; blocks.len()];
    let mut support_meets = vec![false; supports.len()];
    for joint in joints {
        block_meets[joint.b.index()] = true;
        match joint.a {
            Body::Block(id) => block_meets[id.index()] = true,
            Body::Support(id) => support_meets[id.index()] = true,
        }
    }
    if let Some(k) = support_meets.iter().position(|meets| !meets) {
        let kind = SceneErrorKind::IdleSupport { support: supports[k].name.clone() };
        return Err(Fault::new(KeyPath::of("supports").item(k), kind));
    }
    if let Some(k) = block_meets.iter().position(|meets| !meets) {
        let kind = SceneErrorKind::LooseBlock { block: blocks[k].name.clone() };
        return Err(Fault::new(keys[k].clone(), kind));
    }
    Ok(())
}
