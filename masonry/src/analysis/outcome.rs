//! The result of a scene: displacements, contact forces, stresses, checks, times.

use nalgebra::Vector2;

pub use crate::data::info::{PhaseTime, RouteAttempt, RouteRecord, SoftReport, SolveInfo};
pub use crate::data::state::{
    ElementStress, FilmStress, PointState, PointStatus, Principal, Reaction, State,
};
use crate::data::verdict::{Judgement, Verdict};
use crate::history::{History, HistoryStep};
use crate::model::Model;
use crate::plan::Plan;
use crate::verify::checks::Checks;

/// Everything known about a scene after an attempt to solve it.
///
/// `state` and `checks` are `None` if no solution was found; all else is kept. If a step of the load history could not
/// be solved, `state` and `checks` are those of the previous step, and `solve` has the reason.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Outcome {
    /// Title of the scene.
    pub title: String,
    /// The model that was solved.
    pub model: Model,
    /// The effects and routes that were built, with reasons.
    pub plan: Plan,
    /// The record of the solution of the complementarity problem.
    pub solve: SolveInfo,
    /// The mechanical state, when solved.
    pub state: Option<State>,
    /// Balances and the friction cone, recomputed from the state.
    pub checks: Option<Checks>,
    /// The reaction of every support, when solved.
    pub reactions: Vec<Reaction>,
    /// The steps of the load history, if the solution depends on the load path.
    pub history: Option<History>,
    /// The collapse mechanism, if there is no solution and a mechanism was found along a secondary ray, on soft
    /// springs or by a proof: displacement rates of the corners of every block, scaled to a largest component of one.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// Whether the wall stands.
    pub judgement: Judgement,
    /// Time of every phase.
    pub times: Vec<PhaseTime>,
}

impl Outcome {
    /// Whether the structure stands, falls, or is undecided; [`judgement`](Self::judgement) has the evidence and the sentence.
    pub fn verdict(&self) -> Verdict {
        self.judgement.verdict
    }
}

/// The state after one step of a load history, for pictures.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Frame {
    /// The step.
    pub step: HistoryStep,
    /// The position of the step among all, from zero.
    pub position: usize,
    /// The model under the actions of the step.
    pub model: Model,
    /// The state.
    pub state: State,
}
