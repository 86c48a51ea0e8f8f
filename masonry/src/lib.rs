//! Walls and arches of blocks with unilateral Coulomb contact.
//!
//! Data flows one way: scene, model, plan, system, reduction, solution, recovery, report.

pub mod bond;
pub mod check;
#[cfg(feature = "cli")]
pub mod cli;
pub mod contact;
pub mod element;
pub mod forms;
pub mod geometry;
pub mod ids;
pub mod mesh;
pub mod model;
pub mod outcome;
pub mod output;
pub mod plan;
pub mod recover;
pub mod reduction;
pub mod rigid;
pub mod system;
pub mod routes;
pub mod scene;
pub mod solve;
pub mod units;
