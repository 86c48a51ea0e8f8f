//! The choice of the class of each joint: that of a support, of a wall, of a pair of blocks, or `bed` and `head`.

use nalgebra::Rotation2;

use super::joints::{JointKind, is_bed};
use super::{Body, JointClass, Mortar, PlacedBlock, PlacedJoint, Plane};
use crate::ids::BlockId;
use crate::law::JointLaw;
use crate::material::FilmMaterial;
use crate::scene::rules::unknown;
use crate::scene::{self, BED, Fault, HEAD, KeyPath, Opening, Scene, SceneErrorKind, Wall};

/// The classes of a scene, and the data that decide which class a joint gets.
pub(super) struct Classes {
    /// The classes of the scene, followed by classes that are named but not given. The latter are refused if a joint
    /// needs them.
    list: Vec<JointClass>,
    given: usize,
    /// Indices of the classes `bed` and `head`.
    usual: [usize; 2],
    /// Indices of the bed and head classes of the walls, followed by those of the arches.
    of_walls: Vec<[usize; 2]>,
    /// Angles \[rad\] by which the walls, and so their bed and head joints, are turned.
    turns: Vec<f64>,
    of_supports: Vec<usize>,
    of_pairs: Vec<([Members; 2], usize)>,
    /// Indices of the classes between the rings of the arches.
    of_rings: Vec<Option<usize>>,
    /// Indices of the classes of the lintels above the openings of the walls.
    of_lintels: Vec<Vec<Option<usize>>>,
    /// The wall or arch, ring and lintel of every brick and voussoir.
    places: Vec<BlockPlace>,
}

/// The wall or arch to which a block belongs, and its ring or lintel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct BlockPlace {
    /// The index of the wall, or of the arch; arches are counted after the walls.
    pub(super) wall: usize,
    /// The ring of a voussoir, from the intrados.
    pub(super) ring: Option<u32>,
    /// The index of the opening above which the block is the lintel.
    pub(super) lintel: Option<usize>,
}

/// The blocks that a name in `between` refers to: those of a wall, or a single block.
enum Members {
    Wall(usize),
    Block(BlockId),
}

impl Classes {
    pub(super) fn of(
        scene: &Scene,
        blocks: &[PlacedBlock],
        places: Vec<BlockPlace>,
    ) -> Result<Self, Fault> {
        let mut list: Vec<JointClass> =
            scene.joints.iter().map(|(name, joint)| joint_class(scene, name, joint)).collect();
        let given = list.len();
        let mut index = |name: &str| {
            list.iter().position(|class| class.name == name).unwrap_or_else(|| {
                let law = JointLaw::default();
                list.push(JointClass { name: name.to_owned(), law, points: None, mortar: None });
                list.len() - 1
            })
        };
        let usual = [BED, HEAD].map(&mut index);
        let of_walls = scene.walls.iter().map(|wall| wall.joints.names());
        let of_arches = scene.arches.iter().map(|arch| arch.joint.as_deref());
        let of_arches = of_arches.map(|joint| joint.map_or([BED, HEAD], |joint| [joint; 2]));
        let of_walls = of_walls.chain(of_arches).map(|names| names.map(&mut index)).collect();
        let of_rings = scene.arches.iter().map(|arch| arch.ring_joint.as_deref().map(&mut index));
        let of_rings = of_rings.collect();
        let mut of_lintels = Vec::new();
        for wall in &scene.walls {
            let classes = wall.openings.iter().map(Opening::lintel_joint);
            of_lintels.push(classes.map(|class| class.map(&mut index)).collect());
        }
        let of_supports =
            scene.all_supports().iter().map(|support| index(&support.joint)).collect();
        let mut of_pairs = Vec::new();
        for (k, between) in scene.between.iter().enumerate() {
            let at = KeyPath::of("between").item(k).key("blocks");
            let [first, second] = &between.blocks;
            let first = Members::of(scene, blocks, first, at.item(0))?;
            let second = Members::of(scene, blocks, second, at.item(1))?;
            of_pairs.push(([first, second], index(&between.joint)));
        }
        let turns = scene.walls.iter().map(Wall::turn).collect();
        Ok(Self {
            list,
            given,
            usual,
            of_walls,
            turns,
            of_supports,
            of_pairs,
            of_rings,
            of_lintels,
            places,
        })
    }

    pub(super) fn list(&self) -> &[JointClass] {
        &self.list
    }

    /// Returns the class of a joint, an index into the [`list`](Self::list).
    pub(super) fn class_of(&self, kind: JointKind, a: Body, b: BlockId) -> usize {
        let normal = match kind {
            JointKind::Support(id) => return self.of_supports[id.index()],
            JointKind::Blocks(normal) => normal,
        };
        let Body::Block(a) = a else { unreachable!("joints of supports are of their own kind") };
        if let Some(class) = self.of_pair(a, b) {
            return class;
        }
        if let Some(class) = self.of_places(a, b) {
            return class;
        }
        let wall = self.wall_of(a).filter(|wall| self.wall_of(b) == Some(*wall));
        let [bed, head] = wall.map_or(self.usual, |wall| self.of_walls[wall]);
        let turn = wall.and_then(|wall| self.turns.get(wall)).copied().unwrap_or(0.0);
        if is_bed(Rotation2::new(-turn) * normal) { bed } else { head }
    }

    fn of_pair(&self, a: BlockId, b: BlockId) -> Option<usize> {
        let is_in = |group: &Members, block: BlockId| match *group {
            Members::Wall(wall) => self.wall_of(block) == Some(wall),
            Members::Block(other) => other == block,
        };
        let fits = |[first, second]: &[Members; 2]| {
            is_in(first, a) && is_in(second, b) || is_in(first, b) && is_in(second, a)
        };
        let pairs = self.of_pairs.iter().rev();
        pairs.filter(|(groups, _)| fits(groups)).map(|(_, class)| *class).next()
    }

    /// Returns the class of a joint between two rings of an arch, or beside a lintel; `None` for other joints.
    fn of_places(&self, a: BlockId, b: BlockId) -> Option<usize> {
        let [a, b] = [a, b].map(|block| self.places.get(block.index()));
        let (a, b) = a.zip(b).filter(|(a, b)| a.wall == b.wall)?;
        if let (Some(one), Some(other)) = (a.ring, b.ring) {
            let arch = a.wall - self.of_lintels.len();
            return self.of_rings[arch].filter(|_| one != other);
        }
        let of_lintel = |part: &BlockPlace| self.of_lintels.get(part.wall)?[part.lintel?];
        of_lintel(a).or_else(|| of_lintel(b))
    }

    fn wall_of(&self, block: BlockId) -> Option<usize> {
        self.places.get(block.index()).map(|place| place.wall)
    }

    /// Returns the list of classes for a model with these joints.
    pub(super) fn of_joints(
        mut self,
        blocks: &[PlacedBlock],
        joints: &[PlacedJoint],
    ) -> Result<Vec<JointClass>, Fault> {
        if let Some(joint) = joints.iter().find(|joint| joint.class >= self.given) {
            return Err(missing_class(blocks, joint, &self.list[joint.class].name));
        }
        self.list.truncate(self.given);
        Ok(self.list)
    }
}

impl Members {
    fn of(scene: &Scene, blocks: &[PlacedBlock], name: &str, at: KeyPath) -> Result<Self, Fault> {
        if let Some(wall) = scene.walls.iter().position(|wall| wall.name == name) {
            return Ok(Self::Wall(wall));
        }
        if let Some(arch) = scene.arches.iter().position(|arch| arch.name == name) {
            return Ok(Self::Wall(scene.walls.len() + arch));
        }
        if let Some(block) = blocks.iter().position(|block| block.name == name) {
            return Ok(Self::Block(BlockId::new(block)));
        }
        let walls = scene.walls.iter().map(|wall| &wall.name);
        let walls = walls.chain(scene.arches.iter().map(|arch| &arch.name));
        let known = walls.chain(scene.blocks.iter().map(|block| &block.name)).cloned();
        let missing = "it as a block, a wall or an arch".to_owned();
        Err(unknown(at, "block, wall or arch", name, known.collect(), missing))
    }
}

fn joint_class(scene: &Scene, name: &str, joint: &scene::Joint) -> JointClass {
    let strength = |value: Option<f64>| value.unwrap_or(0.0) * scene.units.stress_to_si();
    let law = JointLaw {
        mu: joint.friction(),
        cohesion: strength(joint.cohesion),
        tension: strength(joint.tension),
        stiffness: joint.stiffness.map(|pair| pair.map(|k| k * scene.units.stiffness_to_si())),
    };
    JointClass { name: name.to_owned(), law, points: joint.points, mortar: mortar(scene, joint) }
}

fn mortar(scene: &Scene, joint: &scene::Joint) -> Option<Mortar> {
    let thickness = joint.mortar_thickness() * scene.units.length_to_si();
    let material = scene.materials.get(joint.material.as_ref()?)?;
    let elasticity = material.elasticity(scene.units)?;
    // The plane is given if a material is elastic.
    let material = FilmMaterial { elasticity, plane: scene.plane.unwrap_or(Plane::Stress) };
    (thickness > 0.0).then_some(Mortar { thickness, material })
}

/// Returns the error of a joint between blocks whose class is not given. Classes of supports were looked up before.
fn missing_class(blocks: &[PlacedBlock], joint: &PlacedJoint, class: &str) -> Fault {
    let name = |body| match body {
        Body::Block(id) => blocks[id.index()].name.clone(),
        Body::Support(_) => String::new(),
    };
    let class = class.to_owned();
    let (first, second) = (name(joint.a), name(Body::Block(joint.b)));
    Fault::new(KeyPath::of("joints"), SceneErrorKind::MissingClass { class, first, second })
}
