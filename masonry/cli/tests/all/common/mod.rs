//! Helpers of several tests.

pub(crate) mod quoted;

/// The checks of a state in `result.json`.
pub(crate) const BALANCE: [&str; 9] = [
    "force",
    "moment",
    "uncarried_load",
    "nodal",
    "cone_violation",
    "penetration",
    "complementarity",
    "energy",
    "deformation",
];
