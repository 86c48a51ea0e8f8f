//! The result of a step, as used by everything after the routes.

use nalgebra::Vector2;

use super::checks::Checks;
use crate::data::info::SolveInfo;
use crate::data::state::State;
use crate::data::statics::Statics;
use crate::forms::Start;
use crate::history::energy::FrictionWork;
use crate::method::auto::Rank;
use crate::model::Model;

/// The result of a step of the load history, or of the only one.
#[derive(Debug)]
pub(crate) struct StepResult {
    pub(crate) info: SolveInfo,
    pub(crate) state: Option<State>,
    pub(crate) checks: Option<Checks>,
    /// A motion that no contact stops: displacement rates of the corners of every block.
    pub(crate) mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The decision on admissible forces, if it was made.
    pub(crate) statics: Option<Statics>,
    /// The end of a loading of rigid blocks at rest, if it was computed.
    pub(crate) loading: Option<LoadingEnd>,
    /// The last basis of the pivots, if it gives a state.
    pub(crate) basis: Option<Start>,
    /// The slip \[m\] of every contact point before the slip of the state, if a motion led to the state.
    pub(crate) moved: Option<Vec<f64>>,
    /// Works and energies on the way, if blocks moved.
    pub(crate) account: Option<lcp::Account>,
}

/// The end of a loading, from a state without stresses, of rigid blocks that are in equilibrium under some forces
/// within friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LoadingEnd {
    ToRest,
    ToFall,
    /// Neither rest nor a fall was found.
    Nowhere,
}

impl StepResult {
    /// A result without a state.
    pub(crate) fn new(info: SolveInfo) -> Self {
        Self {
            info,
            state: None,
            checks: None,
            mechanism: None,
            statics: None,
            loading: None,
            basis: None,
            moved: None,
            account: None,
        }
    }

    pub(crate) fn is_solved(&self) -> bool {
        self.info.status == lcp::Status::Solved && self.state.is_some()
    }

    pub(crate) fn rank(&self) -> Rank {
        Rank::of(&self.info, self.mechanism.is_some())
    }

    /// The work of friction in the step; `model` is that of the step.
    pub(crate) fn friction(&self, model: &Model) -> FrictionWork {
        match (&self.account, &self.state) {
            (Some(account), _) => FrictionWork::of_way(account),
            (None, Some(state)) => FrictionWork::of_step(model, &state.contacts),
            (None, None) => FrictionWork::default(),
        }
    }
}
