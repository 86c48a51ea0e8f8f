//! A verdict: whether a wall stands, falls or is undecided, with the evidence.

use serde::Serialize;

/// Whether a wall stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The wall stands.
    Stands,
    /// The wall falls.
    Falls,
    /// Neither an equilibrium nor a failure was found.
    Undecided,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Debug::fmt(self, f)
    }
}

/// The evidence of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[non_exhaustive]
pub enum Evidence {
    /// An equilibrium, verified by its residuals and the balance of every block.
    #[serde(rename = "equilibrium")]
    Equilibrium,
    /// Forces within friction that balance the loads: sufficient for rigid blocks at rest only.
    #[serde(rename = "admissible forces")]
    AdmissibleForces,
    /// A checked proof that there are no such forces.
    #[serde(rename = "no admissible forces")]
    NoAdmissibleForces,
    /// A slow motion under the loads that does not come to rest. The motion does not prove that the
    /// wall falls under every order of loading if forces within friction balance the loads.
    #[serde(rename = "motion")]
    Motion,
    /// No evidence.
    #[serde(rename = "none")]
    None,
}

/// A verdict with its evidence and explanation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Judgement {
    /// The verdict.
    pub verdict: Verdict,
    /// The evidence.
    pub evidence: Evidence,
    /// Verdict and evidence in one sentence; for a load history also the last step that was reached.
    pub sentence: String,
    /// Limitations of the result.
    pub warnings: Vec<String>,
}
