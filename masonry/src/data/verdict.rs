//! The verdict on a structure: whether it stands, falls or is undecided, with the evidence.

use serde::Serialize;

/// The verdict on a structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The structure stands.
    Stands,
    /// The structure falls.
    Falls,
    /// Neither an equilibrium nor a failure was found.
    Undecided,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Debug::fmt(self, f)
    }
}

/// The kind of evidence for a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[non_exhaustive]
pub enum Evidence {
    /// An equilibrium that is verified by its residuals and by the balance of every block.
    #[serde(rename = "equilibrium")]
    Equilibrium,
    /// Forces within friction that balance the loads, which are sufficient only for rigid blocks at rest.
    #[serde(rename = "admissible forces")]
    AdmissibleForces,
    /// A checked proof that no forces within friction balance the loads.
    #[serde(rename = "no admissible forces")]
    NoAdmissibleForces,
    /// A slow motion under the loads that does not come to rest. If forces within friction balance the loads, the
    /// motion does not prove that the structure falls under every order of loading.
    #[serde(rename = "motion")]
    Motion,
    /// No evidence was found.
    #[serde(rename = "none")]
    None,
}

/// A verdict with its evidence and explanation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Judgement {
    /// The verdict: the structure stands, falls, or is undecided.
    pub verdict: Verdict,
    /// The kind of evidence for the verdict.
    pub evidence: Evidence,
    /// The verdict and the evidence in one sentence, including the last step that was reached in a load history.
    pub sentence: String,
    /// Warnings about limitations of the result.
    pub warnings: Vec<String>,
}
