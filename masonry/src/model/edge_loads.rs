//! Loads on the free parts of block edges that lie on a segment.

use nalgebra::{Point2, Vector2};

use super::{Block, ContactPoint, EdgeLoad, Joint};
use crate::geometry;
use crate::ids::LoadId;
use crate::scene::{Fault, KeyPath, Load, Scene, SceneErrorKind};
use crate::units::Units;

/// Distances below this fraction of a block's size count as zero.
const TOLERANCE: f64 = 1e-9;

/// A part of an edge, as fractions of it.
type Part = [f64; 2];

/// Puts the loads of a scene on its blocks. Parts of edges that make joints are not free and
/// carry no load, so that a load cannot act inside a joint.
pub(super) fn place(
    scene: &Scene,
    blocks: &mut [Block],
    joints: &[Joint],
    contacts: &[ContactPoint],
) -> Result<(), Fault> {
    let joined = joined_parts(blocks, joints, contacts);
    for (k, load) in scene.loads.iter().enumerate() {
        let [from, to] =
            [load.from, load.to].map(|[x, y]| Point2::new(x, y) * scene.units.length_to_si());
        let mut acts = false;
        for (block, joined) in blocks.iter_mut().zip(&joined) {
            for (edge, joined) in joined.iter().enumerate() {
                let Some(covered) = covered_part(&block.corners, edge, from, to) else { continue };
                let traction = traction(load, &block.corners, edge, scene.units);
                for [from, to] in free_parts(covered, joined) {
                    let load = LoadId::new(k);
                    block.edge_loads.push(EdgeLoad { edge, from, to, traction, load });
                    acts = true;
                }
            }
        }
        if !acts {
            let kind = SceneErrorKind::IdleLoad { load: load.name.clone() };
            return Err(Fault::new(KeyPath::of("loads").item(k), kind));
        }
    }
    Ok(())
}

/// Traction on the block \[Pa\].
fn traction(load: &Load, corners: &geometry::Quad, edge: usize, units: Units) -> Vector2<f64> {
    let in_scene = match (load.traction, load.pressure) {
        (Some(traction), _) => Vector2::from(traction),
        (None, pressure) => -geometry::outward_normal(corners, edge) * pressure.unwrap_or(0.0),
    };
    in_scene * units.stress_to_si()
}

/// The part of an edge that lies on a segment; `None` when they share no length.
fn covered_part(
    corners: &geometry::Quad,
    edge: usize,
    from: Point2<f64>,
    to: Point2<f64>,
) -> Option<Part> {
    let [start, end] = geometry::edge(corners, edge);
    let length = (end - start).norm();
    let slack = TOLERANCE * geometry::size(corners);
    let (normal, along) = (geometry::outward_normal(corners, edge), (end - start) / length);
    let place = |p: Point2<f64>| (p - start).dot(&along);
    let (a, b) = (place(from), place(to));
    if (b - a).abs() <= slack {
        return None;
    }
    let (low, high) = (a.min(b).max(0.0), a.max(b).min(length));
    if high - low <= slack {
        return None;
    }
    // Only where the segment runs along the edge must it lie on it: far away it may be off by
    // rounding.
    let distance = |s: f64| (from + (to - from) * ((s - a) / (b - a)) - start).dot(&normal);
    if distance(low).abs() > slack || distance(high).abs() > slack {
        return None;
    }
    Some([low, high].map(|s| snap(s / length)))
}

/// The ends of an edge exactly, where rounding misses them.
fn snap(fraction: f64) -> f64 {
    if fraction < TOLERANCE {
        0.0
    } else if fraction > 1.0 - TOLERANCE {
        1.0
    } else {
        fraction
    }
}

/// What is left of a part when the joined parts are taken out.
fn free_parts(covered: Part, joined: &[Part]) -> Vec<Part> {
    let mut free = vec![covered];
    for [from, to] in joined {
        free = free
            .into_iter()
            .flat_map(|[a, b]| [[a, b.min(*from)], [a.max(*to), b]])
            .filter(|[a, b]| b - a > TOLERANCE)
            .collect();
    }
    free
}

/// For every block and edge, the parts that make joints.
fn joined_parts(
    blocks: &[Block],
    joints: &[Joint],
    contacts: &[ContactPoint],
) -> Vec<[Vec<Part>; 4]> {
    let mut joined = vec![<[Vec<Part>; 4]>::default(); blocks.len()];
    // All points of a joint sit on the same two edges: the first tells which.
    let mut last = None;
    for contact in contacts {
        if last.replace(contact.joint) == Some(contact.joint) {
            continue;
        }
        let joint = &joints[contact.joint.index()];
        for anchor in contact.a.into_iter().chain([contact.b]) {
            let block = anchor.block.index();
            let part = projected(&blocks[block].corners, anchor.edge, joint);
            joined[block][anchor.edge].push(part);
        }
    }
    joined
}

/// The part of an edge in front of a joint.
fn projected(corners: &geometry::Quad, edge: usize, joint: &Joint) -> Part {
    let [start, end] = geometry::edge(corners, edge);
    let along = (end - start) / (end - start).norm_squared();
    let [a, b] = [joint.from, joint.to].map(|p| snap((p - start).dot(&along)));
    [a.min(b), a.max(b)]
}
