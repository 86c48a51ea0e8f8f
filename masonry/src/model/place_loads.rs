//! The loads of a scene on its blocks: edges on a segment, places in a block, and all mass.

use std::collections::BTreeMap;

use nalgebra::{Point2, Vector2};

use super::{Acceleration, EdgeLoad, JointPoint, LoadCase, PlacedBlock, PlacedJoint, PointLoad};
use crate::geometry::{self, SAME_PLACE};
use crate::ids::LoadId;
use crate::rounding::rounded;
use crate::scene::{self, EdgeStress, Fault, KeyPath, LoadError, LoadKind, Scene, SceneErrorKind};
use crate::units::Units;

/// Names in a message about one that does not exist.
const NAMES: usize = 3;

/// A part of an edge, as fractions of it.
type EdgePart = [f64; 2];

/// Puts the loads of a scene on its blocks, whose corners were moved by up to a distance \[m\]; their names, and those that act
/// on all mass.
pub(super) fn place(
    scene: &Scene,
    blocks: &mut [PlacedBlock],
    joints: &[PlacedJoint],
    contacts: &[JointPoint],
    moved: f64,
) -> Result<(Vec<LoadCase>, Vec<Acceleration>), Fault> {
    let joined = joined_parts(blocks, joints, contacts);
    let places: BTreeMap<String, usize> =
        blocks.iter().enumerate().map(|(k, block)| (block.name.clone(), k)).collect();
    let (mut loads, mut accelerations) = (Vec::new(), Vec::new());
    for (k, load) in scene.loads.iter().enumerate() {
        let (at, id) = (KeyPath::of("loads").item(k), LoadId::new(k));
        match load.kind() {
            Some(LoadKind::Edge { from, to, stress }) => {
                let ends = [from, to].map(|end| scene.units.point(end));
                let on_edge = OnEdges { load, id, ends, stress, units: scene.units, moved };
                if !on_edge.place(blocks, &joined) {
                    return Err(Fault::new(at, SceneErrorKind::IdleLoad(load.name.clone())));
                }
            }
            Some(LoadKind::Force { block, at: place, force }) => {
                let Some(k) = places.get(block) else {
                    return Err(Fault::new(at.key("block"), unknown(blocks, block)));
                };
                let block = &mut blocks[*k];
                let at = place_in(block, scene.units.point(place), scene.units, moved)
                    .map_err(|error| Fault::new(at.key("at"), error))?;
                let force = Vector2::from(force) * scene.units.force_to_si() * load.factor;
                block.loads.push(PointLoad { at, force, load: id }.into());
            }
            Some(LoadKind::Acceleration(value)) => {
                let value = Vector2::from(value) * load.factor;
                accelerations.push(Acceleration { value, load: id });
            }
            // A load of no kind was refused before.
            None => {}
        }
        let (name, group) = (load.name.clone(), load.group_name().to_owned());
        loads.push(LoadCase { name, group, factor: load.factor, mass: load.mass });
    }
    accelerate(scene, blocks, &loads, &accelerations)?;
    Ok((loads, accelerations))
}

/// Lets accelerations act on the masses whose weights are loads, at the places of these loads.
fn accelerate(
    scene: &Scene,
    blocks: &mut [PlacedBlock],
    loads: &[LoadCase],
    accelerations: &[Acceleration],
) -> Result<(), Fault> {
    let gravity = Vector2::from(scene.gravity.unwrap_or_default());
    for block in blocks {
        let mut inertia = Vec::new();
        for load in &block.loads {
            let id = load.load().index();
            let part = loads[id].mass.unwrap_or(0.0);
            if part <= 0.0 {
                continue;
            }
            // Mass per area of an edge, or the mass at a place.
            let mass = |force: Vector2<f64>| part * force.dot(&gravity) / gravity.norm_squared();
            if load.force_or_traction().dot(&gravity) < 0.0 {
                let because = "acts against gravity: let it press down, or leave `mass` out";
                let error = LoadError::NoWeight { load: loads[id].name.clone(), because };
                return Err(Fault::new(KeyPath::of("loads").item(id).key("mass"), error));
            }
            let on_mass = |it: &Acceleration| load.instead(it.load, |force| it.value * mass(force));
            inertia.extend(accelerations.iter().map(on_mass));
        }
        block.loads.extend(inertia);
    }
    Ok(())
}

/// No block has this name: those whose names are nearest.
fn unknown(blocks: &[PlacedBlock], name: &str) -> LoadError {
    let mut near: Vec<&str> = blocks.iter().map(|block| block.name.as_str()).collect();
    // The sort keeps the order of the scene among names that are equally near.
    near.sort_by_cached_key(|other| strsim::levenshtein(name, other));
    near.truncate(NAMES);
    let near = near.into_iter().map(str::to_owned).collect();
    LoadError::NoBlock { name: name.to_owned(), near }
}

/// A place on a block. One that rounding has put outside is moved to the edge.
fn place_in(
    block: &PlacedBlock,
    at: Point2<f64>,
    units: Units,
    moved: f64,
) -> Result<Point2<f64>, LoadError> {
    let corners = &block.corners;
    let distance = geometry::outside(corners, at);
    if distance > SAME_PLACE * geometry::size(corners) + moved {
        let nearest = geometry::nearest_on_boundary(corners, at);
        let in_scene = |metres: f64| rounded(metres / units.length_to_si());
        return Err(LoadError::Outside {
            block: block.name.clone(),
            place: [at.x, at.y].map(in_scene),
            nearest: [nearest.x, nearest.y].map(in_scene),
            distance: in_scene((at - nearest).norm()),
            unit: units.length_name(),
        });
    }
    Ok(if distance > 0.0 { geometry::nearest_on_boundary(corners, at) } else { at })
}

/// A load on all free parts of edges that lie on a segment.
struct OnEdges<'a> {
    load: &'a scene::Load,
    id: LoadId,
    ends: [Point2<f64>; 2],
    stress: EdgeStress,
    units: Units,
    /// How far corners were moved \[m\].
    moved: f64,
}

impl OnEdges<'_> {
    /// Puts the load on blocks; tells whether it acts. Parts of edges that make joints are not free and carry no load, so
    /// that a load cannot act inside a joint.
    fn place(&self, blocks: &mut [PlacedBlock], joined: &[Vec<Vec<EdgePart>>]) -> bool {
        let mut acts = false;
        for (block, joined) in blocks.iter_mut().zip(joined) {
            for (edge, joined) in joined.iter().enumerate() {
                let covered = covered_part(&block.corners, edge, self.ends, self.moved);
                let traction = self.traction(&block.corners, edge);
                for [from, to] in covered.into_iter().flat_map(|it| free_parts(it, joined)) {
                    block.loads.push(EdgeLoad { edge, from, to, traction, load: self.id }.into());
                    acts = true;
                }
            }
        }
        acts
    }

    /// Traction on the block \[Pa\].
    fn traction(&self, corners: &[Point2<f64>], edge: usize) -> Vector2<f64> {
        let in_scene = match self.stress {
            EdgeStress::Traction(traction) => Vector2::from(traction),
            EdgeStress::Pressure(pressure) => -geometry::outward_normal(corners, edge) * pressure,
        };
        in_scene * self.units.stress_to_si() * self.load.factor
    }
}

/// The part of an edge that lies on a segment; `None` when they share no length.
fn covered_part(
    corners: &[Point2<f64>],
    edge: usize,
    [from, to]: [Point2<f64>; 2],
    moved: f64,
) -> Option<EdgePart> {
    let [start, end] = geometry::edge(corners, edge);
    let length = (end - start).norm();
    let slack = SAME_PLACE * geometry::size(corners) + moved;
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
    // The segment must lie on the edge only beside it: far away it may be off by rounding.
    let distance = |s: f64| (from + (to - from) * ((s - a) / (b - a)) - start).dot(&normal);
    if distance(low).abs() > slack || distance(high).abs() > slack {
        return None;
    }
    Some([low, high].map(|s| geometry::snap(s / length)))
}

/// The parts of `covered` without the joined parts.
fn free_parts(covered: EdgePart, joined: &[EdgePart]) -> Vec<EdgePart> {
    let mut free = vec![covered];
    for [from, to] in joined {
        free = free
            .into_iter()
            .flat_map(|[a, b]| [[a, b.min(*from)], [a.max(*to), b]])
            .filter(|[a, b]| b - a > SAME_PLACE)
            .collect();
    }
    free
}

/// The parts of every edge of every block that make joints.
fn joined_parts(
    blocks: &[PlacedBlock],
    joints: &[PlacedJoint],
    contacts: &[JointPoint],
) -> Vec<Vec<Vec<EdgePart>>> {
    let mut joined: Vec<_> =
        blocks.iter().map(|block| vec![Vec::new(); block.corners.len()]).collect();
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
fn projected(corners: &[Point2<f64>], edge: usize, joint: &PlacedJoint) -> EdgePart {
    let [start, end] = geometry::edge(corners, edge);
    let along = (end - start) / (end - start).norm_squared();
    let [a, b] = [joint.from, joint.to].map(|p| geometry::snap((p - start).dot(&along)));
    [a.min(b), a.max(b)]
}
