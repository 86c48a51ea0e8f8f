//! Settings of the interior-point method.

use std::time::Duration;

use super::constants::OPENINGS;
use crate::settings::check_tolerance;
use crate::{Error, WarmStart};

/// Settings of [`InteriorPoint`](crate::InteriorPoint).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct InteriorPointSettings {
    /// Largest residual, dimensionless, of an answer called `Solved`. In `(0, 1)`.
    pub tolerance: f64,
    /// Largest number of steps, each with one factorisation. The systems of the crossover are additional.
    pub max_iterations: usize,
    /// Multiples of the largest gap by which a start is opened: one attempt for each, when the one before has jammed.
    /// Easy problems take half as many steps again from wide starts, but hard ones jam less often. At least one, none
    /// negative.
    pub openings: Vec<f64>,
    /// Wall-clock time, checked before every step; `None` sets no limit.
    pub time_limit: Option<Duration>,
    /// A point or a basis, of the pairs of the general form, that may be the solution of a similar problem: the states
    /// of its contacts are tried before the first step.
    pub start: WarmStart,
    /// Whether the exact point on the boundary is searched. Without the crossover the answer is an interior point,
    /// which has no basis, and accuracy ends when Newton's method loses its digits, at about 1e-9. A
    /// [`MixedLcp`](crate::MixedLcp) of a convex program is then solved by the homogeneous problem, which needs neither
    /// start nor openings and gives proofs by itself.
    pub crossover: bool,
    /// Whether the existence of forces that balance the loads is tested if the method jams on bodies in contact.
    pub prove_infeasible: bool,
}

impl Default for InteriorPointSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_iterations: 300,
            openings: OPENINGS.to_vec(),
            time_limit: None,
            start: WarmStart::None,
            crossover: true,
            prove_infeasible: true,
        }
    }
}

impl InteriorPointSettings {
    /// Checks the settings for a problem of `n` pairs.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        let is_bad = |it: &f64| !(*it >= 0.0 && it.is_finite());
        let wrong = self.openings.iter().copied().find(is_bad);
        if let Some(value) = wrong.or_else(|| self.openings.is_empty().then_some(0.0)) {
            let range = "one number at least, each not negative and finite";
            return Err(Error::Setting { name: "openings", value, range });
        }
        self.start.validate(n)
    }
}
