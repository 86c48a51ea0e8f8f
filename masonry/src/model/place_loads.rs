//! Application of the loads of a scene to its blocks: on edges along a segment, at places in a block, and on all mass.

mod edges;

use std::collections::BTreeMap;

use nalgebra::{Point2, Vector2};

use self::edges::{EdgePart, OnEdges, joined_parts};
use super::place_fills::{self, PlacedAxle, Top};
use super::{Acceleration, JointPoint, LoadCase, PlacedBlock, PlacedJoint, PointLoad};
use crate::geometry::{self, SAME_PLACE};
use crate::ids::LoadId;
use crate::rounding::rounded;
use crate::scene::{Fault, KeyPath, LoadError, LoadKind, Scene, SceneErrorKind};
use crate::units::Units;

/// Number of similar names that a message shows if a name does not exist.
const NAMES: usize = 3;

/// Applies the loads of a scene to its blocks, whose corners were moved by up to a distance \[m\]. Returns the names
/// and factors of the loads, and the loads that act on all mass.
pub(super) fn place(
    scene: &Scene,
    blocks: &mut [PlacedBlock],
    joints: &[PlacedJoint],
    contacts: &[JointPoint],
    moved: f64,
) -> Result<(Vec<LoadCase>, Vec<Acceleration>), Fault> {
    let joined = joined_parts(blocks, joints, contacts);
    let unit = scene.units.length_to_si();
    let thickness = scene.thickness.unwrap_or(1.0) * unit;
    let places: BTreeMap<String, usize> =
        blocks.iter().enumerate().map(|(k, block)| (block.name.clone(), k)).collect();
    let (mut loads, mut accelerations) = (Vec::new(), Vec::new());
    for (k, load) in scene.loads.iter().enumerate() {
        let (at, id) = (KeyPath::of("loads").item(k), LoadId::new(k));
        match load.kind() {
            Some(LoadKind::Edge { from, to, stress, inside }) => {
                let ends = [from, to].map(|end| scene.units.point(end));
                let on_edge = OnEdges { load, id, ends, stress, inside, units: scene.units, moved };
                if !on_edge.place(blocks, &joined) {
                    let name = load.name.clone();
                    return Err(if inside {
                        Fault::new(at, LoadError::IdleInside(name))
                    } else {
                        Fault::new(at, SceneErrorKind::IdleLoad(name))
                    });
                }
            }
            Some(
                LoadKind::Force { block, at: place, .. }
                | LoadKind::Moment { block, at: place, .. },
            ) => {
                let Some(k) = places.get(block) else {
                    return Err(Fault::new(at.key("block"), unknown(blocks, block)));
                };
                let block = &mut blocks[*k];
                let at = place_in(block, scene.units.point(place), scene.units, moved)
                    .map_err(|error| Fault::new(at.key("at"), error))?;
                let in_newtons = scene.units.force_to_si() * load.factor;
                let force = Vector2::from(load.force.unwrap_or_default()) * in_newtons;
                let moment = load.moment.unwrap_or(0.0) * in_newtons * scene.units.length_to_si();
                block.loads.push(PointLoad { at, force, moment, load: id }.into());
            }
            Some(LoadKind::Acceleration(value)) => {
                let value = Vector2::from(value) * load.factor;
                accelerations.push(Acceleration { value, load: id });
            }
            Some(LoadKind::Fill(fill)) => {
                let tops = tops(blocks, &fill.over, &joined);
                let columns = place_fills::columns(&tops, fill.level * unit);
                if columns.is_empty() {
                    let (load, over) = (load.name.clone(), fill.over.clone());
                    return Err(Fault::new(at, LoadError::IdleFill { load, over }));
                }
                let gamma = fill.gamma * scene.units.stress_to_si() / unit;
                let weight = gamma * thickness * load.factor;
                for it in &columns {
                    it.press(blocks, weight, thickness, id);
                }
            }
            // An axle may be off the bridge.
            Some(LoadKind::Axle(axle)) => {
                let tops = tops(blocks, &axle.over, &joined);
                let slope = axle.angle_deg.to_radians().tan();
                let level = axle.level.map(|level| level * unit);
                let placed = PlacedAxle { x: axle.x * unit, level, slope };
                let force = axle.force * scene.units.force_to_si() * load.factor;
                for it in placed.shares(&tops) {
                    it.press(blocks, force, thickness, id);
                }
            }
            // A load without a kind was refused before.
            None => {}
        }
        let (name, group) = (load.name.clone(), load.group_name().to_owned());
        // The thrust of earth is not a weight.
        let mass = load.mass.or_else(|| load.earth.map(|_| 0.0));
        loads.push(LoadCase { name, group, factor: load.factor, mass });
    }
    accelerate(scene, blocks, &loads, &accelerations)?;
    Ok((loads, accelerations))
}

/// Returns the free edges of a body that face upwards.
fn tops(blocks: &[PlacedBlock], over: &str, joined: &[Vec<Vec<EdgePart>>]) -> Vec<Top> {
    place_fills::tops(blocks, over, |block, edge| {
        geometry::without([0.0, 1.0], &joined[block][edge])
    })
}

/// Adds the forces of accelerations on the masses whose weights are loads, at the places of these loads.
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
            if load.acts_against(gravity) {
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

/// Returns the error that no block has this name, with the most similar names.
fn unknown(blocks: &[PlacedBlock], name: &str) -> LoadError {
    let mut near: Vec<&str> = blocks.iter().map(|block| block.name.as_str()).collect();
    // The sort keeps the order of the scene among names that are equally near.
    near.sort_by_cached_key(|other| strsim::levenshtein(name, other));
    near.truncate(NAMES);
    let near = near.into_iter().map(str::to_owned).collect();
    LoadError::NoBlock { name: name.to_owned(), near }
}

/// Returns a place on a block. A place that is outside of the block only by rounding is moved to the edge.
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
