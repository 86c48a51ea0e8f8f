//! The augmented Lagrangian route (3.10)-(3.17), the paper's competitor of pivoting.
//!
//! Every iteration solves one linear system for the present contact forces, the multipliers, and projects the
//! forces that come out on the friction cone:
//!
//! ```text
//! ( K + delta D + sum rho_i C_i^T C_i ) u = f + delta D u_old + C^T (t - rho x),     D = diag K
//! t_n <- [t_n - rho_n y_n]+ ,     t_t <- projection of t_t - rho_t y_t on [-mu t_n, mu t_n]
//! ```
//!
//! The sum goes over the contacts that are closed, along the tangent over those that stick; it holds
//! blocks that float, so that the matrix changes with the states of the contacts only. Blocks without any
//! closed contact are held by the proximal term `delta`, without which they would fly off and come back
//! with huge forces; it vanishes with the steps. The penalties `rho` follow from the stiffness that the contact sees,
//! and are made smaller where the iteration diverges or comes to rest.
//!
//! The unbalanced force is what the last step left over, and convergence is linear: the solution may be many such
//! steps away. So an answer is called solved when, besides, the rate at which the steps shrink says that displacements
//! and forces are near.

mod contraction;
mod matrices;
mod route;

use std::ops::ControlFlow;

use contraction::Contraction;
use lcp::{Contact2d, ContactState, Residuals, Status};
use matrices::{Contact, Matrices, Structure};
pub use route::Multipliers;
use serde::Serialize;

/// Penalty of a contact, relative to the stiffness that it sees.
const PENALTY: f64 = 0.3;
/// The proximal term, relative to the stiffness.
const PROXIMAL: f64 = 1e-2;
/// Where the unbalanced force grows by this factor over the smallest, the iteration diverges.
const DIVERGED: f64 = 1e3;
/// So many iterations without a reduction of it by a tenth are no progress.
const PATIENCE: usize = 300;
/// After that penalty and proximal term change by this factor, so many times.
const SOFTER: f64 = 3.0;
const ATTEMPTS: usize = 4;

/// What the route is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Largest unbalanced force, relative to the loads, largest residual, and largest estimated error of
    /// displacements and forces, relative to the largest of them, of an answer called solved \[-\].
    pub tolerance: f64,
    /// Iterations of all attempts.
    pub max_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-8, max_iterations: 2000 }
    }
}

/// One iteration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Iteration {
    /// The attempt, from 1.
    pub attempt: usize,
    /// Largest unbalanced force after the projection, relative to the largest load \[-\].
    pub unbalance: f64,
    /// Estimate of the distance from the solution, of displacements and of the forces in the blocks, relative
    /// to the largest of them or what the loads alone would make \[-\]; infinite until the iteration contracts.
    pub distance: f64,
    /// Contacts that changed their state.
    pub changes: usize,
}

/// What the route found.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Answer {
    /// `Solved`, `IterationLimit`, `Stalled` where every attempt diverged or came to rest, or `Cancelled`.
    pub status: Status,
    /// Displacements and contact forces of the best iteration.
    pub state: ContactState,
    /// Its residuals, from the data.
    pub residuals: Residuals,
    /// Every iteration.
    pub history: Vec<Iteration>,
    /// Numeric factorisations; the symbolic one is done once.
    pub factorisations: usize,
}

/// Why the route cannot treat a problem.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AlmError {
    /// Some displacement meets no stiffness.
    #[error(
        "displacement {displacement} meets no stiffness, as those of rigid blocks, and penalties follow from \
         it: give the block an elastic modulus or take another route"
    )]
    NoStiffness {
        /// The displacement, from 0.
        displacement: usize,
    },
    /// A setting outside its range.
    #[error("tolerance is {tolerance}, but must be between 0 and 1")]
    Tolerance {
        /// The value.
        tolerance: f64,
    },
    /// The sparse factors do not fit into memory, or `K` has a negative mode.
    #[error("the stiffness cannot be factorised: {0}")]
    Factorisation(String),
}

/// Solves a contact problem; the observer is told every iteration, and `Break` cancels.
///
/// ```
/// use faer::mat;
/// use lcp::Contact2d;
/// use masonry::routes::alm::{self, Settings};
/// // A body of weight 2 on springs, pressed on a plane (mu = 0.5) and pushed by 1.4: it slides
/// let contact = Contact2d::new(
///     mat![[4.0, 0.0], [0.0, 4.0]], vec![1.4, -2.0],
///     mat![[0.0, 1.0]], mat![[1.0, 0.0]], vec![0.0], vec![0.0], vec![0.5],
/// )?;
/// let answer = alm::solve(&contact, &Settings::default(), &mut |_| std::ops::ControlFlow::Continue(()))?;
/// assert_eq!(answer.status, lcp::Status::Solved);
/// assert!((answer.state.t_t[0] + 1.0).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`AlmError`] for a tolerance out of range and for structures with rigid blocks.
pub fn solve(
    problem: &Contact2d,
    settings: &Settings,
    observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
) -> Result<Answer, AlmError> {
    let tolerance = settings.tolerance;
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(AlmError::Tolerance { tolerance });
    }
    let structure = Structure::new(problem)?;
    let mut run = Run {
        structure: &structure,
        settings,
        history: Vec::new(),
        factorisations: 0,
        best: Best::rest(problem),
    };
    let mut status = Status::Stalled;
    for attempt in 1..=ATTEMPTS {
        let softer = SOFTER.powi(i32::try_from(attempt).unwrap_or(i32::MAX) - 1);
        let matrices = Matrices::new(&structure, PENALTY / softer, PROXIMAL * softer)?;
        status = run.attempt(attempt, &matrices, observer)?;
        if status != Status::Stalled {
            break;
        }
    }
    let Run { history, factorisations, best, .. } = run;
    let residuals = problem.residuals(&best.state);
    Ok(Answer { status, state: best.state, residuals, history, factorisations })
}

/// The iteration with the smallest measure.
struct Best {
    state: ContactState,
    measure: f64,
}

impl Best {
    fn rest(problem: &Contact2d) -> Self {
        let (n, m) = (problem.displacements(), problem.points());
        let state = problem.state(vec![0.0; n], vec![0.0; m], vec![0.0; m]);
        Self { state, measure: f64::INFINITY }
    }
}

/// A solve in progress.
struct Run<'a> {
    structure: &'a Structure<'a>,
    settings: &'a Settings,
    history: Vec<Iteration>,
    factorisations: usize,
    best: Best,
}

impl Run<'_> {
    /// Iterates from all contacts closed.
    fn attempt(
        &mut self,
        attempt: usize,
        matrices: &Matrices<'_>,
        observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
    ) -> Result<Status, AlmError> {
        let problem = self.structure.problem;
        let mut at = Best::rest(problem).state;
        let mut contacts = vec![Contact::Stick; problem.points()];
        let mut factors = None;
        let (mut least, mut since) = (f64::INFINITY, 0);
        let [mut motion, mut pull] = self.structure.units().map(Contraction::new);
        let mut forces = vec![0.0; problem.displacements()];
        while self.history.len() < self.settings.max_iterations {
            let present = if let Some(present) = factors.take() {
                present
            } else {
                self.factorisations += 1;
                matrices.factorised(&contacts)?
            };
            let u = matrices.displacements(&present, &contacts, &at);
            let trial = problem.state(u, at.t_n, at.t_t);
            let (t_n, t_t, next) = matrices.projected(&trial);
            let changes = contacts.iter().zip(&next).filter(|(a, b)| a != b).count();
            if changes == 0 {
                factors = Some(present);
            }
            contacts = next;
            motion.record(&at.u, &trial.u);
            at = problem.state(trial.u, t_n, t_t);
            let pulled = self.structure.block_forces(&at.u);
            pull.record(&forces, &pulled);
            forces = pulled;
            let unbalance = self.structure.unbalance(&at, &forces);
            let distance = motion.remaining().max(pull.remaining());
            let iteration = Iteration { attempt, unbalance, distance, changes };
            self.history.push(iteration);
            let residual = problem.residuals(&at).worst().max(self.structure.slack(&at, &forces));
            let measure = unbalance.max(residual).max(distance);
            if measure < self.best.measure {
                self.best = Best { state: at.clone(), measure };
            }
            let is_cancelled = observer(&iteration).is_break();
            if measure <= self.settings.tolerance {
                return Ok(Status::Solved);
            }
            if is_cancelled {
                return Ok(Status::Cancelled);
            }
            since = if unbalance < 0.9 * least { 0 } else { since + 1 };
            least = if since == 0 { unbalance } else { least };
            if unbalance > DIVERGED * least || !unbalance.is_finite() || since > PATIENCE {
                return Ok(Status::Stalled);
            }
        }
        Ok(Status::IterationLimit)
    }
}
