//! Walls and arches of blocks in unilateral contact with Coulomb friction.
//!
//! Blocks, elastic (four-node elements) or rigid, meet in joints that slide by Coulomb's law, with optional cohesion
//! and tensile strength. The result is a contact problem in displacements and contact forces, or a linear
//! complementarity problem in the contact forces alone; [`lcp`] solves both. [`solve`] runs all stages:
//!
//! ```
//! use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};
//! use masonry::{Units, Verdict, solve};
//!
//! let brick = Brick { length: 0.2, height: 0.1 };
//! let scene = Scene::new("Three courses", Units::SI)
//!     .thickness(0.1)
//!     .material("stone", Material::rigid())
//!     .joint("bed", Joint::mu(0.6))
//!     .joint("head", Joint::mu(0.6))
//!     .wall(Wall::running_bond("wall", "stone", brick, 0.4, 3))
//!     .support(Support::new("floor", [0.0, 0.0], [0.4, 0.0], "bed"))
//!     .load(Load::pressure("top", [0.0, 0.3], [0.4, 0.3], 1e4));
//! let outcome = solve(&scene)?;
//! assert!((outcome.reactions[0].fy - 400.0).abs() < 1e-9);
//! assert_eq!(outcome.verdict(), Verdict::Stands);
//! # Ok::<(), masonry::SolveError>(())
//! ```
//!
//! # Data flow
//! Every stage is a module; each imports only modules above it. Modules without a link are internal: tests, benches
//! and `masonry-report` see them, and they may change in any version.
//!
//! | module | content |
//! |---|---|
//! | [`units`], [`ids`], `geometry`, [`material`], `element` | used by all others |
//! | [`data`] | data that modules pass to one another: states, routes, proofs, verdicts |
//! | [`law`] | the law of a joint: friction, cohesion, tensile strength |
//! | [`scene`] | the input in its own units: text, checks, builders, bonds of bricks |
//! | [`model`] | blocks, joints, contact points and meshes, in SI units |
//! | `system` | stiffness, loads, contact rows (3.2), rigid motions |
//! | `forms` | the forms of the problem (3.27) and its reduction (3.18), (3.23) |
//! | `recover` | from contact forces to displacements, stresses, reactions |
//! | `method` | one file per method, the choice among them (`auto`), admissible forces |
//! | `paper` | with the feature of this name: augmented Lagrangian method, films with nodes, for comparison |
//! | [`history`] | loads and support positions of every step |
//! | [`verify`] | checks of a state: balances and contact law; the verdict: stands, falls or undecided |
//! | [`plan`] | the effects that the scene uses, with reasons |
//! | [`analysis`] | one solution, load histories, limit loads, studies of accuracy |
//!
//! Numbers in brackets are equations of N.M. Auciello and A. Ercolano, *Numerical simulation of
//! masonry panels* (1997). Signs and directions are those of [`model`].

pub mod analysis;
mod columns;
pub mod data;
#[doc(hidden)]
pub mod element;
#[doc(hidden)]
pub mod files;
#[doc(hidden)]
pub mod forms;
#[doc(hidden)]
pub mod geometry;
pub mod history;
pub mod ids;
pub mod law;
pub mod material;
#[doc(hidden)]
pub mod method;
pub mod model;
#[cfg(feature = "paper")]
#[doc(hidden)]
pub mod paper;
pub mod plan;
#[doc(hidden)]
pub mod recover;
#[doc(hidden)]
pub mod rounding;
pub mod scene;
#[doc(hidden)]
pub mod system;
pub mod units;
pub mod verify;

pub use analysis::checkpoint::Checkpoint;
pub use analysis::limit::{
    Bracket, Directions, Laws, Limit, LimitError, Range, Thickness, least_thickness,
    least_thickness_observed, limit, limit_by, limit_observed, ranges, ranges_observed,
};
pub use analysis::outcome::Outcome;
pub use analysis::solve::{Event, Run, SolveError, solve, solve_observed};
pub use data::route::Route;
pub use data::state::{PointState, PointStatus, Reaction, State};
pub use data::verdict::{Evidence, Judgement, Verdict};
pub use history::History;
pub use model::Model;
pub use plan::Plan;
pub use scene::{Scene, SceneError};
pub use units::Units;
pub use verify::checks::Checks;

/// Compiles and runs the programs of the README with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct ReadmeDoctest;

/// Compiles and runs the programs of the README of this crate with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct CrateReadmeDoctest;

/// Compiles and runs the programs of the guide with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide.md")]
struct GuideDoctest;

/// Compiles and runs the programs of the reference with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/reference/rust.md")]
struct ReferenceDoctest;
