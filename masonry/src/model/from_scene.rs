//! From a scene to a model: conversion to SI units, meshes, joints.

use nalgebra::{Point2, Vector2};

use super::classes::Classes;
use super::{
    Block, ContactPoint, Joint, JointClass, Model, Movement, Plane, Support, heal, place_loads,
    placement,
};
use crate::geometry::{self, PolygonError};
use crate::model::joints::{self, ContactError, Options};
use crate::model::mesh::BlockMesh;
use crate::scene::bond::{self, JointThickness};
use crate::scene::{self, Fault, KeyPath, Scene, SceneError, SceneErrorKind};
use crate::units::Units;

impl Model {
    /// The model of a scene: blocks laid and meshed, joints found, all in SI units.
    ///
    /// Blocks come wall by wall, course by course, then arch by arch, then the single blocks, in the order of the
    /// scene. Only blocks of elastic materials are meshed.
    ///
    /// # Errors
    /// The mistakes that [`Scene::check`] finds, and those of the whole: overlapping blocks, a support that runs
    /// through a block or meets none, a load on no free edge or outside of its block, a block that meets nothing, a
    /// joint whose class is not given. Each has its line and column if the scene was read from text.
    pub fn from_scene(scene: &Scene) -> Result<Self, SceneError> {
        scene.check()?;
        build(scene).map_err(|fault| fault.locate(scene))
    }
}

impl Model {
    /// Whether there are several steps, and friction makes the last state depend on those before it.
    pub(crate) fn depends_on_way(&self, scene: &Scene) -> bool {
        scene.steps() > 1 && self.contacts.iter().any(|point| point.law.resists_sliding())
    }
}

fn build(scene: &Scene) -> Result<Model, Fault> {
    let units = scene.units;
    let thickness = scene.thickness.unwrap_or(1.0) * units.length_to_si();
    let (mut blocks, keys) = lay_blocks(scene)?;
    let supports: Vec<Support> = scene.all_supports().iter().map(|s| support(s, units)).collect();
    let overlaps = placement::check_overlaps(&blocks, &keys, units);
    let healed = match scene.contact.tolerance {
        None if overlaps.is_ok() => None,
        tolerance => {
            let metres = tolerance.map(|it| it * units.length_to_si());
            match (heal::heal(&mut blocks, scene.blocks.len(), &supports, metres), tolerance) {
                (Ok(healed), _) => healed,
                // Only the overlap is known that was to be healed.
                (Err(_), None) => None,
                (Err(wanted), Some(value)) => {
                    let at = KeyPath::of("contact").key("tolerance");
                    return Err(Fault::new(at, SceneErrorKind::Value { value, wanted }));
                }
            }
        }
    };
    // Loads are where the corners were.
    let moved = healed.map_or(0.0, |it| it.largest);
    if healed.is_some() {
        for block in &mut blocks {
            let meshed = block.mesh.as_ref().zip(block.quad());
            block.mesh = meshed.map(|(mesh, quad)| BlockMesh::new(&quad, mesh.nx, mesh.ny));
        }
        check_shapes(&blocks, &keys)?;
        placement::check_overlaps(&blocks, &keys, units)?;
    } else {
        overlaps?;
    }
    placement::check_supports(&blocks, &supports, units)?;
    placement::check_movements(scene, &blocks)?;

    let found = find_joints(scene, &blocks, &supports, thickness)?;
    placement::check_touching(&blocks, &keys, &supports, &found.joints)?;
    let (loads, accelerations) =
        place_loads::place(scene, &mut blocks, &found.joints, &found.contacts, moved)?;

    let mut model = Model {
        blocks,
        supports,
        joints: found.joints,
        contacts: found.contacts,
        joint_classes: found.classes,
        // Without an elastic material the scene may leave it out, and nothing depends on it.
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

/// All blocks, and for each the key of the scene that describes it.
fn lay_blocks(scene: &Scene) -> Result<(Vec<Block>, Vec<KeyPath>), Fault> {
    let mut blocks = Vec::new();
    let mut keys = Vec::new();
    for (k, wall) in scene.walls.iter().enumerate() {
        for brick in bond::bricks_in_mortar(wall, JointThickness::of(scene, wall)) {
            let mesh = wall.mesh.map(|whole| brick.mesh(whole));
            blocks.push(block(scene, brick.name(wall), &wall.material, &brick.corners(), mesh));
            keys.push(KeyPath::of("walls").item(k).key("courses"));
        }
    }
    for (k, arch) in scene.arches.iter().enumerate() {
        let at = KeyPath::of("arches").item(k);
        let mesh = arch.mesh.map(|counts| counts.map(|n| n as usize));
        for (name, corners) in scene::arch::blocks(arch, &at)? {
            blocks.push(block(scene, name, &arch.material, &corners, mesh));
            keys.push(at.clone());
        }
    }
    for (k, single) in scene.blocks.iter().enumerate() {
        let mesh = single.mesh.map(|counts| counts.map(|n| n as usize));
        blocks.push(block(scene, single.name.clone(), &single.material, &single.corners, mesh));
        keys.push(KeyPath::of("blocks").item(k).key("corners"));
    }
    check_shapes(&blocks, &keys)?;
    placement::check_names(&blocks, &keys)?;
    Ok((blocks, keys))
}

fn block(
    scene: &Scene,
    name: String,
    material: &str,
    corners: &[[f64; 2]],
    mesh: Option<[usize; 2]>,
) -> Block {
    let units = scene.units;
    let corners: Vec<_> = corners.iter().map(|corner| point(*corner, units)).collect();
    let material = scene.materials.get(material).copied().unwrap_or_default();
    let elasticity = material.elasticity(units);
    let mesh = mesh.filter(|_| elasticity.is_some());
    let density = material.density;
    let mut block = Block { name, corners, elasticity, density, mesh: None, loads: Vec::new() };
    block.mesh = mesh.zip(block.quad()).map(|([nx, ny], quad)| BlockMesh::new(&quad, nx, ny));
    block
}

/// A brick cut to next to nothing is no block.
fn check_shapes(blocks: &[Block], keys: &[KeyPath]) -> Result<(), Fault> {
    for (block, key) in blocks.iter().zip(keys) {
        geometry::check_convex(&block.corners).map_err(|error| {
            let corner =
                if let PolygonError::NotConvex { corner } = error { corner + 1 } else { 1 };
            let kind = SceneErrorKind::NotConvex { block: block.name.clone(), corner };
            Fault::new(key.clone(), kind)
        })?;
    }
    Ok(())
}

fn support(support: &scene::Support, units: Units) -> Support {
    Support {
        name: support.name.clone(),
        from: point(support.from, units),
        to: point(support.to, units),
        movement: Movement::default(),
    }
}

fn point([x, y]: [f64; 2], units: Units) -> Point2<f64> {
    Point2::new(x, y) * units.length_to_si()
}

/// Joints, their contact points and the classes that they refer to.
struct Meetings {
    joints: Vec<Joint>,
    contacts: Vec<ContactPoint>,
    classes: Vec<JointClass>,
}

fn find_joints(
    scene: &Scene,
    blocks: &[Block],
    supports: &[Support],
    thickness: f64,
) -> Result<Meetings, Fault> {
    let classes = Classes::of(scene, blocks)?;
    let class_of = |kind, a, b| classes.class_of(kind, a, b);
    let options = Options {
        points: scene.contact.points,
        gap_limit: scene.contact.gap_limit * scene.units.length_to_si(),
        films: scene.contact.films,
        ..Options::default()
    };
    let (joints, contacts) =
        joints::find(blocks, supports, classes.list(), class_of, thickness, &options).map_err(
            |error| {
                let key = match &error {
                    ContactError::NoRoomForFilm { class, .. } => {
                        KeyPath::of("joints").key(class).key("thickness")
                    }
                    ContactError::NoNodalPair { .. } => KeyPath::of("contact").key("points"),
                };
                Fault::new(key, SceneErrorKind::Contact(error))
            },
        )?;
    let classes = classes.of_joints(blocks, &joints)?;
    Ok(Meetings { joints, contacts, classes })
}
