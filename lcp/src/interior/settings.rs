//! Settings of the interior-point method, and of evolutions.

use std::time::Duration;

use super::constants::{SMOOTH, STARTS};
use crate::settings::check_tolerance;
use crate::{Error, WarmStart};

/// Settings of [`InteriorPoint`](crate::InteriorPoint).
#[derive(Debug, Clone, PartialEq)]
pub struct InteriorPointSettings {
    /// Largest residual, dimensionless, of an answer called `Solved`. In `(0, 1)`.
    pub tolerance: f64,
    /// Steps, each with one factorisation; those of the continuation count too. The systems of the crossover
    /// come on top.
    pub max_iterations: usize,
    /// By which multiple of the largest gap a start is opened: one attempt for each, when the one before has jammed. From
    /// wide starts easy problems take half as many steps again, but hard ones jam less often. At least one, none negative.
    pub openings: Vec<f64>,
    /// Wall-clock time, looked at before every step; `None` is no limit.
    pub time_limit: Option<Duration>,
    /// A point or a basis, of the pairs of the general form, that may be the solution of a similar
    /// problem: before the first step the states of its contacts are tried.
    pub start: WarmStart,
    /// Whether the exact point on the boundary is looked for. Without it the answer is a point inside,
    /// which has no basis, and accuracy ends where Newton's method loses its digits, at about 1e-9.
    pub crossover: bool,
    /// Whether the method goes on with soft springs on all displacements where it jams.
    pub continuation: bool,
}

impl Default for InteriorPointSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_iterations: 300,
            openings: STARTS.to_vec(),
            time_limit: None,
            start: WarmStart::None,
            crossover: true,
            continuation: true,
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
        let is_good = |it: &f64| *it >= 0.0 && it.is_finite();
        if let Some(&value) = self.openings.iter().find(|it| !is_good(it)) {
            return Err(Error::Setting {
                name: "openings",
                value,
                range: "not negative and finite",
            });
        }
        if self.openings.is_empty() {
            return Err(Error::Setting {
                name: "openings",
                value: 0.0,
                range: "one number at least",
            });
        }
        self.start.validate(n)
    }
}

/// Settings of [`Evolution`](crate::Evolution).
#[derive(Debug, Clone, PartialEq)]
pub struct EvolutionSettings {
    /// Largest residual, dimensionless, of the state at rest. In `(0, 1)`.
    pub tolerance: f64,
    /// Steps of interior points in all motions together, each with one factorisation.
    pub max_iterations: usize,
    /// Wall-clock time, looked at before every step; `None` is no limit.
    pub time_limit: Option<Duration>,
    /// Whether rest is looked for without a motion first. Where supports move far it is seldom found so.
    pub at_once: bool,
    /// The parts by which the coefficients of friction are reduced, one after the other, where rest is looked for without a
    /// motion. In `(0, 1)`.
    pub reductions: Vec<f64>,
    /// The slips over which smooth friction turns, as parts of the largest displacement of the start: the first where rest is
    /// looked for first, and the next one, if there is any, whenever that has failed after a motion. With short ones friction
    /// is near to Coulomb's; long ones lead to rest nearly always, but to one that forces hold which no loading may lead to.
    pub slips: Vec<f64>,
}

impl Default for EvolutionSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_iterations: 1000,
            time_limit: None,
            at_once: true,
            reductions: Vec::new(),
            slips: SMOOTH.to_vec(),
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
        if let Some(&value) = self.reductions.iter().find(|it| !(**it > 0.0 && **it < 1.0)) {
            return Err(Error::Setting { name: "reductions", value, range: "between 0 and 1" });
        }
        if let Some(&value) = self.slips.iter().find(|slip| !(**slip > 0.0 && slip.is_finite())) {
            return Err(Error::Setting { name: "slips", value, range: "above 0 and finite" });
        }
        Ok(())
    }
}
