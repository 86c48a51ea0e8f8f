//! Walls and arches of blocks with unilateral Coulomb contact.
//!
//! Blocks, elastic (four-node elements) or rigid, meet in joints that carry no tension and slide by
//! Coulomb's law. Their displacements are eliminated, and what remains is a linear complementarity
//! problem in the contact forces, which [`lcp`] solves. [`solve::solve`] does it all:
//!
//! ```
//! use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};
//! use masonry::units::Units;
//! use masonry::{output::table, solve::solve};
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
//! assert!(table::report(&outcome).contains("Solved"));
//! # Ok::<(), masonry::solve::SolveError>(())
//! ```
//!
//! # The way of the data
//! Every stage is a module and can be used on its own; each builds on those before it.
//!
//! | stage | module | result |
//! |---|---|---|
//! | scene: what is there, in its own units | [`scene`], [`units`], [`bond`] | [`scene::Scene`] |
//! | model: blocks, joints, contact points, in SI units | [`model`], [`geometry`], [`mesh`], [`contact`], [`ids`] | [`model::Model`] |
//! | plan: what the scene calls for | [`plan`] | [`plan::Plan`] |
//! | load history: what acts in every step | [`history`] | [`history::Step`] |
//! | system: stiffness, loads, contact rows (3.2) | [`system`], [`element`], [`rigid`] | [`system::System`] |
//! | mortar films as strips with nodes (3.28)-(3.53), beside the scene's own | [`film`] | [`film::pointwise::PointwiseFilm`] |
//! | reduction to contact forces (3.18), (3.23) | [`reduction`] | [`reduction::Reduction`] |
//! | complementarity problem (3.27) and its other forms; the sparse one | [`forms`] | [`forms::Form`], [`forms::Sparse`] |
//! | solution | [`routes`] | [`routes::Answer`] |
//! | displacements, stresses, reactions | [`recover`] | [`outcome::State`] |
//! | balances that use nothing of the method | [`check`] | [`check::Checks`] |
//! | forces inside friction that balance the loads, or the proof that there are none | [`statics`] | [`statics::Statics`] |
//! | stands, falls or undecided, with the evidence | [`verdict`] | [`verdict::Judgement`] |
//! | text, pictures, tables, meshes | [`output`] | files |
//! | what accuracy costs: routes, tolerances, meshes compared | [`study`] | [`study::Study`] |
//!
//! Numbers in brackets are equations of N.M. Auciello and A. Ercolano, *Numerical simulation of
//! masonry panels* (1997). Signs and directions are those of [`model`].

pub mod bond;
pub mod check;
#[cfg(feature = "cli")]
pub mod cli;
pub mod contact;
pub mod element;
pub mod film;
pub mod forms;
pub mod geometry;
pub mod history;
pub mod ids;
mod info;
mod material;
pub mod mesh;
pub mod model;
pub mod outcome;
pub mod output;
pub mod plan;
mod policy;
pub mod recover;
pub mod reduction;
pub mod rigid;
mod rounding;
pub mod routes;
pub mod scene;
pub mod solve;
mod state;
pub mod statics;
pub mod study;
pub mod system;
pub mod units;
pub mod verdict;

/// The programs of the README and of the guide are compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct ReadmeDoctest;

/// See [`ReadmeDoctest`].
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide.md")]
struct GuideDoctest;
