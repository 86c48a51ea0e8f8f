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

/// The result of an attempt to solve a scene.
///
/// `state` and `checks` are `None` if no solution was found. If a step of the load history could not be solved, `state`
/// and `checks` are those of the previous step, and `solve` has the reason.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Outcome {
    /// Title of the scene.
    pub title: String,
    /// The model that was solved.
    pub model: Model,
    /// The effects and routes that were built, each with its reason.
    pub plan: Plan,
    /// The record of the solution of the complementarity problem: routes, status and residuals.
    pub solve: SolveInfo,
    /// The mechanical state; `None` if no solution was found.
    pub state: Option<State>,
    /// The balance of all blocks and the friction cones of all contacts, recomputed from the state.
    pub checks: Option<Checks>,
    /// The reaction of every support; empty if no solution was found.
    pub reactions: Vec<Reaction>,
    /// The steps of the load history; `None` for a scene of one step.
    pub history: Option<History>,
    /// The displacement rates of the corners of every block in the collapse mechanism, scaled to a largest component of
    /// one. `None` if there is a solution, or if no mechanism was found along a secondary ray, on soft springs or by a
    /// proof.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The verdict on the structure, with the evidence.
    pub judgement: Judgement,
    /// Wall-clock time of every phase of the analysis.
    pub times: Vec<PhaseTime>,
}

impl Outcome {
    /// Returns whether the structure stands, falls, or is undecided; the evidence is in [`judgement`](Self::judgement).
    pub fn verdict(&self) -> Verdict {
        self.judgement.verdict
    }
}

/// The state after one step of a load history, for pictures.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Frame {
    /// The step of the load history.
    pub step: HistoryStep,
    /// The index of the step among all steps of the scene, from zero.
    pub position: usize,
    /// The model under the actions of the step.
    pub model: Model,
    /// The mechanical state after the step.
    pub state: State,
}
