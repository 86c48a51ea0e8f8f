//! Settings of the pivoting method.

use crate::{Basis, Error};

/// The covering vector `d > 0` of the artificial variable, in the rows of the start basis.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Covering {
    /// All ones after equilibration, so that units do not matter.
    #[default]
    Ones,
    /// Pseudo-random entries between 1/8 and 8, by their logarithm, after equilibration.
    Random {
        /// Seed of the generator.
        seed: u64,
    },
    /// One positive entry for every pair, in units of the basic variable of the start basis. Where a
    /// given start basis is singular and replaced, all ones instead.
    Given(Vec<f64>),
}

/// Settings of [`Lemke`](crate::Lemke).
///
/// ```
/// use lcp::{Lemke, LemkeSettings};
/// let settings = LemkeSettings { tolerance: 1e-12, ..LemkeSettings::default() };
/// let solver = Lemke::new(settings);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LemkeSettings {
    /// Largest residual, dimensionless, of an answer called `Solved`. In `(0, 1)`.
    pub tolerance: f64,
    /// Pivots of one attempt; `None` is `100 n + 1000`.
    pub max_pivots: Option<usize>,
    /// Attempts, each with another covering vector or start basis, before a ray is reported. At
    /// least 1.
    pub max_attempts: usize,
    /// Covering vector of the first attempt.
    pub covering: Covering,
    /// Complementary basis to start from; `None` lets the solver find one. A singular one is
    /// replaced by one that the solver finds.
    pub start: Option<Basis>,
}

impl Default for LemkeSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_pivots: None,
            max_attempts: 8,
            covering: Covering::Ones,
            start: None,
        }
    }
}

impl LemkeSettings {
    /// Checks the settings for a problem of order `n`.
    ///
    /// # Errors
    /// [`Error::Setting`] or [`Error::Length`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        let tolerance = self.tolerance;
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let range = "between 0 and 1";
            return Err(Error::Setting { name: "tolerance", value: tolerance, range });
        }
        if self.max_attempts == 0 {
            return Err(Error::Setting { name: "max_attempts", value: 0.0, range: "at least 1" });
        }
        if let Some(basis) = &self.start
            && basis.len() != n
        {
            return Err(Error::Length { name: "start", len: basis.len(), expected: n });
        }
        if let Covering::Given(d) = &self.covering {
            if d.len() != n {
                return Err(Error::Length { name: "covering", len: d.len(), expected: n });
            }
            if let Some(&value) = d.iter().find(|&&d| !(d > 0.0 && d.is_finite())) {
                let range = "positive and finite in every entry";
                return Err(Error::Setting { name: "covering", value, range });
            }
        }
        Ok(())
    }
}
