//! Settings of projected Gauss-Seidel.

use std::time::Duration;

use crate::settings::check_tolerance;
use crate::{Error, WarmStart};

/// Settings of [`ProjectedGaussSeidel`](crate::ProjectedGaussSeidel).
///
/// ```
/// use lcp::{ProjectedGaussSeidel, ProjectedGaussSeidelSettings};
/// let settings = ProjectedGaussSeidelSettings {
///     relaxation: 1.5,
///     ..ProjectedGaussSeidelSettings::default()
/// };
/// let solver = ProjectedGaussSeidel::new(settings);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct ProjectedGaussSeidelSettings {
    /// Largest residual, dimensionless, of a solution with status `Solved`. In `(0, 1)`. The default is `1e-8`: every
    /// further digit costs the same number of sweeps.
    pub tolerance: f64,
    /// Largest number of sweeps.
    pub max_iterations: usize,
    /// Wall-clock time, checked before every sweep; `None` sets no limit.
    pub time_limit: Option<Duration>,
    /// Start: zero, or the `z` of a point. A basis is refused, since it does not give the size of `z`.
    pub start: WarmStart,
    /// The over-relaxation `omega`, by which the diagonal is divided. In `(0, 2)`: outside of this interval the
    /// sweeps do not converge even for symmetric positive definite matrices.
    pub relaxation: f64,
}

impl Default for ProjectedGaussSeidelSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            max_iterations: 10_000,
            time_limit: None,
            start: WarmStart::None,
            relaxation: 1.0,
        }
    }
}

impl ProjectedGaussSeidelSettings {
    /// Checks the settings for a problem of `n` pairs.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        if !(self.relaxation > 0.0 && self.relaxation < 2.0) {
            let (name, value) = ("relaxation", self.relaxation);
            return Err(Error::Setting { name, value, range: "between 0 and 2" });
        }
        self.start.validate(n)
    }
}
