//! Routes from the equilibrium of the blocks to contact forces and displacements: one file each.
//!
//! | route | problem | method |
//! |---|---|---|
//! | [`forces`] | [`System`](crate::system::System) | admissible forces, by one convex program, or the proof that none exist |
//! | [`lemke`] | [`Reduction`](crate::forms::reduction::Reduction), dense | Lemke's method |
//! | [`interior`] | [`Sparse`](crate::forms::Sparse) | interior-point method, with evidence if there is no equilibrium |
//! | [`qp`] | [`Sparse`](crate::forms::Sparse) | convex quadratic programs, with proofs if there is no equilibrium |
//! | [`pgs`] | [`Sparse`](crate::forms::Sparse) | projected Gauss-Seidel on the contacts of blocks on springs |
//! | `paper::alm` | [`Sparse`](crate::forms::Sparse), or whole films | the augmented Lagrangian method of the paper |
//!
//! Each route gives a [`RouteAnswer`] to a [`Request`], and the error of the solver for a tolerance out of range, for
//! data that are not finite, and for a problem that the method does not treat. The [`Plan`](crate::plan::Plan) has the
//! routes of a scene.

use std::ops::ControlFlow;

use crate::data::info::SolveInfo;
use crate::data::motion::Motion;
use crate::data::state::RowState;
use crate::forms::Start;
use crate::scene::Form;

pub(crate) mod auto;
pub mod forces;
pub mod interior;
pub mod lemke;
pub(crate) mod loading;
pub mod pgs;
pub mod qp;
pub(crate) mod sparse;
pub mod statics;

/// The settings of a route.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Largest residual of a solution with status `Solved` \[-\].
    pub tolerance: f64,
    /// The form of the reduced problem.
    pub form: Form,
    /// Pivots of one attempt at most; the solver chooses if `None`.
    pub max_pivots: Option<usize>,
    /// Steps of the interior points of one attempt at most; the route chooses if `None`.
    pub max_steps: Option<usize>,
    /// Stiffness of springs on all displacements, relative to that of the blocks, for the routes that
    /// have them.
    pub soft: Option<f64>,
    /// The part of the loads that the drag may carry while blocks move: the smaller, the slower they are loaded.
    pub slowness: f64,
    /// The largest tolerance of steps in time, relative to the largest force \[-\].
    pub step_tolerance: f64,
}

impl Request {
    /// A request with this tolerance and default values.
    pub fn new(tolerance: f64) -> Self {
        Self {
            tolerance,
            form: Form::Auto,
            max_pivots: None,
            max_steps: None,
            soft: None,
            slowness: loading::SLOWNESS,
            step_tolerance: loading::STEP_TOLERANCE,
        }
    }
}

/// The result of a route.
#[derive(Debug, Clone)]
pub struct RouteAnswer {
    /// The record of the solve.
    pub info: SolveInfo,
    /// Contact forces and relative displacements, when solved.
    pub rows: Option<RowState>,
    /// The displacements of the sparse problem, for routes that have them, when solved.
    pub displacements: Option<Vec<f64>>,
    /// The basis of Lemke's method, when solved: a start for the next step of a load history.
    pub basis: Option<Start>,
    /// A motion that no contact seems to stop, when not solved.
    pub motion: Option<Motion>,
    /// The slip \[m\] of every point with friction, in the order of the system, before the slip in `rows`, if a motion
    /// led to the solution.
    pub moved: Option<Vec<f64>>,
    /// Works and energies on the way, if blocks moved.
    pub account: Option<lcp::Account>,
}

impl RouteAnswer {
    /// An answer without a solution.
    pub(crate) fn new(info: SolveInfo) -> Self {
        Self {
            info,
            rows: None,
            displacements: None,
            basis: None,
            motion: None,
            moved: None,
            account: None,
        }
    }
}

/// The progress of a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// A step of the load history begins.
    Step {
        /// Number of the step, from 1.
        number: usize,
        /// Number of steps of the scene.
        of: usize,
    },
    /// A phase begins.
    Phase(&'static str),
    /// The solver pivots.
    Pivots(lcp::lemke::Progress),
    /// The solver iterates.
    Iteration {
        /// Steps, iterations, programs, or re-centrings of springs so far.
        number: usize,
        /// The residual by which the solver stops.
        residual: f64,
    },
}

impl From<&lcp::Iteration> for Event {
    fn from(at: &lcp::Iteration) -> Self {
        Self::Iteration { number: at.iteration, residual: at.residual }
    }
}

/// Follows the progress of a solve; `Break` cancels it.
pub type EventObserver<'a> = &'a mut dyn FnMut(Event) -> ControlFlow<()>;
