//! Settings of the choice.

use std::time::Duration;

use crate::settings::{check_count, check_tolerance};
use crate::{Error, WarmStart};

/// Settings of [`Auto`](crate::Auto).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct AutoSettings {
    /// Largest residual, dimensionless, of an answer called `Solved`. In `(0, 1)`. The same for every method.
    pub tolerance: f64,
    /// Wall-clock time of all methods together: each gets three quarters of the time that those before it have left,
    /// the last one all of it. `None` sets no limit: a method of the chain may then take long if those before it
    /// failed.
    pub time_limit: Option<Duration>,
    /// Attempts of Lemke's method, as in [`LemkeSettings::max_attempts`](crate::LemkeSettings::max_attempts).
    pub max_attempts: Option<usize>,
    /// A point or a basis, of the pairs of the general form, that may be the solution of a similar problem: a warm
    /// start for the methods that can use one.
    pub start: WarmStart,
}

impl Default for AutoSettings {
    fn default() -> Self {
        Self { tolerance: 1e-10, time_limit: None, max_attempts: None, start: WarmStart::None }
    }
}

impl AutoSettings {
    /// Checks the settings for a problem of `n` pairs.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        check_count("max_attempts", self.max_attempts)?;
        self.start.validate(n)
    }
}
