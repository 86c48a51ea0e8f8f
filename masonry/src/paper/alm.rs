//! The augmented Lagrangian route (3.10)-(3.17), the paper's alternative to the complementarity problem.
//!
//! Every iteration solves one linear system for the current contact forces, the multipliers, and projects the
//! resulting forces onto the friction cones:
//!
//! ```text
//! ( K + delta D + sum rho_i C_i^T C_i ) u = f + delta D u_old + C^T (t - rho x),     D = diag K
//! t_n <- [t_n - rho_n y_n]+ ,     t_t <- projection of t_t - rho_t y_t on [-mu t_n, mu t_n]
//! ```
//!
//! The sum is over the closed contacts, along the tangent over those that stick. It holds floating blocks, and the
//! matrix changes only with the states of the contacts. The proximal term `delta` holds blocks without any closed
//! contact, which would move far away and return with huge forces without it. The term vanishes with the steps. The
//! penalties `rho` follow from the stiffness at the contact, and are made smaller if the iteration diverges or stops
//! converging.
//!
//! The unbalanced force is the error of the last step, and convergence is linear: the solution may be many such steps
//! away. So the status is `Solved` only if the rate at which the steps decrease also shows that displacements and
//! forces are near.
//!
//! Whole films of mortar are not contacts: see [`MortaredWall`].

mod contraction;
mod films;
mod matrices;
mod mortared;
mod route;
mod run;
mod structure;

use std::ops::ControlFlow;

pub use crate::data::info::AlmIteration;
pub use films::Segment;
use lcp::{Contact2d, ContactState, Residuals, Status};
pub use mortared::{MortaredState, MortaredWall, Parts};
pub use route::{by_films, by_multipliers};
use structure::Structure;

use crate::paper::film::FilmError;
use crate::system::SystemError;

/// Rounding errors of a step of the displacements, relative to these, and of a gap, relative to its largest term.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The settings of the route.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlmSettings {
    /// Largest unbalanced force, relative to the loads, largest residual, and largest estimated error of
    /// displacements and forces, relative to the largest of them, of a solution with status `Solved` \[-\].
    pub tolerance: f64,
    /// Iterations of all attempts.
    pub max_iterations: usize,
}

impl Default for AlmSettings {
    fn default() -> Self {
        Self { tolerance: 1e-8, max_iterations: 2000 }
    }
}

/// The result of the route.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct AlmAnswer {
    /// `Solved`, `IterationLimit`, `Stalled` if every attempt diverged or stopped converging, or `Cancelled`.
    pub status: Status,
    /// Displacements and contact forces of the best iteration.
    pub state: ContactState,
    /// The residuals of the state, from the data.
    pub residuals: Residuals,
    /// Every iteration.
    pub convergence: Vec<AlmIteration>,
    /// Numeric factorisations; the symbolic one is done once.
    pub factorisations: usize,
}

/// The reasons for which the method cannot treat a problem or a wall.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AlmError {
    /// A displacement has no stiffness.
    #[error(
        "displacement {displacement} has no stiffness, as in rigid blocks, and penalties follow from \
         it: give the block an elastic modulus or take another route"
    )]
    NoStiffness {
        /// The displacement, from 0.
        displacement: usize,
    },
    /// A contact has a spring in series.
    #[error(
        "contact {contact} has a compliance, which penalties cannot stand for: give its spring a \
         displacement, as Sparse::with_free_faces does"
    )]
    Compliance {
        /// The contact, from 0.
        contact: usize,
    },
    /// The tolerance is outside its range.
    #[error("tolerance is {tolerance}, but must be between 0 and 1")]
    Tolerance {
        /// The value.
        tolerance: f64,
    },
    /// The data of a problem overflow.
    #[error(transparent)]
    Data(#[from] lcp::Error),
    /// The sparse factors do not fit into memory, or `K` has a negative mode.
    #[error("the stiffness cannot be factorised: {0}")]
    Factorisation(String),
    /// A block of the wall cannot be assembled.
    #[error(transparent)]
    System(#[from] SystemError),
    /// The films of the wall cannot be made.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// A rigid block has no nodes to which films can be attached.
    #[error(
        "block \"{block}\" is rigid, and films are attached to nodes: give it an elastic modulus, or take another route"
    )]
    Rigid {
        /// Name of the block.
        block: String,
    },
    /// The joint class has more than friction, which the law of whole films does not have.
    #[error(
        "the joint class \"{class}\" has cohesion or tensile strength, which films as strips do not have: leave them out, \
         or take another route"
    )]
    Strength {
        /// Name of the joint class.
        class: String,
    },
    /// The joint class has a stiffness, and whole films have that of their mortar only.
    #[error(
        "the joint class \"{class}\" has a stiffness beside that of its mortar, which films as strips do not have: leave it \
         out, or take another route"
    )]
    Stiffness {
        /// Name of the joint class.
        class: String,
    },
    /// A film has no two contact points between nodes, which whole films need.
    #[error(
        "a film has no two contact points in strips between nodes: set `films = \"strips\"`, and let nodes of both faces \
         coincide, or lie farther apart"
    )]
    Points,
}

/// Solves a contact problem; the observer is called in every iteration, and `Break` cancels.
///
/// ```
/// use faer::mat;
/// use lcp::Contact2d;
/// use masonry::paper::alm::{self, AlmSettings};
/// // A body of weight 2 on springs, pressed on a plane (mu = 0.5) and pushed by 1.4: it slides
/// let contact = Contact2d::new(
///     mat![[4.0, 0.0], [0.0, 4.0]], vec![1.4, -2.0],
///     mat![[0.0, 1.0]], mat![[1.0, 0.0]], vec![0.0], vec![0.0], vec![0.5],
/// )?;
/// let answer = alm::solve(&contact, &AlmSettings::default(), &mut |_| std::ops::ControlFlow::Continue(()))?;
/// assert_eq!(answer.status, lcp::Status::Solved);
/// assert!((answer.state.t_t[0] + 1.0).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`AlmError`] for a tolerance out of range and for structures with rigid blocks.
pub fn solve(
    problem: &Contact2d,
    settings: &AlmSettings,
    observer: &mut dyn FnMut(&AlmIteration) -> ControlFlow<()>,
) -> Result<AlmAnswer, AlmError> {
    run::solve(&Structure::new(problem, &[])?, settings, observer)
}
