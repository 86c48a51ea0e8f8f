//! Settings of the convex quadratic program.

use std::time::Duration;

use crate::problem::check_epsilon;
use crate::settings::check_tolerance;
use crate::{Error, WarmStart};

/// Springs that hold the displacements of a contact problem while it is solved, and are then removed.
///
/// Every displacement has a spring of the stiffness given by [`Bedding`](crate::Bedding).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SoftConstraints {
    /// Stiffness of the springs, relative to that of the bodies. In `(0, 1]`.
    pub epsilon: f64,
    /// Largest number of re-centrings of the springs at the last solution.
    pub max_recentrings: usize,
}

impl Default for SoftConstraints {
    fn default() -> Self {
        Self { epsilon: 1e-4, max_recentrings: 50 }
    }
}

/// Settings of [`QuadraticProgram`](crate::QuadraticProgram).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct QuadraticProgramSettings {
    /// Largest residual, dimensionless, of a solution with status `Solved`. In `(0, 1)`. The exchange of states
    /// usually reaches 1e-14, so a tolerance of 1e-12 costs nothing.
    pub tolerance: f64,
    /// Largest number of iterations of one run of Clarabel's interior-point method, that is, within one program.
    /// These iterations are not in [`Info::iterations`](crate::Info::iterations), which counts programs, but among
    /// [`Info::factorisations`](crate::Info::factorisations). At least 1.
    pub max_iterations: usize,
    /// Largest number of rounds of the fixed-point iteration for Coulomb friction. Each is a program, as counted
    /// by [`Info::iterations`](crate::Info::iterations). At least 1.
    pub max_outer: usize,
    /// Wall-clock time, checked before every run of the interior-point method and before each of its iterations;
    /// `None` sets no limit.
    pub time_limit: Option<Duration>,
    /// A point or a basis, in the pairs of the general form, whose states are tried first.
    pub start: WarmStart,
    /// Springs for contact problems; `None` for no springs.
    pub soft: Option<SoftConstraints>,
}

impl Default for QuadraticProgramSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_iterations: 200,
            max_outer: 60,
            time_limit: None,
            start: WarmStart::None,
            soft: None,
        }
    }
}

impl QuadraticProgramSettings {
    /// Checks the settings for a problem with `n` pairs.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        for (name, count) in
            [("max_iterations", self.max_iterations), ("max_outer", self.max_outer)]
        {
            if count == 0 {
                return Err(Error::Setting { name, value: 0.0, range: "at least 1" });
            }
        }
        if let Some(soft) = self.soft {
            check_epsilon(soft.epsilon)?;
        }
        self.start.validate(n)
    }
}
