//! Settings of evolutions.

use std::time::Duration;

use crate::Error;
use crate::settings::check_tolerance;

/// Settings of [`Evolution`](crate::Evolution).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct EvolutionSettings {
    /// Largest residual, dimensionless, of every step and of the state at rest. In `(0, 1)`.
    pub tolerance: f64,
    /// The drag `c` [1/time]: the force `-c M v` acts on a body of the mass `M` with the velocity `v`. At least zero,
    /// and above zero without inertia.
    pub drag: f64,
    /// Whether bodies have inertia. Bodies without inertia come to rest as soon as nothing moves them any more.
    pub inertia: bool,
    /// The largest displacement for which the problem is valid: beyond it [`advance`](crate::Evolution::advance) and
    /// [`settle`](crate::Evolution::settle) end with [`Ending::Left`](crate::Ending::Left), and no state counts as
    /// rest.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub reach: f64,
    /// Largest number of factorisations of one call; a step that reaches it is completed.
    pub max_iterations: usize,
    /// Wall-clock time of one call, checked before every step and every iteration of its path; `None` sets no limit.
    pub time_limit: Option<Duration>,
}

impl Default for EvolutionSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            drag: 1.0,
            inertia: false,
            reach: f64::INFINITY,
            max_iterations: 4000,
            time_limit: None,
        }
    }
}

impl EvolutionSettings {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] with the name of the setting.
    pub fn validate(&self) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        let least = if self.inertia { 0.0 } else { f64::MIN_POSITIVE };
        if !(self.drag >= least && self.drag.is_finite()) {
            let range = "at least 0 and finite, and above 0 without inertia";
            return Err(Error::Setting { name: "drag", value: self.drag, range });
        }
        if self.reach > 0.0 {
            return Ok(());
        }
        Err(Error::Setting { name: "reach", value: self.reach, range: "above 0" })
    }
}
