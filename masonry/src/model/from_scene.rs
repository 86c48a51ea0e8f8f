//! Conversion of a scene to a model: SI units, meshes, joints.

use nalgebra::Vector2;

use super::classes::{BlockPlace, Classes};
use super::{
    Healed, JointClass, JointPoint, Model, Movement, PlacedBlock, PlacedJoint, PlacedSupport,
    Plane, heal, place_loads, placement,
};
use crate::geometry::{self, PolygonError};
use crate::model::joints::{self, ContactError, JointSearch};
use crate::model::mesh::BlockMesh;
use crate::scene::arch::NamedBlock;
use crate::scene::bond::{self, JointThickness};
use crate::scene::{self, Fault, KeyPath, Scene, SceneError, SceneErrorKind};
use crate::units::Units;

impl Model {
    /// Builds the model of a scene in SI units: lays and meshes the blocks, and finds the joints.
    ///
    /// Blocks come wall by wall, course by course, then arch by arch, then the single blocks, in the order of the
    /// scene. Only blocks of elastic materials are meshed.
    ///
    /// # Errors
    /// For the mistakes that [`Scene::check`] finds, and for mistakes of the whole structure: overlapping
    /// blocks; a support that runs through a block, lies on another support or meets no block; a load on no free edge
    /// or outside of its block; a block that meets nothing; a joint whose class is not given. Each error has its line
    /// and column if the scene was read from text.
    pub fn from_scene(scene: &Scene) -> Result<Self, SceneError> {
        scene.check()?;
        build(scene).map_err(|fault| fault.locate(scene))
    }

    /// Returns whether the last state depends on the earlier ones: there are several steps, and joints with friction.
    pub(crate) fn depends_on_way(&self, scene: &Scene) -> bool {
        scene.steps() > 1 && self.contacts.iter().any(|point| point.law.resists_sliding())
    }
}

fn build(scene: &Scene) -> Result<Model, Fault> {
    let units = scene.units;
    let thickness = scene.thickness.unwrap_or(1.0) * units.length_to_si();
    let Laid { mut blocks, keys, places } = lay_blocks(scene)?;
    let supports: Vec<PlacedSupport> =
        scene.all_supports().iter().map(|s| support(s, units)).collect();
    let mut healed = heal_corners(scene, &mut blocks, &keys, &supports)?;
    placement::check_supports(&blocks, &supports, units)?;
    placement::check_movements(scene, &blocks)?;

    let classes = Classes::of(scene, &blocks, places)?;
    let found = find_joints(scene, &blocks, &supports, classes, thickness)?;
    placement::check_touching(&blocks, &keys, &supports, &found.joints)?;
    placement::check_overlapping_supports(&blocks, &supports, &found.joints, units)?;
    // The places of loads in the scene refer to the corners before they were moved.
    let moved = healed.as_ref().map_or(0.0, |it| it.largest);
    let drawing = scene.changes_of_drawing();
    if !drawing.is_empty() {
        healed.get_or_insert_default().drawing = drawing;
    }
    let (loads, accelerations) =
        place_loads::place(scene, &mut blocks, &found.joints, &found.contacts, moved)?;

    let mut model = Model {
        blocks,
        supports,
        joints: found.joints,
        contacts: found.contacts,
        joint_classes: found.classes,
        // A scene without an elastic material may omit the plane; in this case no result depends on it.
        plane: scene.plane.unwrap_or(Plane::Stress),
        thickness,
        gravity: scene.gravity.map_or_else(Vector2::zeros, Vector2::from),
        accelerations,
        loads,
        healed,
        units,
    };
    if model.depends_on_way(scene) {
        model.give_stiffness_to_dry_joints();
    }
    Ok(model)
}

/// Moves corners of single blocks onto the corners and edges that they miss by rounding, if a tolerance is given or if
/// blocks overlap.
fn heal_corners(
    scene: &Scene,
    blocks: &mut [PlacedBlock],
    keys: &[KeyPath],
    supports: &[PlacedSupport],
) -> Result<Option<Healed>, Fault> {
    let overlaps = placement::check_overlaps(blocks, keys, scene.units);
    let given = scene.contact.tolerance;
    if given.is_none() && overlaps.is_ok() {
        return Ok(None);
    }
    let tolerance = given.map(|it| it * scene.units.length_to_si());
    let healed = match (heal::heal(blocks, scene.blocks.len(), supports, tolerance), given) {
        (Ok(Some(healed)), _) => healed,
        // The overlap that was to be healed is the only error.
        (Ok(None), _) | (Err(_), None) => return overlaps.map(|()| None),
        (Err(wanted), Some(value)) => {
            let at = KeyPath::of("contact").key("tolerance");
            return Err(Fault::new(at, SceneErrorKind::Value { value, wanted }));
        }
    };
    check_shapes(blocks, keys)?;
    for (block, key) in blocks.iter_mut().zip(keys) {
        let Some(mesh) = &block.mesh else { continue };
        let divisions = mesh.divisions();
        block.corners = geometry::without_straight(&block.corners);
        let meshed = BlockMesh::of(&block.corners, divisions);
        let kind = || match geometry::edge_behind_centroid(&block.corners) {
            Some(edge) => SceneErrorKind::NoMesh { block: block.name.clone(), edge },
            None => SceneErrorKind::UnevenMesh {
                block: block.name.clone(),
                mesh: divisions.map(|it| u32::try_from(it).unwrap_or(u32::MAX)),
            },
        };
        block.mesh = Some(meshed.ok_or_else(|| Fault::new(key.clone(), kind()))?);
    }
    placement::check_overlaps(blocks, keys, scene.units)?;
    Ok(Some(healed))
}

/// The blocks of a scene after they were laid, each with its key and its place in a wall or an arch.
struct Laid {
    blocks: Vec<PlacedBlock>,
    /// The key of the scene that describes each block.
    keys: Vec<KeyPath>,
    /// The place of every brick and voussoir in its wall or arch; single blocks come after bricks and voussoirs.
    places: Vec<BlockPlace>,
}

fn lay_blocks(scene: &Scene) -> Result<Laid, Fault> {
    let (mut blocks, mut keys, mut places) = (Vec::new(), Vec::new(), Vec::new());
    let counts = |mesh: Option<[u32; 2]>| mesh.map(|counts| counts.map(|n| n as usize));
    for (k, wall) in scene.walls.iter().enumerate() {
        for brick in bond::bricks_in_mortar(wall, JointThickness::of(scene, wall)) {
            let mesh = wall.mesh.map(|whole| brick.mesh(whole));
            let corners = brick.corners().map(|corner| wall.turned(corner));
            let lintel = brick.lintel.and_then(|opening| wall.openings[opening].lintel.as_ref());
            let material = lintel.and_then(|it| it.material.as_ref()).unwrap_or(&wall.material);
            blocks.push(block(scene, brick.name(wall), material, &corners, mesh));
            keys.push(KeyPath::of("walls").item(k).key("courses"));
            places.push(BlockPlace { wall: k, ring: None, lintel: brick.lintel });
        }
        for (index, opening) in wall.openings.iter().enumerate() {
            let at = KeyPath::of("walls").item(k).key("openings").item(index).key("lintel");
            let material = opening.lintel.as_ref().and_then(|it| it.material.as_ref());
            let voussoirs = bond::voussoirs(wall, opening, &at)?;
            for (number, corners) in voussoirs.iter().enumerate() {
                let name = format!("{}/lintel/{}/{}", wall.name, index + 1, number + 1);
                let material = material.unwrap_or(&wall.material);
                blocks.push(block(scene, name, material, corners, counts(wall.mesh)));
                keys.push(at.clone());
                places.push(BlockPlace { wall: k, ring: None, lintel: Some(index) });
            }
        }
    }
    for (k, arch) in scene.arches.iter().enumerate() {
        let at = KeyPath::of("arches").item(k);
        for NamedBlock { name, corners, ring } in scene::arch::blocks(arch, &at)? {
            blocks.push(block(scene, name, &arch.material, &corners, counts(arch.mesh)));
            keys.push(at.clone());
            places.push(BlockPlace { wall: scene.walls.len() + k, ring, lintel: None });
        }
    }
    for (k, it) in scene.blocks.iter().enumerate() {
        blocks.push(block(scene, it.name.clone(), &it.material, &it.corners, counts(it.mesh)));
        keys.push(KeyPath::of("blocks").item(k).key("corners"));
    }
    check_shapes(&blocks, &keys)?;
    placement::check_names(&blocks, &keys)?;
    Ok(Laid { blocks, keys, places })
}

fn block(
    scene: &Scene,
    name: String,
    material: &str,
    corners: &[[f64; 2]],
    mesh: Option<[usize; 2]>,
) -> PlacedBlock {
    let units = scene.units;
    let corners: Vec<_> = corners.iter().map(|corner| units.point(*corner)).collect();
    let material = scene.materials.get(material).copied().unwrap_or_default();
    let elasticity = material.elasticity(units);
    let mesh = mesh.filter(|_| elasticity.is_some());
    // Contact needs no corner on a straight edge, and patches of a mesh are better without such corners.
    let corners = if mesh.is_some() { geometry::without_straight(&corners) } else { corners };
    let mesh = mesh.and_then(|divisions| BlockMesh::of(&corners, divisions));
    let density = material.density;
    PlacedBlock { name, corners, elasticity, density, mesh, loads: Vec::new() }
}

/// Refuses bricks that are cut to almost nothing, and blocks that lost their shape because their corners were moved
/// too far.
fn check_shapes(blocks: &[PlacedBlock], keys: &[KeyPath]) -> Result<(), Fault> {
    for (block, key) in blocks.iter().zip(keys) {
        let name = || block.name.clone();
        let kind = match geometry::check_simple(&block.corners) {
            Ok(()) => continue,
            Err(PolygonError::Crossing) => SceneErrorKind::CrossingEdges(name()),
            Err(PolygonError::NoWidth(corner)) => {
                SceneErrorKind::NoWidth { block: name(), corner: corner + 1 }
            }
            Err(_) => SceneErrorKind::NoWidth { block: name(), corner: 1 },
        };
        return Err(Fault::new(key.clone(), kind));
    }
    Ok(())
}

fn support(support: &scene::Support, units: Units) -> PlacedSupport {
    PlacedSupport {
        name: support.name.clone(),
        from: units.point(support.from),
        to: units.point(support.to),
        movement: Movement::default(),
    }
}

/// The joints of a model, their contact points and the classes to which they refer.
struct Meetings {
    joints: Vec<PlacedJoint>,
    contacts: Vec<JointPoint>,
    classes: Vec<JointClass>,
}

fn find_joints(
    scene: &Scene,
    blocks: &[PlacedBlock],
    supports: &[PlacedSupport],
    classes: Classes,
    thickness: f64,
) -> Result<Meetings, Fault> {
    let class_of = |kind, a, b| classes.class_of(kind, a, b);
    let options = JointSearch {
        points: scene.contact.points,
        gap_limit: scene.contact.gap_limit * scene.units.length_to_si(),
        films: scene.contact.films,
    };
    let found = joints::find(blocks, supports, classes.list(), class_of, thickness, &options);
    let (joints, contacts) = found.map_err(|error| {
        let key = match &error {
            ContactError::NoRoomForFilm { class, .. } => {
                KeyPath::of("joints").key(class).key("thickness")
            }
            ContactError::NoNodalPair { .. } => KeyPath::of("contact").key("points"),
        };
        Fault::new(key, error)
    })?;
    let classes = classes.of_joints(blocks, &joints)?;
    Ok(Meetings { joints, contacts, classes })
}
