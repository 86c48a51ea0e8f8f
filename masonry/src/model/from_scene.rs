//! From a scene to a model: conversion to SI units, meshes, joints.

use nalgebra::{Point2, Vector2};

use super::{
    Block, Body, ContactPoint, Elasticity, Joint, JointClass, Model, Mortar, Movement, Plane,
    Support, place_loads, placement,
};
use crate::geometry::{self, QuadError};
use crate::law::JointLaw;
use crate::model::joints::{self, ContactError, JointKind, Options};
use crate::model::mesh::BlockMesh;
use crate::paper::film::FilmMaterial;
use crate::scene::bond::{self, JointThickness};
use crate::scene::{self, BED, Fault, HEAD, KeyPath, Scene, SceneError, SceneErrorKind};
use crate::units::Units;

impl Model {
    /// The model of a scene: blocks laid and meshed, joints found, all in SI units.
    ///
    /// Blocks come wall by wall, course by course, then the single blocks, in the order of the
    /// scene. Only blocks of elastic materials are meshed.
    ///
    /// # Errors
    /// What [`Scene::check`] finds, and what only the whole shows: overlapping blocks, a support
    /// that runs through a block or meets none, a load on no free edge or outside of its block, a block that meets nothing,
    /// a joint whose class is not given. With line and column when the scene was read from text.
    pub fn from_scene(scene: &Scene) -> Result<Self, SceneError> {
        scene.check()?;
        build(scene).map_err(|fault| fault.locate(scene))
    }
}

fn build(scene: &Scene) -> Result<Model, Fault> {
    let units = scene.units;
    let thickness = scene.thickness.unwrap_or(1.0) * units.length_to_si();
    let (mut blocks, keys) = lay_blocks(scene)?;
    let supports: Vec<Support> = scene.supports.iter().map(|s| support(s, units)).collect();
    placement::check_overlaps(&blocks, &keys, units)?;
    placement::check_supports(&blocks, &supports, units)?;
    placement::check_movements(scene, &blocks)?;

    let found = find_joints(scene, &blocks, &supports, thickness)?;
    placement::check_touching(&blocks, &keys, &supports, &found.joints)?;
    let (loads, accelerations) =
        place_loads::place(scene, &mut blocks, &found.joints, &found.contacts)?;

    Ok(Model {
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
        units,
    })
}

/// All blocks, and for each the key of the scene that describes it.
fn lay_blocks(scene: &Scene) -> Result<(Vec<Block>, Vec<KeyPath>), Fault> {
    let mut blocks = Vec::new();
    let mut keys = Vec::new();
    for (k, wall) in scene.walls.iter().enumerate() {
        for brick in bond::bricks_in_mortar(wall, JointThickness::of(scene)) {
            let mesh = wall.mesh.map(|whole| brick.mesh(whole));
            blocks.push(block(scene, brick.name(wall), &wall.material, brick.corners(), mesh));
            keys.push(KeyPath::of("walls").item(k).key("courses"));
        }
    }
    for (k, single) in scene.blocks.iter().enumerate() {
        let mesh = single.mesh.map(|counts| counts.map(|n| n as usize));
        blocks.push(block(scene, single.name.clone(), &single.material, single.corners, mesh));
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
    corners: [[f64; 2]; 4],
    mesh: Option<[usize; 2]>,
) -> Block {
    let units = scene.units;
    let corners = corners.map(|corner| point(corner, units));
    let material = scene.materials.get(material).copied().unwrap_or_default();
    let elasticity = elasticity(&material, units);
    let mesh = mesh.filter(|_| elasticity.is_some());
    Block {
        name,
        corners,
        elasticity,
        density: material.density,
        mesh: mesh.map(|[nx, ny]| BlockMesh::new(&corners, nx, ny)),
        loads: Vec::new(),
    }
}

fn elasticity(material: &scene::Material, units: Units) -> Option<Elasticity> {
    let constants = material.young.zip(material.poisson);
    constants.map(|(young, poisson)| Elasticity { young: young * units.stress_to_si(), poisson })
}

/// A brick cut to next to nothing is no block.
fn check_shapes(blocks: &[Block], keys: &[KeyPath]) -> Result<(), Fault> {
    for (block, key) in blocks.iter().zip(keys) {
        geometry::check_convex(&block.corners).map_err(|error| {
            let corner = if let QuadError::NotConvex { corner } = error { corner + 1 } else { 1 };
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
struct Found {
    joints: Vec<Joint>,
    contacts: Vec<ContactPoint>,
    classes: Vec<JointClass>,
}

fn find_joints(
    scene: &Scene,
    blocks: &[Block],
    supports: &[Support],
    thickness: f64,
) -> Result<Found, Fault> {
    let mut classes: Vec<JointClass> =
        scene.joints.iter().map(|joint| joint_class(scene, joint)).collect();
    let given = classes.len();
    // A class that is not given stands at the end, to be refused when a joint turns out to need it.
    let mut index = |name: &str| {
        classes.iter().position(|class| class.name == name).unwrap_or_else(|| {
            classes.push(JointClass {
                name: name.to_owned(),
                law: JointLaw::default(),
                mortar: None,
            });
            classes.len() - 1
        })
    };
    let (bed, head) = (index(BED), index(HEAD));
    let of_supports: Vec<usize> = scene.supports.iter().map(|s| index(&s.joint)).collect();
    let class_of = |kind| match kind {
        JointKind::Bed => bed,
        JointKind::Head => head,
        JointKind::Support(id) => of_supports[id.index()],
    };
    let options = Options {
        points: scene.contact.points,
        gap_limit: scene.contact.gap_limit * scene.units.length_to_si(),
        films: scene.contact.films,
        ..Options::default()
    };
    let (joints, contacts) = joints::find(
        blocks, supports, &classes, class_of, thickness, &options,
    )
    .map_err(|error| {
        let key = match &error {
            ContactError::NoRoomForFilm { class, .. } => {
                KeyPath::of("joints").key(class).key("thickness")
            }
            ContactError::NoNodalPair { .. } => KeyPath::of("contact").key("points"),
        };
        Fault::new(key, SceneErrorKind::Contact(error))
    })?;
    if let Some(joint) = joints.iter().find(|joint| joint.class >= given) {
        return Err(missing_class(blocks, joint, joint.class == bed));
    }
    classes.truncate(given);
    Ok(Found { joints, contacts, classes })
}

fn joint_class(scene: &Scene, (name, joint): (&String, &scene::Joint)) -> JointClass {
    let strength = |value: Option<f64>| value.unwrap_or(0.0) * scene.units.stress_to_si();
    let law = JointLaw {
        mu: joint.friction(),
        cohesion: strength(joint.cohesion),
        tension: strength(joint.tension),
    };
    JointClass { name: name.clone(), law, mortar: mortar(scene, joint) }
}

fn mortar(scene: &Scene, joint: &scene::Joint) -> Option<Mortar> {
    let thickness = joint.mortar_thickness() * scene.units.length_to_si();
    let material = scene.materials.get(joint.material.as_ref()?)?;
    let elasticity = elasticity(material, scene.units)?;
    // The plane is given wherever a material is elastic.
    let material = FilmMaterial { elasticity, plane: scene.plane.unwrap_or(Plane::Stress) };
    (thickness > 0.0).then_some(Mortar { thickness, material })
}

fn missing_class(blocks: &[Block], joint: &Joint, is_bed: bool) -> Fault {
    let name = |body| match body {
        Body::Block(id) => blocks[id.index()].name.clone(),
        // Supports have classes of their own, which were looked up before.
        Body::Support(_) => String::new(),
    };
    let class = if is_bed { BED } else { HEAD };
    let (first, second) = (name(joint.a), name(Body::Block(joint.b)));
    Fault::new(KeyPath::of("joints"), SceneErrorKind::MissingClass { class, first, second })
}
