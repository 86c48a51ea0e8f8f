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
//! The sum is over the closed contacts; along the tangent, over the sticking ones. The sum holds blocks that the
//! stiffness alone does not hold, and the matrix changes only with the states of the contacts. The proximal term
//! `delta` holds blocks without any closed contact, which would otherwise move far away and return with huge forces.
//! The term vanishes as the steps become small. The penalties `rho` follow from the stiffness at the contact, and are
//! made smaller if the iteration diverges or stops converging.
//!
//! The unbalanced force is only the error of the last step, and convergence is linear: the solution may be many such
//! steps away. So the status is `Solved` only if the rate at which the steps decrease also shows that displacements
//! and forces are near their limits.
//!
//! Mortar films as strips are not contacts here: see [`MortaredWall`].

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

/// Relative rounding error \[-\] of a step of the displacements, relative to the displacements, and of a gap, relative
/// to its largest term.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The settings of the augmented Lagrangian route.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlmSettings {
    /// Tolerance \[-\] of a solution with status `Solved`: the largest unbalanced force relative to the loads, the
    /// largest residual, and the largest estimated errors of displacements and forces relative to the largest
    /// displacement and force.
    pub tolerance: f64,
    /// Largest number of iterations, over all attempts together.
    pub max_iterations: usize,
}

impl Default for AlmSettings {
    fn default() -> Self {
        Self { tolerance: 1e-8, max_iterations: 2000 }
    }
}

/// The result of the augmented Lagrangian route.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct AlmAnswer {
    /// `Solved`, `IterationLimit`, `Stalled` if every attempt diverged or stopped converging, or `Cancelled`.
    pub status: Status,
    /// Displacements and contact forces of the best iteration.
    pub state: ContactState,
    /// The residuals of the state, computed from the data of the problem.
    pub residuals: Residuals,
    /// The records of all iterations.
    pub convergence: Vec<AlmIteration>,
    /// Number of numeric factorisations; the symbolic factorisation is done once.
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
        /// The index of the displacement, from 0.
        displacement: usize,
    },
    /// A contact has a compliance, that is, a spring in series.
    #[error(
        "contact {contact} has a compliance, which penalties cannot stand for: give its spring a \
         displacement, as Sparse::with_free_faces does"
    )]
    Compliance {
        /// The index of the contact, from 0.
        contact: usize,
    },
    /// The tolerance is not between 0 and 1.
    #[error("tolerance is {tolerance}, but must be between 0 and 1")]
    Tolerance {
        /// The tolerance that was given \[-\].
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
    /// The mortar films of the wall cannot be made.
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
    /// The joint class has cohesion or tensile strength, which the law of mortar films as strips does not have.
    #[error(
        "the joint class \"{class}\" has cohesion or tensile strength, which films as strips do not have: leave them out, \
         or take another route"
    )]
    Strength {
        /// Name of the joint class.
        class: String,
    },
    /// The joint class has a stiffness of its own; films as strips have only the stiffness of their mortar.
    #[error(
        "the joint class \"{class}\" has a stiffness beside that of its mortar, which films as strips do not have: leave it \
         out, or take another route"
    )]
    Stiffness {
        /// Name of the joint class.
        class: String,
    },
    /// A film does not have two contact points between nodes, which films as strips need.
    #[error(
        "a film has no two contact points in strips between nodes: set `films = \"strips\"`, and let nodes of both faces \
         coincide, or lie farther apart"
    )]
    Points,
}

/// Solves a contact problem by the augmented Lagrangian method. The observer is called in every iteration; the
/// solution is cancelled if it returns `Break`.
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
