//! One effect of a plan.

use serde::Serialize;

/// One physical effect, on or off, and the reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Name of the effect, such as `friction`.
    pub name: &'static str,
    /// Whether it is built.
    pub on: bool,
    /// What in the scene calls for it, or what is missing.
    pub because: String,
    /// What the effect adds to the [`order`](super::Plan::order) of the plan, contact points being the same: on the pivoting
    /// route displacements are eliminated, and add nothing.
    pub unknowns: usize,
    /// What it is expected to cost on the first route, in words: `none` where it is off.
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
