//! Routes from the equilibrium of the blocks to contact forces and displacements: one file each.
//!
//! | route | works on | how |
//! |---|---|---|
//! | [`forces`] | [`System`](crate::system::System) | admissible forces, by one convex program, or the proof that there are none |
//! | [`lemke`] | [`Reduction`](crate::method::reduction::Reduction), dense | complementary pivoting |
//! | [`interior`] | [`Sparse`](crate::method::forms::Sparse) | interior points, with evidence where nothing stands |
//! | [`newton`] | [`Sparse`](crate::method::forms::Sparse) | active sets: the states of the contacts, exchanged until none contradicts |
//! | [`qp`] | [`Sparse`](crate::method::forms::Sparse) | convex quadratic programs, with proofs where nothing stands |
//! | [`pgs`] | [`Sparse`](crate::method::forms::Sparse) | sweeps over the contacts of blocks on springs |
//! | [`alm`](crate::paper::alm) | [`Sparse`](crate::method::forms::Sparse), or whole films | the augmented Lagrangian method of the paper |
//!
//! All of them give an [`Answer`] to a [`Request`]. Which ones a scene is given is in its
//! [`Plan`](crate::plan::Plan).

use std::ops::ControlFlow;
use std::time::Duration;

use crate::method::forms::{RowState, Start};
use crate::method::info::SolveInfo;
use crate::scene::Form;

pub(crate) mod auto;
mod error;
pub mod forces;
pub mod forms;
pub mod info;
pub mod interior;
pub mod lemke;
pub mod newton;
pub mod pgs;
pub mod qp;
pub mod reduction;
pub(crate) mod sparse;
pub mod statics;

pub use error::RouteError;

/// What a route is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Largest residual of an answer called solved \[-\].
    pub tolerance: f64,
    /// The form of the reduced problem.
    pub form: Form,
    /// Pivots of one attempt; `None` leaves it to the solver.
    pub max_pivots: Option<usize>,
    /// Stiffness of springs on all displacements, relative to that of the blocks, for the routes that
    /// have them.
    pub soft: Option<f64>,
    /// Wall-clock time of the programs; `None` is no limit.
    pub time_limit: Option<Duration>,
}

impl Request {
    /// A request with this tolerance and nothing else.
    pub fn new(tolerance: f64) -> Self {
        Self { tolerance, form: Form::Auto, max_pivots: None, soft: None, time_limit: None }
    }
}

/// What a route found.
#[derive(Debug, Clone)]
pub struct Answer {
    /// How it was found.
    pub info: SolveInfo,
    /// Contact forces and relative displacements, when solved.
    pub rows: Option<RowState>,
    /// The displacements of the sparse problem, of the routes that have them, when solved.
    pub displacements: Option<Vec<f64>>,
    /// The basis of the pivoting route, when solved: a start for the next step of a load history.
    pub basis: Option<Start>,
    /// A motion that nothing seems to stop, when not solved.
    pub motion: Option<Motion>,
    /// What the points with friction have slid \[m\] before the slips of `rows` were measured, and what that took, of an
    /// answer that a motion led to.
    pub moved: Option<Moved>,
}

/// A motion of all blocks.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Rates of the rigid amplitudes, three per block.
    Rigid(Vec<f64>),
    /// Displacements of the sparse problem, which are a rigid motion of every block and a little more.
    Displacements(Vec<f64>),
}

/// What a motion in a step of a load history did before its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// By point with friction, in the order of the system, how far it slid \[m\].
    pub slips: Vec<f64>,
    /// The energy that friction and viscosity took \[J\].
    pub dissipation: f64,
}

/// How far a route has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// It pivots.
    Pivots(lcp::lemke::Progress),
    /// It iterates.
    Iteration {
        /// Steps, iterations, programs, or times that springs were centred, done so far.
        number: usize,
        /// The residual by which the route stops.
        residual: f64,
    },
}

impl From<&lcp::Iteration> for Step {
    fn from(at: &lcp::Iteration) -> Self {
        Self::Iteration { number: at.iteration, residual: at.residual }
    }
}

/// Follows the progress of a solve; `Break` cancels it.
pub type Observer<'a> = &'a mut dyn FnMut(Step) -> ControlFlow<()>;

/// A route with the problem that it works on.
pub trait Method {
    /// Looks for a solution.
    ///
    /// # Errors
    /// [`RouteError`] for a tolerance out of range, for data that are not finite, and for a problem that
    /// the method does not treat.
    fn solve(&self, request: &Request, observer: Observer<'_>) -> Result<Answer, RouteError>;
}
