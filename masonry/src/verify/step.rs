//! The result of a step, as everything after the routes has it.

use nalgebra::Vector2;

use super::checks::Checks;
use crate::data::info::SolveInfo;
use crate::data::state::State;
use crate::data::statics::Statics;

/// What came out of a step of the load history, or of the only one.
#[derive(Debug)]
pub(crate) struct StepResult {
    pub(crate) info: SolveInfo,
    pub(crate) state: Option<State>,
    pub(crate) checks: Option<Checks>,
    /// A motion that nothing stops: displacement rates of the corners of every block.
    pub(crate) mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The decision on admissible forces, if it was made.
    pub(crate) statics: Option<Statics>,
    /// Where loading leads rigid blocks at rest, if that was asked.
    pub(crate) loading: Option<LoadingEnd>,
}

/// Where loading from a state without stresses leads rigid blocks that some forces within friction would hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LoadingEnd {
    ToRest,
    ToFall,
    /// Neither came out.
    Nowhere,
}

impl StepResult {
    /// A result without a state.
    pub(crate) fn new(info: SolveInfo) -> Self {
        Self { info, state: None, checks: None, mechanism: None, statics: None, loading: None }
    }

    pub(crate) fn is_solved(&self) -> bool {
        self.info.status == lcp::Status::Solved && self.state.is_some()
    }
}
