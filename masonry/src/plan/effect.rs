//! One effect of a plan.

use serde::Serialize;

/// One physical effect, on or off, and the reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Name of the effect, such as `friction`.
    pub name: &'static str,
    /// Whether it is built.
    pub on: bool,
    /// The reason in the scene why the effect is on or off.
    pub because: String,
    /// What the effect adds to the [`order`](super::Plan::order) of the plan, contact points being the same: on the pivoting
    /// route displacements are eliminated, and add nothing.
    pub unknowns: usize,
    /// The expected cost on the first route, in words: `none` if the effect is off.
    pub cost: String,
}

impl Effect {
    pub(super) fn off(name: &'static str, because: String) -> Self {
        Self { name, on: false, because, unknowns: 0, cost: "none".to_owned() }
    }

    /// An effect that adds no unknowns.
    pub(super) fn on(name: &'static str, because: String, cost: String) -> Self {
        Self { name, on: true, because, unknowns: 0, cost }
    }
}
