//! Scenes: what a wall or an arch is made of, as a TOML file or built in Rust.
//!
//! A [`Scene`] holds the data as they were written, in the units of the scene; conversion to SI
//! happens once, in [`Model::from_scene`](crate::model::Model::from_scene). A scene that is read
//! from text and one that is built in Rust are the same type, so either can be written as TOML.
//!
//! ```
//! use masonry::scene::{Block, Joint, Material, Scene, Support};
//! use masonry::units::Units;
//!
//! let scene = Scene::new("One block on a floor", Units::SI)
//!     .thickness(1.0)
//!     .gravity([0.0, -9.81])
//!     .material("stone", Material::rigid().density(2000.0))
//!     .joint("floor", Joint::mu(0.7))
//!     .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
//!     .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"));
//! scene.check()?;
//! assert_eq!(Scene::from_toml(&scene.to_toml()?)?, scene);
//! # Ok::<(), masonry::scene::SceneError>(())
//! ```

pub(crate) mod arch;
mod arch_error;
mod block_list;
pub mod bond;
mod builder;
mod check;
mod courses;
mod error;
mod json_span;
mod key_path;
mod load;
mod opening;
mod read;
mod rules;
mod schema;
mod solver;
mod source;
mod stages;
mod strict;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use self::arch::{Arch, Line, Piers, Shape};
pub use self::arch_error::ArchError;
pub(crate) use self::error::Fault;
pub use self::error::{ContactError, Known, SceneError, SceneErrorKind};
pub use self::key_path::KeyPath;
pub use self::load::{EdgeStress, Load, LoadError, LoadKind};
pub use self::opening::{Bond, Opening, OpeningError};
pub use self::solver::{Form, Route, Solver};
use self::source::Source;
pub use self::stages::{Movement, Stage};
use crate::material::Elasticity;
pub use crate::material::Plane;
use crate::units::Units;

/// Name of the class of the joints between blocks whose normal is closer to the vertical.
pub(crate) const BED: &str = "bed";
/// Name of the class of the other joints between blocks.
pub(crate) const HEAD: &str = "head";

/// A scene as its author describes it, in the scene's own units.
///
/// The fields are the keys of the TOML file. Unknown keys are errors. What a key leaves out is
/// never guessed where it is physics: see [`Scene::check`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Title of reports and pictures.
    pub title: String,
    /// Plane stress or plane strain; required when a material is elastic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<Plane>,
    /// Thickness out of the plane \[length\]; required.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f64>,
    /// Gravity \[m/s^2\]; acts only on materials that have a density.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "strict::some_pair"
    )]
    pub gravity: Option<[f64; 2]>,
    /// A JSON file with more blocks, relative to the scene file: a list of objects with `material` and `corners`, and `name`
    /// and `mesh` as single blocks have them. A scene that was read from text has these blocks after its own, and no list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block_list: Option<PathBuf>,
    /// Units of length and force.
    #[serde(deserialize_with = "strict::table")]
    pub units: Units,
    /// Materials by name.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "strict::named_tables"
    )]
    pub materials: BTreeMap<String, Material>,
    /// Joint classes by name. Blocks meet in `bed` joints where the joint's normal is closer to
    /// the vertical than to the horizontal, in `head` joints elsewhere.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "strict::named_tables"
    )]
    pub joints: BTreeMap<String, Joint>,
    /// Classes of the joints between certain blocks, where they differ from `bed` and `head`; of several that fit, the
    /// last counts.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub between: Vec<Between>,
    /// Walls of bricks in courses.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub walls: Vec<Wall>,
    /// Arches of voussoirs.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub arches: Vec<Arch>,
    /// Single blocks.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub blocks: Vec<Block>,
    /// Rigid supports.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub supports: Vec<Support>,
    /// Loads on edges, at places in blocks, and on all mass.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub loads: Vec<Load>,
    /// The load history; without stages all loads act at once.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub stages: Vec<Stage>,
    /// Limit loads: which load grows.
    #[serde(default, deserialize_with = "strict::table", skip_serializing_if = "is_empty")]
    pub limit: Limit,
    /// Contact: positions of contact points, gaps that close, and mortar films.
    #[serde(default, deserialize_with = "strict::table")]
    pub contact: Contact,
    /// How the complementarity problem is solved.
    #[serde(default, deserialize_with = "strict::table")]
    pub solver: Solver,
    /// Output.
    #[serde(default, deserialize_with = "strict::table")]
    pub output: Output,
    /// The text that the scene was read from, for the places of errors.
    #[serde(skip)]
    source: Source,
}

/// A material: rigid without `E`, elastic with `E` and `nu`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus \[force/length^2\]; blocks of a material without it are rigid.
    #[serde(rename = "E", default, skip_serializing_if = "Option::is_none")]
    pub young: Option<f64>,
    /// Poisson's ratio \[-\], required with `E`.
    #[serde(rename = "nu", default, skip_serializing_if = "Option::is_none")]
    pub poisson: Option<f64>,
    /// Mass density \[kg/m^3\], whatever the units of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
}

impl Material {
    /// The elastic constants in SI units; `None` of a rigid material.
    pub(crate) fn elasticity(&self, units: Units) -> Option<Elasticity> {
        let young = self.young? * units.stress_to_si();
        Some(Elasticity { young, poisson: self.poisson? })
    }
}

/// A class of joints: exactly one of `mu` and `phi_deg`, and optionally cohesion, tensile strength and mortar. The
/// law is that of [`law`](crate::law).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Coefficient of Coulomb friction \[-\]; zero is a frictionless joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mu: Option<f64>,
    /// Angle of friction \[degrees\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub phi_deg: Option<f64>,
    /// Cohesion \[force/length^2\]: what resists sliding without a normal force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cohesion: Option<f64>,
    /// Tensile strength \[force/length^2\], at most the cohesion divided by the coefficient of friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tension: Option<f64>,
    /// Where on the joints of the class the law is enforced, if not as [`Contact::points`] says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<PointRule>,
    /// Thickness of the mortar \[length\]; without it, or with zero, the joint is dry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f64>,
    /// Name of the elastic material of the mortar; required with a thickness above zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

impl Joint {
    /// The coefficient of friction \[-\]; zero where neither `mu` nor `phi_deg` is given.
    pub fn friction(&self) -> f64 {
        self.mu.or(self.phi_deg.map(|phi| phi.to_radians().tan())).unwrap_or(0.0)
    }

    /// Thickness of the mortar \[length\]; zero for a dry joint.
    pub fn mortar_thickness(&self) -> f64 {
        self.thickness.unwrap_or(0.0)
    }
}

/// Two bodies, each the name of a block or of a wall, and the class of all joints between them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Between {
    /// The two names; twice the same wall for the joints within it.
    #[serde(deserialize_with = "strict::pair")]
    pub blocks: [String; 2],
    /// The class of their joints.
    pub joint: String,
}

/// The classes of the joints between the bricks of a wall.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WallJoints {
    /// Class of the bed joints, instead of `bed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bed: Option<String>,
    /// Class of the head joints, instead of `head`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub head: Option<String>,
}

impl WallJoints {
    /// The names of the classes of beds and heads.
    pub fn names(&self) -> [&str; 2] {
        [(&self.bed, BED), (&self.head, HEAD)].map(|(name, usual)| name.as_deref().unwrap_or(usual))
    }
}

/// A wall of bricks in courses, built by [`bond`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// Name of the wall; its bricks are `name/course/place`, both counted from 1.
    pub name: String,
    /// Name of the bricks' material.
    pub material: String,
    /// Lower left corner \[length\].
    #[serde(deserialize_with = "strict::pair")]
    pub origin: [f64; 2],
    /// The whole brick.
    #[serde(deserialize_with = "strict::table")]
    pub brick: Brick,
    /// Width of the wall \[length\]; only where `courses` is a number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// The courses, bottom to top.
    pub courses: Courses,
    /// How they are laid, if not in running bond; only where `courses` is a number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bond: Option<Bond>,
    /// Its openings; only where `courses` is a number.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::tables")]
    pub openings: Vec<Opening>,
    /// The classes of its joints, if not `bed` and `head`.
    #[serde(default, deserialize_with = "strict::table", skip_serializing_if = "is_usual")]
    pub joints: WallJoints,
    /// Elements along the length and height of a whole brick; required when the material is
    /// elastic. A cut brick gets its share of the first, rounded up.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "strict::some_pair"
    )]
    pub mesh: Option<[u32; 2]>,
}

/// Size of a whole brick.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Brick {
    /// Length along the course, without mortar \[length\].
    pub length: f64,
    /// Height of the course, without mortar \[length\].
    pub height: f64,
}

/// The courses of a wall: their number in a bond, or a list of bricks.
#[derive(Debug, Clone, PartialEq)]
pub enum Courses {
    /// A number of courses in running bond, or in the bond of the wall. The second, fourth and so on begin with a
    /// half brick, and the last brick of a course is cut to the width.
    RunningBond(u32),
    /// Bottom to top, each a list of brick lengths in units of one brick from left to right; a
    /// negative number is an opening of that length. In mortar the unit is one brick and one head
    /// joint: a brick of length `f` measures `f (l + t_y) - t_y`, a half brick `(l - t_y) / 2`.
    List(Vec<Vec<f64>>),
}

/// A single block: a convex polygon, of an elastic material a quadrilateral.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Name of the block.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Corners, counter-clockwise \[length\].
    #[serde(deserialize_with = "strict::corners")]
    pub corners: Vec<[f64; 2]>,
    /// Elements along edges 0 and 2, and along edges 1 and 3; required when the material is
    /// elastic.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "strict::some_pair"
    )]
    pub mesh: Option<[u32; 2]>,
}

/// A rigid straight support, which moves only where a [`Stage`] moves it. It has no inner side: blocks may lie on either.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Name of the support.
    pub name: String,
    /// One end \[length\].
    #[serde(deserialize_with = "strict::pair")]
    pub from: [f64; 2],
    /// The other end \[length\].
    #[serde(deserialize_with = "strict::pair")]
    pub to: [f64; 2],
    /// The class of its joints.
    pub joint: String,
}

/// Settings of a [limit load](crate::analysis::limit).
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Limit {
    /// The load, or the group of loads, whose factor grows; without it the only group, or the only one with a factor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
}

/// Contact: positions of contact points, gaps that close, and mortar films.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Where on a joint the contact law is enforced.
    #[serde(default)]
    pub points: PointRule,
    /// Bodies closer than this may meet \[length\]; zero: only bodies that touch.
    #[serde(default)]
    pub gap_limit: f64,
    /// Which terms of mortar films are kept.
    #[serde(default)]
    pub films: Films,
}

/// Where on a joint the contact law is enforced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PointRule {
    /// At both ends of every part of the overlap on which the shape functions of both sides are
    /// linear, with trapezoidal weights.
    #[default]
    Vertices,
    /// Only where a node of each side lies (on a support: at the nodes of the block), weighted by
    /// tributary length: the node pairs of the paper.
    NodalPairs,
    /// At two Gauss points in every part on which the shape functions of both sides are linear.
    Gauss,
}

/// Which terms of mortar films are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Films {
    /// What acts across the joint: a compliance in series with each contact point, without strain
    /// along the joint.
    #[default]
    Compliance,
    /// The whole strip (3.28)-(3.39), also with the stress along the joint and the strain that it
    /// shares with the blocks. It is integrated at its Gauss points: `points` must be `gauss`.
    Strips,
}

/// Output.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Whether stresses are recovered and written.
    #[serde(default = "default_stresses")]
    pub stresses: bool,
}

impl Default for Output {
    fn default() -> Self {
        Self { stresses: default_stresses() }
    }
}

fn is_usual(joints: &WallJoints) -> bool {
    *joints == WallJoints::default()
}

fn is_empty(limit: &Limit) -> bool {
    *limit == Limit::default()
}

fn default_stresses() -> bool {
    true
}
