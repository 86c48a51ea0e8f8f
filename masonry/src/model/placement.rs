//! Checks of the positions of blocks and supports relative to each other.

use std::collections::BTreeMap;

use super::{Body, PlacedBlock, PlacedJoint, PlacedSupport};
use crate::geometry::{self, Extent, SAME_PLACE};
use crate::ids::{BlockId, SupportId};
use crate::model::joints::near_pairs;
use crate::rounding::rounded;
use crate::scene::{Fault, KeyPath, Scene, SceneErrorKind};
use crate::units::Units;

/// Refuses two blocks with the same name: for instance, a single block with the name of a brick of a wall.
pub(super) fn check_names(blocks: &[PlacedBlock], keys: &[KeyPath]) -> Result<(), Fault> {
    let mut taken = BTreeMap::new();
    for (block, key) in blocks.iter().zip(keys) {
        if let Some(first) = taken.insert(&block.name, key) {
            return Err(Fault::duplicate(key.clone(), "block", &block.name, first));
        }
    }
    Ok(())
}

/// Refuses blocks that overlap.
pub(super) fn check_overlaps(
    blocks: &[PlacedBlock],
    keys: &[KeyPath],
    units: Units,
) -> Result<(), Fault> {
    for [i, j] in near_pairs(blocks.iter().map(|it| &it.corners[..]), 0.0) {
        let (first, second) = (&blocks[i], &blocks[j]);
        let area = geometry::overlap_area(&first.corners, &second.corners);
        let size = geometry::size(&first.corners).min(geometry::size(&second.corners));
        if area > SAME_PLACE * size * size {
            let kind = SceneErrorKind::Overlap {
                first: first.name.clone(),
                second: second.name.clone(),
                area: rounded(area / (units.length_to_si() * units.length_to_si())),
                unit: units.length_name(),
            };
            return Err(Fault::new(keys[j].clone(), kind));
        }
    }
    Ok(())
}

/// Refuses supports that move farther than the blocks reach. The theory is for small displacements, and larger
/// movements would leave no digits for the deformation.
pub(super) fn check_movements(scene: &Scene, blocks: &[PlacedBlock]) -> Result<(), Fault> {
    let extent = Extent::of(blocks.iter().flat_map(|block| &block.corners)).longer_side();
    let extent = extent / scene.units.length_to_si();
    for (k, stage) in scene.stages.iter().enumerate() {
        for (name, to) in &stage.moves {
            for (key, value) in [("x", to.x), ("y", to.y)] {
                if value.abs() > extent {
                    let wanted = "displacements are small: a support moves by less than the structure is \
                                  large";
                    let at = KeyPath::of("stages").item(k).key("moves").key(name).key(key);
                    return Err(Fault::new(at, SceneErrorKind::Value { value, wanted }));
                }
            }
        }
    }
    Ok(())
}

/// Refuses supports that run through the inside of a block.
pub(super) fn check_supports(
    blocks: &[PlacedBlock],
    supports: &[PlacedSupport],
    units: Units,
) -> Result<(), Fault> {
    for (k, support) in supports.iter().enumerate() {
        let ends = [support.from, support.to];
        let around = Extent::of(&ends);
        for block in blocks.iter().filter(|it| Extent::of(&it.corners).meets(&around)) {
            let near = SAME_PLACE * geometry::size(&block.corners);
            let length = geometry::length_inside(ends, &block.corners, near);
            if length > near {
                let kind = SceneErrorKind::Pierced {
                    support: support.name.clone(),
                    block: block.name.clone(),
                    length: rounded(length / units.length_to_si()),
                    unit: units.length_name(),
                };
                return Err(Fault::new(KeyPath::of("supports").item(k), kind));
            }
        }
    }
    Ok(())
}

/// Refuses two supports that lie on each other along a block: the strength of their joints would count twice.
pub(super) fn check_overlapping_supports(
    blocks: &[PlacedBlock],
    supports: &[PlacedSupport],
    joints: &[PlacedJoint],
    units: Units,
) -> Result<(), Fault> {
    let mut held: BTreeMap<BlockId, Vec<(SupportId, &PlacedJoint)>> = BTreeMap::new();
    for joint in joints {
        let Body::Support(second) = joint.a else { continue };
        let block = &blocks[joint.b.index()];
        let near = SAME_PLACE * geometry::size(&block.corners);
        let before = held.entry(joint.b).or_default();
        for (first, other) in before.iter() {
            let [one, two] = [*first, second].map(|id| &supports[id.index()]);
            let length = common_length(joint, other);
            if one.is_along(two, near) && joint.normal.dot(&other.normal) > 0.0 && length > near {
                let kind = SceneErrorKind::OverlappingSupports {
                    first: one.name.clone(),
                    second: two.name.clone(),
                    block: block.name.clone(),
                    length: rounded(length / units.length_to_si()),
                    unit: units.length_name(),
                };
                return Err(Fault::new(KeyPath::of("supports").item(second.index()), kind));
            }
        }
        before.push((second, joint));
    }
    Ok(())
}

/// Returns the length along which two parallel joints lie beside each other.
fn common_length(joint: &PlacedJoint, other: &PlacedJoint) -> f64 {
    let along = (joint.to - joint.from).normalize();
    let [a, b] = [joint, other].map(|it| {
        let [from, to] = [it.from, it.to].map(|end| (end - joint.from).dot(&along));
        [from.min(to), from.max(to)]
    });
    a[1].min(b[1]) - a[0].max(b[0])
}

impl PlacedSupport {
    /// Returns whether another support overlaps this one along the same line, whichever way each of them was drawn. `near`
    /// is the largest distance \[m\] between them.
    fn is_along(&self, other: &Self, near: f64) -> bool {
        let lies_on =
            |line| geometry::facing_overlap([self.from, self.to], line, near, 0.0).is_some();
        lies_on([other.from, other.to]) || lies_on([other.to, other.from])
    }
}

/// Refuses blocks and supports that touch nothing.
pub(super) fn check_touching(
    blocks: &[PlacedBlock],
    keys: &[KeyPath],
    supports: &[PlacedSupport],
    joints: &[PlacedJoint],
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
        let kind = SceneErrorKind::IdleSupport(supports[k].name.clone());
        return Err(Fault::new(KeyPath::of("supports").item(k), kind));
    }
    if let Some(k) = block_meets.iter().position(|meets| !meets) {
        let kind = SceneErrorKind::LooseBlock(blocks[k].name.clone());
        return Err(Fault::new(keys[k].clone(), kind));
    }
    Ok(())
}
