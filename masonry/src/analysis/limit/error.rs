//! Errors of limit analysis.

use crate::plan::TooLarge;
use crate::scene::{Known, SceneError};
use crate::system::SystemError;

/// The reasons for which a limit load cannot be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LimitError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The matrices of the analysis need more memory than the machine has.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The equations of a block cannot be assembled.
    #[error(transparent)]
    System(#[from] SystemError),
    /// The solver refused the data because numbers overflow.
    #[error("the program was refused: {0}")]
    Solver(#[from] lcp::Error),
    /// The scene has no load that can grow.
    #[error("the scene has no loads of which a factor could grow: add [[loads]], or `gravity`")]
    NoLoads,
    /// The scene has several groups of loads, and none was named as the one that grows.
    #[error(
        "the scene has several groups of loads, {}: say which one grows, by `[limit] group = \"{}\"` or `--group \"{}\"`",
        listed(groups), groups[0], groups[0]
    )]
    WhichGroup {
        /// Names of the groups of loads in the scene.
        groups: Vec<String>,
    },
    /// The scene has no arch of this name.
    #[error(
        "there is no arch \"{name}\" in the scene; {known}: correct the name or add it under [[arches]]"
    )]
    NoArch {
        /// The name of the arch that was asked for.
        name: String,
        /// The names of the arches in the scene.
        known: Known,
    },
    /// The joints of the arch are given one by one, so that it has no thickness that could change.
    #[error(
        "the joints of arch \"{name}\" are given, so that it has no `thickness`: choose another `shape`"
    )]
    NoThickness {
        /// Name of the arch.
        name: String,
    },
    /// The scene has no train.
    #[error("the scene has no train: add `[limit.train]` with `over`, `axles`, `from` and `to`")]
    NoTrain,
    /// No axle of the train is on the bridge at any position.
    #[error(
        "no axle of the train stands on \"{over}\" at any of its positions: correct `from`, `to` or `over` of [limit.train]"
    )]
    NoAxle {
        /// Name of the bridge, the entry `over` of `[limit.train]`.
        over: String,
    },
    /// The weight is the growing load, but the blocks have no weight.
    #[error(
        "the blocks have no weight of which a factor could grow: give their materials a `density`, or name a group of loads"
    )]
    NoWeight,
    /// All loads of the growing group are zero.
    #[error(
        "the loads of \"{group}\" are zero, so that no factor changes anything: give them a value, or name another group"
    )]
    NoForce {
        /// Name of the growing group.
        group: String,
    },
}

fn listed(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}
