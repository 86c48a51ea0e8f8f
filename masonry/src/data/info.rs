//! Records of the work of routes: plain data.

use serde::{Deserialize, Deserializer, Serialize};

use crate::data::route::Route;

/// The way in which a state was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// One step from the previous state, or without one, with Coulomb's law for its slips.
    Law,
    /// The motion of blocks with mass, with Coulomb's law in each of its steps.
    Motion,
}

impl Way {
    /// A name for files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Law => "law",
            Self::Motion => "motion",
        }
    }
}

/// The record of the solution of the complementarity problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SolveInfo {
    /// `Solved`, or the reason for the end.
    pub status: lcp::Status,
    /// The route whose result is reported.
    pub route: Route,
    /// The reason for which the route was tried at its place in the order.
    pub because: String,
    /// All routes that were tried, in order.
    pub routes: Vec<RouteRecord>,
    /// The form that was solved: `coulomb`, `stewart-trinkle` or `mixed`
    /// ([`FormKind`](crate::forms::FormKind)) of the pivoting route, `contact` of the others.
    pub form: String,
    /// Order of the complementarity problem, or of the linear systems of the augmented Lagrangian method.
    pub order: usize,
    /// All attempts of all routes, in order.
    pub attempts: Vec<RouteAttempt>,
    /// Pivots over all attempts.
    pub pivots: usize,
    /// Steps of the interior-point method, programs, re-centrings of springs, or iterations of the
    /// augmented Lagrangian method.
    pub iterations: usize,
    /// Every iteration of the augmented Lagrangian method; empty on the other routes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub convergence: Vec<AlmIteration>,
    /// Matrices factorised.
    pub factorisations: usize,
    /// Whether the status `Infeasible` is proved, by a vector that was checked in the data.
    pub proved: bool,
    /// The effect of the springs of the scene.
    pub soft: Option<SoftReport>,
    /// The way in which the state was found, which decides the law of friction that it obeys.
    pub way: Way,
    /// Dimensionless residuals recomputed from the original data.
    pub residuals: lcp::Residuals,
    /// Residuals of the same solution in the paper's form (3.27), if another form was solved.
    pub coulomb_residuals: Option<lcp::Residuals>,
}

impl SolveInfo {
    /// A route, a status and residuals only.
    pub fn new(route: Route, status: lcp::Status, residuals: lcp::Residuals) -> Self {
        Self {
            status,
            route,
            because: String::new(),
            routes: Vec::new(),
            form: String::new(),
            order: 0,
            attempts: Vec::new(),
            pivots: 0,
            iterations: 0,
            convergence: Vec::new(),
            factorisations: 0,
            proved: false,
            soft: None,
            way: Way::Law,
            residuals,
            coulomb_residuals: None,
        }
    }
}

/// One attempt to find a state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RouteAttempt {
    /// A path of pivots.
    Pivots {
        /// The form, by its name.
        form: String,
        /// The name of the start basis that was given, unless the solver found its own.
        start: Option<String>,
        /// Covering vector, end and pivots.
        path: lcp::lemke::Attempt,
    },
    /// A method on the sparse problem.
    Sparse {
        /// The route.
        route: Route,
        /// `Solved`, or the reason for the end.
        status: lcp::Status,
        /// Steps, programs, rounds or iterations.
        iterations: usize,
        /// Matrices factorised.
        factorisations: usize,
        /// The worst residual \[-\].
        #[serde(deserialize_with = "or_infinite")]
        residual: f64,
    },
    /// The motion of blocks that are loaded slowly.
    Motion {
        /// The end of the motion.
        ending: lcp::Ending,
        /// Matrices factorised.
        factorisations: usize,
    },
    /// The search for forces within friction that balance the loads.
    Forces {
        /// `Solved` if the forces are an answer, `Infeasible` if there are none, or the reason why they are not an
        /// answer.
        status: lcp::Status,
        /// Whether there are such forces.
        are_found: bool,
        /// Matrices factorised.
        factorisations: usize,
    },
    /// The states of the contacts, solved anew with all displacements as unknowns.
    Refinement {
        /// The worst residual \[-\].
        #[serde(deserialize_with = "or_infinite")]
        residual: f64,
    },
    /// A route that was left because no forces balance the loads.
    Left {
        /// The route.
        route: Route,
        /// The steps of the route until it was left.
        iterations: usize,
    },
}

/// One iteration of the augmented Lagrangian method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct AlmIteration {
    /// The attempt, from 1.
    pub attempt: usize,
    /// Largest unbalanced force after the projection, relative to the largest load \[-\].
    #[serde(deserialize_with = "or_infinite")]
    pub unbalance: f64,
    /// Estimate of the distance from the solution, of displacements and of the forces in the blocks, relative to the
    /// largest of them or to the values under the loads alone \[-\]; infinite until the iteration contracts.
    #[serde(deserialize_with = "or_infinite")]
    pub distance: f64,
    /// Contacts that changed their state.
    pub changes: usize,
}

/// A number; infinite if the file has none, since JSON has no infinite numbers.
fn or_infinite<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// The end of a route.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RouteRecord {
    /// The route.
    pub route: Route,
    /// The reason for which the route was tried at its place in the order.
    pub because: String,
    /// The status and result of the route; or the reason of a refusal.
    pub end: String,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}

/// Springs that hold the blocks while a scene is solved, and their effect before they were re-centred; the springs do
/// not act in the final result.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SoftReport {
    /// The stiffness, relative to that of the blocks \[-\].
    pub stiffness: f64,
    /// Number of re-centrings.
    pub rounds: usize,
    /// The share of the load that the springs carried at first \[-\].
    pub share: f64,
    /// The error of the displacements that the springs caused at first, relative to the displacements \[-\]; `None` if
    /// the error is unknown, for example if nothing moves.
    pub displacement_error: Option<f64>,
}

/// Wall-clock time of one phase \[s\].
#[derive(Debug, Clone, Serialize)]
pub struct PhaseTime {
    /// Name of the phase.
    pub phase: String,
    /// Seconds.
    pub seconds: f64,
}
