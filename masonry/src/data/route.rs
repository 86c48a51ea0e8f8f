//! The routes to a solution.

use serde::{Deserialize, Serialize};

/// A route to the solution: a form of the contact problem together with a method that solves it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Route {
    /// Admissible forces, which balance the loads within friction, by one convex program, or a proof that no such
    /// forces exist; for rigid blocks without gaps.
    Forces,
    /// Lemke's method on the problem reduced to contact forces, with dense matrices.
    Lemke,
    /// The interior-point method on the sparse problem with all displacements.
    Interior,
    /// Convex quadratic programs on the sparse problem: one without friction, a sequence of programs with friction.
    Qp,
    /// Projected Gauss-Seidel on the sparse problem. Springs hold the blocks, and are re-centred until they carry no
    /// load.
    Pgs,
    /// The augmented Lagrangian method on the sparse problem, for elastic blocks only.
    Alm,
}

impl Route {
    /// All routes, as `masonry solve --help` lists them.
    pub const ALL: [Self; 6] =
        [Self::Forces, Self::Lemke, Self::Interior, Self::Qp, Self::Pgs, Self::Alm];

    /// Returns the name in scenes and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Forces => "forces",
            Self::Lemke => "lemke",
            Self::Interior => "interior",
            Self::Qp => "qp",
            Self::Pgs => "pgs",
            Self::Alm => "alm",
        }
    }
}
