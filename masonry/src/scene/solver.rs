//! How a scene is solved: route, form, limits.

use serde::{Deserialize, Serialize};

/// How the complementarity problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Requested residual \[-\].
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// The method, and the problem that it is given.
    #[serde(default)]
    pub route: Route,
    /// The form of the reduced problem; belongs to [`Route::Lemke`].
    #[serde(default)]
    pub form: Form,
    /// Largest number of pivots of one attempt; without it the solver sets a limit by the order.
    /// Belongs to [`Route::Lemke`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_pivots: Option<u32>,
    /// Largest number of steps of the interior points of one attempt, and of the motions of blocks that come to rest
    /// or flow; without it the path takes 300 and motions take 600. Belongs to [`Route::Interior`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_steps: Option<u32>,
    /// Stiffness of springs on all displacements, relative to that of the blocks \[-\], which are
    /// taken away again; belongs to [`Route::Qp`], and to [`Route::Pgs`], which always has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub soft: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            tolerance: default_tolerance(),
            route: Route::default(),
            form: Form::default(),
            max_pivots: None,
            max_steps: None,
            soft: None,
        }
    }
}

/// The way from the equilibrium of the blocks to contact forces and displacements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Route {
    /// Chosen by the size of the scene, and another one where that fails.
    #[default]
    Auto,
    /// Forces inside friction that balance the loads, by one convex program: the answer for rigid blocks without gaps,
    /// and the proof where there are none.
    Forces,
    /// Pivots on the problem reduced to contact forces, with dense matrices.
    Lemke,
    /// The interior-point method on the sparse problem with all displacements.
    Interior,
    /// Newton's method on the states of the contacts, on the sparse problem.
    Newton,
    /// Convex quadratic programs on the sparse problem, a sequence of them for friction.
    Qp,
    /// Projected Gauss-Seidel sweeps on the sparse problem, with blocks held by springs that
    /// are centred anew until they carry nothing.
    Pgs,
    /// The augmented Lagrangian method on the sparse problem: contact forces as multipliers. For
    /// elastic blocks only.
    Alm,
}

impl Route {
    /// The name in scenes and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Forces => "forces",
            Self::Lemke => "lemke",
            Self::Interior => "interior",
            Self::Newton => "newton",
            Self::Qp => "qp",
            Self::Pgs => "pgs",
            Self::Alm => "alm",
        }
    }
}

fn default_tolerance() -> f64 {
    1e-10
}

/// The form in which friction enters the complementarity problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// The Coulomb form first; the mixed form when that ends on rays.
    #[default]
    Auto,
    /// Distances to the two edges of the friction cone (3.27): three unknowns a point.
    Coulomb,
    /// Two friction forces and a slip bound: four unknowns a point.
    StewartTrinkle,
    /// As Stewart-Trinkle, with the rigid amplitudes kept as unknowns.
    Mixed,
}
