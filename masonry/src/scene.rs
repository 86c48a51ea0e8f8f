//! Scenes: walls and arches as their authors describe them, in a TOML file or in Rust.
//!
//! A [`Scene`] holds the data as they were written, in the units of the scene.
//! [`Model::from_scene`](crate::model::Model::from_scene) converts them to SI, once. A scene that is read from text
//! has the same type as one that is built in Rust, so that both can be written as TOML.
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
mod combinations;
mod contact;
mod courses;
mod drawn;
mod error;
mod fill;
pub(crate) mod groups;
mod json_span;
mod key_path;
mod limit;
mod load;
mod materials;
mod opening;
mod read;
pub(crate) mod rules;
mod schema;
mod setters;
mod solver;
mod source;
mod stages;
mod stress;
mod strict;
mod wall;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use self::arch::{Arch, JointLine, Piers, Shape};
pub use self::arch_error::ArchError;
pub use self::combinations::{Combination, Combined, OPPOSITE};
pub use self::contact::{Contact, Films, PointRule};
pub use self::drawn::{Drawings, Drawn};
pub(crate) use self::error::Fault;
pub use self::error::{ContactError, Known, SceneError, SceneErrorKind};
pub use self::fill::{Axle, Fill};
pub use self::key_path::KeyPath;
pub use self::limit::{LimitLoad, Seismic, Train};
pub(crate) use self::load::factor_in;
pub use self::load::{Load, LoadError, LoadKind};
pub use self::materials::{Between, Joint, Material};
pub use self::opening::{Bond, Brick, Lintel, Opening, OpeningError};
pub use self::solver::{Form, RouteSetting, SolverSettings};
use self::source::Source;
pub use self::stages::{Movement, Stage};
pub use self::stress::{Earth, EdgeStress, Pressure};
pub use self::wall::{Courses, Wall, WallJoints};
pub use crate::data::route::Route;
pub use crate::material::Plane;
use crate::units::Units;

strict::tables!(Arch, Axle, Between, Block, Brick, Combination, Contact, Earth, Fill, Joint);
strict::tables!(LimitLoad, Lintel, Load, Material, Movement, Opening, Output, Piers, Seismic);
strict::tables!(SolverSettings, Stage, Support, Train, Units, Wall, WallJoints);

/// Name of the class of bed joints: joints between blocks whose normal is closer to the vertical than to the
/// horizontal.
pub(crate) const BED: &str = "bed";
/// Name of the class of head joints: all other joints between blocks.
pub(crate) const HEAD: &str = "head";

/// A scene as described by its author, in the scene's own units.
///
/// The fields are the keys of the TOML file. Unknown keys are errors, and the value of a physical quantity is never
/// guessed if its key is missing: see [`Scene::check`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Title of the scene in reports and pictures.
    pub title: String,
    /// Plane stress or plane strain; required if a material is elastic.
    pub plane: Option<Plane>,
    /// Thickness out of the plane \[length\]; required.
    pub thickness: Option<f64>,
    /// Gravity \[m/s^2\]; acts only on materials that have a density.
    #[serde(default, deserialize_with = "strict::read")]
    pub gravity: Option<[f64; 2]>,
    /// A file with more blocks, with a path relative to the scene file: a JSON list, or a drawing as `masonry import`
    /// reads it. Each item of a JSON list has `material` and `corners`, and may have `name` and `mesh` as single
    /// blocks do. Programs in Rust read drawings by `masonry_import::read_scene`; `Scene::read` alone reads JSON lists
    /// only. After a scene was read from text, these blocks follow its own blocks, and this key is empty.
    pub block_list: Option<PathBuf>,
    /// Units of length and force.
    #[serde(deserialize_with = "strict::read")]
    pub units: Units,
    /// Materials by name.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "strict::read"
    )]
    pub materials: BTreeMap<String, Material>,
    /// Joint classes by name. Blocks meet in `bed` joints if the joint's normal is closer to
    /// the vertical than to the horizontal, in `head` joints elsewhere.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "strict::read"
    )]
    pub joints: BTreeMap<String, Joint>,
    /// The classes of joints between certain bodies, instead of `bed` and `head`; the last matching entry counts.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub between: Vec<Between>,
    /// Walls of bricks in courses.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub walls: Vec<Wall>,
    /// Arches of voussoirs.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub arches: Vec<Arch>,
    /// Single blocks.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub blocks: Vec<Block>,
    /// Rigid supports.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub supports: Vec<Support>,
    /// Loads on edges, at places in blocks and on all mass.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub loads: Vec<Load>,
    /// The stages of the load history; without stages, all loads act at once.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub stages: Vec<Stage>,
    /// Combinations of loads, instead of stages; each combination is solved by itself.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "strict::read")]
    pub combinations: Vec<Combination>,
    /// Settings of limit loads: the load that grows, and the seismic check.
    #[serde(
        default,
        deserialize_with = "strict::read",
        skip_serializing_if = "LimitLoad::is_empty"
    )]
    pub limit: LimitLoad,
    /// Settings of contact: positions of contact points, gaps that may close, and mortar films.
    #[serde(default, deserialize_with = "strict::read")]
    pub contact: Contact,
    /// Settings of the solver of the complementarity problem.
    #[serde(default, deserialize_with = "strict::read")]
    pub solver: SolverSettings,
    /// The results that are computed in addition to displacements and forces.
    #[serde(default, deserialize_with = "strict::read")]
    pub output: Output,
    /// The text from which the scene was read, for the line and column of errors.
    #[serde(skip)]
    source: Source,
}

/// A single block: a simple polygon. A block of an elastic material must be convex, or star-shaped about its centroid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Name of the block.
    pub name: String,
    /// Name of the material of the block.
    pub material: String,
    /// Corners, counter-clockwise \[length\].
    #[serde(deserialize_with = "strict::read")]
    pub corners: Vec<[f64; 2]>,
    /// Numbers of elements; required if the material is elastic. A convex quadrilateral has two numbers: along edges 0
    /// and 2, and along edges 1 and 3. Any other block has one number, and twice as many elements along every edge.
    #[serde(default, deserialize_with = "strict::mesh")]
    #[cfg_attr(test, schemars(with = "Option<Elements>"))]
    pub mesh: Option<[u32; 2]>,
}

/// The numbers of elements: one number for both directions, or one for each.
#[cfg(test)]
#[derive(schemars::JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "it describes what is read")]
enum Elements {
    Both(u32),
    Each([u32; 2]),
}

/// A rigid straight support, which moves only if a [`Stage`] moves it. Blocks may be on both sides of the support.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Name of the support.
    pub name: String,
    /// One end of the support \[length\].
    #[serde(deserialize_with = "strict::read")]
    pub from: [f64; 2],
    /// The other end of the support \[length\].
    #[serde(deserialize_with = "strict::read")]
    pub to: [f64; 2],
    /// The class of the joints of the support.
    pub joint: String,
}

/// Settings of the results that are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Output {
    /// Whether stresses are computed and written.
    pub stresses: bool,
}

impl Default for Output {
    fn default() -> Self {
        Self { stresses: true }
    }
}
