//! The result of one step, as used by everything after the routes.

use nalgebra::Vector2;

use super::checks::Checks;
use crate::data::info::SolveInfo;
use crate::data::state::State;
use crate::data::statics::Statics;
use crate::forms::Start;
use crate::history::energy::FrictionWork;
use crate::method::auto::Rank;
use crate::model::Model;

/// The result of a step of a load history, or of the only step of a scene without history.
#[derive(Debug)]
pub(crate) struct StepResult {
    pub(crate) info: SolveInfo,
    pub(crate) state: Option<State>,
    pub(crate) checks: Option<Checks>,
    /// A motion that no contact stops, as displacement rates of the corners of every block; `None` if there is no such
    /// motion.
    pub(crate) mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The decision whether admissible forces exist; `None` if it was not made.
    pub(crate) statics: Option<Statics>,
    /// The end of a loading of rigid blocks at rest; `None` if it was not computed.
    pub(crate) loading: Option<LoadingEnd>,
    /// The last basis of the pivoting method; `None` if it does not give a state.
    pub(crate) basis: Option<Start>,
    /// The slip \[m\] of every contact point before the slip of the state; `None` unless a motion led to the state.
    pub(crate) moved: Option<Vec<f64>>,
    /// Works and energies during the motion that led to the state; `None` if blocks did not move.
    pub(crate) account: Option<lcp::Account>,
}

/// The end of a loading of rigid blocks from a state without stresses; these blocks are in equilibrium under some
/// forces within friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LoadingEnd {
    ToRest,
    ToFall,
    /// Neither a state of rest nor a fall was found.
    Nowhere,
}

impl StepResult {
    /// Makes a result without a state.
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

    /// Returns the work of friction in the step; `model` is the model of this step.
    pub(crate) fn friction(&self, model: &Model) -> FrictionWork {
        match (&self.account, &self.state) {
            (Some(account), _) => FrictionWork::of_way(account),
            (None, Some(state)) => FrictionWork::of_step(model, &state.contacts),
            (None, None) => FrictionWork::default(),
        }
    }
}
