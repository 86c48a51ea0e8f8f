//! Records of the work of routes.

use serde::{Deserialize, Deserializer, Serialize};

use crate::data::route::Route;

/// The way in which a state was found: by one step with Coulomb's law, or by a motion of blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// One step from the previous state, or from no loads, with Coulomb's law for the slips of the step.
    Law,
    /// A motion of blocks with mass in several steps, with Coulomb's law for the slips of each.
    Motion,
}

impl Way {
    /// Returns the name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Law => "law",
            Self::Motion => "motion",
        }
    }
}

/// The record of the solution of a complementarity problem by all routes that were tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SolveInfo {
    /// `Solved`, or the reason why the route ended without a solution.
    pub status: lcp::Status,
    /// The route whose result is kept.
    pub route: Route,
    /// The reason for which this route was tried at its place in the order.
    pub because: String,
    /// All routes that were tried, in order.
    pub routes: Vec<RouteRecord>,
    /// The form of the problem that was solved: `coulomb`, `stewart-trinkle` or `mixed`
    /// ([`FormKind`](crate::forms::FormKind)) by Lemke's method, `contact` by most other routes.
    pub form: String,
    /// Order of the complementarity problem, or of the linear systems of the augmented Lagrangian method.
    pub order: usize,
    /// All attempts of all routes to find a state, in order.
    pub attempts: Vec<RouteAttempt>,
    /// Number of pivots in all attempts.
    pub pivots: usize,
    /// Number of iterations: steps of the interior-point method, programs, re-centrings of springs, or iterations of
    /// the augmented Lagrangian method.
    pub iterations: usize,
    /// All iterations of the augmented Lagrangian method; empty for other routes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub convergence: Vec<AlmIteration>,
    /// Number of factorised matrices.
    pub factorisations: usize,
    /// Whether the status `Infeasible` is proved by a vector that was checked against the data.
    pub proved: bool,
    /// The effect of the springs that held the blocks; `None` without springs.
    pub soft: Option<SoftReport>,
    /// The way in which the state was found: by one step with Coulomb's law, or by a motion of blocks.
    pub way: Way,
    /// Dimensionless residuals of the solution, recomputed from the original data.
    pub residuals: lcp::Residuals,
    /// Residuals of the same solution in the paper's form (3.27); `None` unless another form was solved after it.
    pub coulomb_residuals: Option<lcp::Residuals>,
}

impl SolveInfo {
    /// Returns a record that has only a route, a status and residuals.
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

/// One attempt of a route to find a state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RouteAttempt {
    /// A path of pivots of Lemke's method.
    Pivots {
        /// The name of the form of the problem.
        form: String,
        /// The name of the start basis that was given; `None` if the solver found its own.
        start: Option<String>,
        /// The covering vector, the end and the number of pivots of the path.
        path: lcp::lemke::Attempt,
    },
    /// An iterative method on the sparse problem.
    Sparse {
        /// The route of the method.
        route: Route,
        /// `Solved`, or the reason why the method ended without a solution.
        status: lcp::Status,
        /// Number of steps, programs, rounds or iterations, as the method calls them.
        iterations: usize,
        /// Number of factorised matrices.
        factorisations: usize,
        /// The worst residual at the end \[-\].
        #[serde(deserialize_with = "or_infinite")]
        residual: f64,
    },
    /// A motion of blocks with mass, which are loaded slowly.
    Motion {
        /// The end of the motion: the blocks rest, go on moving, or the search ended for another reason.
        ending: lcp::Ending,
        /// Number of factorised matrices.
        factorisations: usize,
    },
    /// The search for admissible forces, which balance the loads within friction.
    Forces {
        /// `Solved` if the forces are the answer, `Infeasible` if no such forces exist, or the reason why the forces
        /// are not an answer.
        status: lcp::Status,
        /// Whether admissible forces were found.
        are_found: bool,
        /// Number of factorised matrices.
        factorisations: usize,
    },
    /// A refinement: the equations of the contact states are solved again, with all displacements as unknowns.
    Refinement {
        /// The worst residual of the refined solution \[-\].
        #[serde(deserialize_with = "or_infinite")]
        residual: f64,
    },
    /// A route that was stopped because it is proved that no forces balance the loads.
    Left {
        /// The route that was stopped.
        route: Route,
        /// Number of steps of the route until it was stopped.
        iterations: usize,
    },
}

/// One iteration of the augmented Lagrangian method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct AlmIteration {
    /// The number of the attempt, from 1.
    pub attempt: usize,
    /// Largest unbalanced force after the projection onto the friction cones, relative to the largest load \[-\].
    #[serde(deserialize_with = "or_infinite")]
    pub unbalance: f64,
    /// Estimate of the distance from the solution \[-\], for displacements and for the forces in the blocks, relative
    /// to the largest value or to the values under the loads alone; infinite until the iteration contracts.
    #[serde(deserialize_with = "or_infinite")]
    pub distance: f64,
    /// Number of contacts that changed their state.
    pub changes: usize,
}

/// Reads a number; it is infinite if the file has `null`, since JSON has no infinite numbers.
fn or_infinite<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// One route that was tried: why, how it ended, and how long it took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RouteRecord {
    /// The route that was tried.
    pub route: Route,
    /// The reason for which the route was tried at its place in the order.
    pub because: String,
    /// The status at the end of the route, or the reason why the route refused the problem.
    pub end: String,
    /// Wall-clock time of the route \[s\].
    pub seconds: f64,
}

/// The effect of auxiliary springs that hold the blocks while a scene is solved, before the springs are re-centred. The
/// springs do not act in the final result.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SoftReport {
    /// Stiffness of the springs, relative to that of the blocks \[-\].
    pub stiffness: f64,
    /// Number of times that the springs were re-centred.
    pub rounds: usize,
    /// The share of the load that the springs carried before they were re-centred \[-\].
    pub share: f64,
    /// The error that the springs caused in the displacements before they were re-centred, relative to the
    /// displacements \[-\]; `None` if the error is unknown, for example if nothing moves.
    pub displacement_error: Option<f64>,
}

/// Wall-clock time of one phase of an analysis.
#[derive(Debug, Clone, Serialize)]
pub struct PhaseTime {
    /// Name of the phase.
    pub phase: String,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}
