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
//! Each route gives a [`RouteAnswer`] to a [`Request`], or an error of the solver if the tolerance is out of range,
//! data are not finite, or the method does not treat the problem. The routes of a scene are in its
//! [`Plan`](crate::plan::Plan).

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
    /// Largest residual \[-\] with which a solution has the status `Solved`.
    pub tolerance: f64,
    /// The form of the reduced problem, for Lemke's method.
    pub form: Form,
    /// Largest number of pivots in one attempt; `None` if the solver chooses.
    pub max_pivots: Option<usize>,
    /// Largest number of steps of the interior-point method in one attempt; `None` if the route chooses.
    pub max_steps: Option<usize>,
    /// Stiffness of auxiliary springs on all displacements, relative to that of the blocks, for the routes that have
    /// such springs; `None` if the scene sets none.
    pub soft: Option<f64>,
    /// The part of the loads that the drag may carry while blocks move: the smaller it is, the more slowly blocks are
    /// loaded.
    pub slowness: f64,
    /// Largest tolerance of the steps in time while blocks move, relative to the largest force \[-\].
    pub step_tolerance: f64,
}

impl Request {
    /// Returns a request with this tolerance, and default values for all other settings.
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

/// The answer of a route to a request.
#[derive(Debug, Clone)]
pub struct RouteAnswer {
    /// The record of the work of the route.
    pub info: SolveInfo,
    /// Contact forces and relative displacements of all rows; `None` if not solved.
    pub rows: Option<RowState>,
    /// The displacements of the sparse problem; `None` if not solved, or if the route has none.
    pub displacements: Option<Vec<f64>>,
    /// The basis at which Lemke's method ended, from which the next step of a load history may start; `None` if not
    /// solved.
    pub basis: Option<Start>,
    /// A motion that no contact seems to stop; `None` if solved, or if no such motion was found.
    pub motion: Option<Motion>,
    /// The slip \[m\] of every point with friction, in the order of the system, before the slip in `rows`; `None`
    /// unless a motion of blocks led to the solution.
    pub moved: Option<Vec<f64>>,
    /// Work and energies during the motion of blocks; `None` if no blocks moved.
    pub account: Option<lcp::Account>,
}

impl RouteAnswer {
    /// Returns an answer without a solution.
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

/// An event that shows the progress of a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// A step of the load history begins.
    Step {
        /// Number of the step among all steps, from 1.
        number: usize,
        /// Number of all steps of the scene.
        of: usize,
    },
    /// A phase of the analysis with this name begins.
    Phase(&'static str),
    /// Lemke's method pivots.
    Pivots(lcp::lemke::Progress),
    /// An iterative method takes a step.
    Iteration {
        /// Number of steps, iterations, programs, or re-centrings of springs so far.
        number: usize,
        /// The residual that the solver compares with its tolerance.
        residual: f64,
    },
}

impl From<&lcp::Iteration> for Event {
    fn from(at: &lcp::Iteration) -> Self {
        Self::Iteration { number: at.iteration, residual: at.residual }
    }
}

/// A function that is called at every event of a solve; `Break` cancels the solve.
pub type EventObserver<'a> = &'a mut dyn FnMut(Event) -> ControlFlow<()>;
