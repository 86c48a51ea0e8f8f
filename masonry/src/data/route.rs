//! The routes to a solution.

use serde::{Deserialize, Serialize};

/// A route to the solution: a form of the equations and a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Route {
    /// Forces within friction that balance the loads, by one convex program, or a proof that there are no such
    /// forces; for rigid blocks without gaps.
    Forces,
    /// Lemke's method on the problem reduced to contact forces, with dense matrices.
    Lemke,
    /// The interior-point method on the sparse problem with all displacements.
    Interior,
    /// Convex quadratic programs on the sparse problem; a sequence of them for friction.
    Qp,
    /// Projected Gauss-Seidel on the sparse problem; springs hold the blocks, and are re-centred until they carry
    /// nothing.
    Pgs,
    /// The augmented Lagrangian method on the sparse problem, for elastic blocks only.
    Alm,
}

impl Route {
    /// All routes, as `masonry solve --help` lists them.
    pub const ALL: [Self; 6] =
        [Self::Forces, Self::Lemke, Self::Interior, Self::Qp, Self::Pgs, Self::Alm];

    /// The name in scenes and reports.
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
