//! From a scene to an outcome: every stage in order, each timed.
//!
//! scene -> model -> plan -> system -> reduction or sparse form -> route -> recovery -> checks; from the
//! reduction on, once for every step of the load history.

mod chain;
mod run;
mod spread;

use std::ops::ControlFlow;
use web_time::Instant;

pub use run::Run;

use crate::analysis::checkpoint::CheckpointError;
use crate::analysis::outcome::Outcome;
use crate::data::info::PhaseTime;
use crate::method::RouteError;
use crate::model::Model;
use crate::plan::TooLarge;
use crate::scene::{Route, Scene, SceneError};
use crate::system::SystemError;
use crate::system::rigid::{FreeMotion, RigidError};

/// Why a scene could not be solved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A block cannot be assembled.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A block can move although no contact changes.
    #[error(
        "block \"{block}\" can {motion} without changing a gap or sliding against friction \
         (free motions in all: {free}): let it touch its neighbours or a support, or give its \
         joints friction"
    )]
    Free {
        /// Name of the block that moves most.
        block: String,
        /// How it moves.
        motion: FreeMotion,
        /// Number of independent motions that nothing resists.
        free: usize,
    },
    /// The matrices would need too much memory.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The solver refused its settings or the data.
    #[error("the complementarity problem was refused: {0}")]
    Solver(#[from] lcp::Error),
    /// A route that cannot treat the structure.
    #[error("{} cannot treat this problem: {reason}", .route.name())]
    NotTreated {
        /// The route.
        route: Route,
        /// The reason, and what to use instead.
        reason: String,
    },
    /// A later step of the load history could not be solved; the steps before it are kept.
    #[error("step {step} of stage \"{stage}\": {error}")]
    Step {
        /// Name of the stage.
        stage: String,
        /// The step in it, from 1.
        step: usize,
        /// The error.
        #[source]
        error: Box<SolveError>,
    },
    /// A checkpoint does not fit.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

impl From<RouteError> for SolveError {
    fn from(error: RouteError) -> Self {
        match error {
            RouteError::Solver(error) => Self::Solver(error),
            RouteError::NotTreated { route, reason } => Self::NotTreated { route, reason },
        }
    }
}

impl SolveError {
    /// Whether a route does not treat the problem, so that another one may.
    pub fn is_refusal(&self) -> bool {
        matches!(self, Self::NotTreated { .. } | Self::Solver(lcp::Error::NotTreated { .. }))
    }
}

/// How far a solve has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// A step of the load history begins.
    Step {
        /// The step, from 1.
        number: usize,
        /// The steps of the scene.
        of: usize,
    },
    /// A phase begins.
    Phase(&'static str),
    /// The solver pivots.
    Pivots(lcp::lemke::Progress),
    /// The solver iterates.
    Iteration {
        /// Steps, programs or re-centrings of springs so far.
        number: usize,
        /// The residual by which the solver stops.
        residual: f64,
    },
}

/// Solves a scene.
///
/// ```
/// use masonry::scene::{Block, Joint, Material, Scene, Support};
/// use masonry::analysis::solve::solve;
/// use masonry::units::Units;
///
/// let scene = Scene::new("One block on a floor", Units::SI)
///     .thickness(1.0)
///     .gravity([0.0, -10.0])
///     .material("stone", Material::rigid().density(1000.0))
///     .joint("floor", Joint::mu(0.7))
///     .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
///     .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"));
/// let outcome = solve(&scene)?;
/// assert!((outcome.reactions[0].fy - 2000.0).abs() < 1e-9);
/// # Ok::<(), masonry::analysis::solve::SolveError>(())
/// ```
///
/// # Errors
/// [`SolveError`] when the scene is wrong. When the scene is right but no equilibrium was found,
/// the outcome says so in [`SolveInfo::status`](crate::analysis::outcome::SolveInfo::status).
pub fn solve(scene: &Scene) -> Result<Outcome, SolveError> {
    solve_observed(scene, &mut |_| ControlFlow::Continue(()))
}

/// Solves a scene and reports its progress to an observer; `Break` cancels the solve.
///
/// # Errors
/// As [`solve`].
pub fn solve_observed(
    scene: &Scene,
    observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
) -> Result<Outcome, SolveError> {
    let mut run = Run::new(scene, observer)?;
    while run.advance(observer)? {}
    run.compare(scene, observer)?;
    Ok(run.finish())
}

fn named(error: RigidError, model: &Model) -> SolveError {
    let RigidError::Free { block, motion, free } = error;
    SolveError::Free { block: model.blocks[block].name.clone(), motion, free }
}

#[derive(Debug, Default)]
struct Clock {
    times: Vec<PhaseTime>,
}

impl Clock {
    fn time<T>(
        &mut self,
        phase: &'static str,
        observer: &mut dyn FnMut(Event) -> ControlFlow<()>,
        work: impl FnOnce() -> T,
    ) -> T {
        // Only the solver is long enough to be cancelled.
        let _ = observer(Event::Phase(phase));
        let began = Instant::now();
        let result = work();
        self.add(phase, began);
        result
    }

    fn add(&mut self, phase: &str, began: Instant) {
        let seconds = began.elapsed().as_secs_f64();
        // Several routes solve and recover.
        match self.times.iter_mut().find(|time| time.phase == phase) {
            Some(time) => time.seconds += seconds,
            None => self.times.push(PhaseTime { phase: phase.to_owned(), seconds }),
        }
    }
}
