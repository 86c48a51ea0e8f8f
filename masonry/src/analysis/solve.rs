//! The solution of a scene, from the scene to its outcome: every phase in order, each timed.
//!
//! scene -> model -> plan -> system -> reduction or sparse form -> route -> recovery -> checks. The phases from the
//! reduction on are repeated for every step of the load history.

mod chain;
mod run;
mod spread;

use std::ops::ControlFlow;

pub use crate::method::Event;
pub use run::Run;

use crate::analysis::checkpoint::CheckpointError;
use crate::analysis::outcome::Outcome;
use crate::model::Model;
#[cfg(feature = "paper")]
use crate::paper::alm::AlmError;
use crate::plan::TooLarge;
use crate::scene::{Route, Scene, SceneError};
use crate::system::SystemError;
use crate::system::rigid::{FreeMotion, RigidError};

/// The reasons for which a scene could not be solved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The equations of a block cannot be assembled.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A block can move without any change at its contacts.
    #[error(
        "block \"{block}\" can {motion} without changing a gap or sliding against friction \
         (free motions in all: {free}): let it touch its neighbours or a support, or give its \
         joints friction"
    )]
    Free {
        /// Name of the block that moves most.
        block: String,
        /// The motion of this block.
        motion: FreeMotion,
        /// Number of independent motions of all blocks that nothing resists.
        free: usize,
    },
    /// The matrices of the analysis would need more memory than the machine has.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The solver refused its settings or the data.
    #[error("the complementarity problem was refused: {0}")]
    Solver(#[from] lcp::Error),
    /// The route cannot treat a structure of this kind.
    #[error("{} cannot treat this problem: {reason}", .route.name())]
    NotTreated {
        /// The route that refused the structure.
        route: Route,
        /// The reason for which the route refused the structure, and an alternative.
        reason: String,
    },
    /// A step of the load history after the first could not be solved; the steps before it are kept.
    #[error("step {step} of stage \"{stage}\": {error}")]
    Step {
        /// Name of the stage of the step.
        stage: String,
        /// Number of the step in the stage, from 1.
        step: usize,
        /// The error of the step.
        #[source]
        error: Box<SolveError>,
    },
    /// The checkpoint cannot be continued with this scene.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
}

#[cfg(feature = "paper")]
impl From<AlmError> for SolveError {
    fn from(error: AlmError) -> Self {
        match error {
            AlmError::Tolerance { tolerance } => {
                let range = "in (0, 1)";
                lcp::Error::Setting { name: "tolerance", value: tolerance, range }.into()
            }
            AlmError::Data(error) => error.into(),
            other => Self::NotTreated { route: Route::Alm, reason: other.to_string() },
        }
    }
}

impl SolveError {
    /// Whether a route refused the problem, so that another route may treat it.
    pub fn is_refusal(&self) -> bool {
        matches!(self, Self::NotTreated { .. } | Self::Solver(lcp::Error::NotTreated { .. }))
    }
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
/// [`SolveError`] if the scene is wrong. If the scene is right but no equilibrium was found, there is no error, and
/// [`SolveInfo::status`](crate::analysis::outcome::SolveInfo::status) is not `Solved`.
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
