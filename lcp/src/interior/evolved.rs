//! Where bodies are that have moved, and how they came there.

use crate::{ContactState, SoftSprings, Solution};

/// How bodies came to where they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case")
)]
#[non_exhaustive]
pub enum Way {
    /// The state solves the problem as given: Coulomb's law for the slips of the whole step.
    Law,
    /// Coulomb's law for the slips of the whole step, with coefficients of friction that are slightly smaller.
    ReducedFriction,
    /// Coulomb's law with friction that turns over a short slip.
    SmoothFriction,
    /// Motions against viscosity.
    Motion,
}

impl Way {
    /// A name for files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Law => "law",
            Self::ReducedFriction => "reduced-friction",
            Self::SmoothFriction => "smooth-friction",
            Self::Motion => "motion",
        }
    }
}

/// Where the bodies are after an [`Evolution`](crate::Evolution).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Evolved {
    /// How they came there.
    pub way: Way,
    /// The displacements from which the slips of the solution are measured; `None` where they are those of the problem.
    pub from: Option<Vec<f64>>,
    /// The solution of the problem [after](crate::Contact2d::after) `from`, where the bodies rest.
    pub solution: Solution,
    /// By motion the viscosity, in units of the equilibrated problem, and its share of the loads.
    pub motions: SoftSprings,
}

impl Evolved {
    /// The displacements, forces, gaps and slips where the bodies are.
    pub fn state(&self) -> &ContactState {
        self.solution.contact.as_ref().unwrap_or_else(|| unreachable!("a contact problem has one"))
    }

    /// Whether the bodies have come to rest.
    pub fn rests(&self) -> bool {
        self.solution.is_solved()
    }
}
