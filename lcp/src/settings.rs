//! Settings of Lemke's method.

use std::time::Duration;

use crate::vector::{check_length, check_vector};
use crate::{Basis, Error};

/// The covering vector `d > 0` of the artificial variable, in the rows of the start basis; zero in rows of free
/// variables, which may be negative.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Covering {
    /// All ones after equilibration, so that units do not matter.
    #[default]
    Ones,
    /// Pseudo-random entries between 1/8 and 8, by their logarithm, after equilibration.
    Random {
        /// Seed of the generator.
        seed: u64,
    },
    /// One positive entry for every pair, in units of the basic variable of the start basis. All ones are used
    /// instead if a given start basis is singular and replaced.
    Given(Vec<f64>),
}

/// Start of a method, in the pairs of the general form of the problem, which are also the pairs of its solutions: any
/// solution may be the start of another method. The description of a basis here is for [`Lemke`](crate::Lemke); the
/// settings of the other methods describe their use of a start.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum WarmStart {
    /// No start is given: the method finds its own.
    #[default]
    None,
    /// A complementary basis. If it is singular, the start is a basis that shares as many of its columns as possible.
    Basis(Basis),
    /// A point, for instance the solution of a similar problem. Its basis has the larger variable of every pair,
    /// relative to the largest entry of its vector.
    Point {
        /// The first variable of every pair.
        t: Vec<f64>,
        /// The second variable of every pair.
        y: Vec<f64>,
    },
}

/// Settings of [`Lemke`](crate::Lemke).
///
/// ```
/// use lcp::{Lemke, LemkeSettings};
/// let settings = LemkeSettings { tolerance: 1e-12, ..LemkeSettings::default() };
/// let solver = Lemke::new(settings);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct LemkeSettings {
    /// Largest residual, dimensionless, of a solution with status `Solved`. In `(0, 1)`.
    pub tolerance: f64,
    /// Largest number of pivots of one attempt, not of all together; `None` is `100 n + 1000`.
    pub max_pivots: Option<usize>,
    /// Wall-clock time of all attempts together, checked before every pivot; `None` sets no limit.
    pub time_limit: Option<Duration>,
    /// Largest number of attempts, each with another covering vector or start basis, before a ray is reported. At
    /// least 1; `None` allows as many as some seconds suffice for, at least twelve, and no more than there are
    /// complementary bases.
    pub max_attempts: Option<usize>,
    /// Covering vector of the first attempt.
    pub covering: Covering,
    /// Start of the first attempt.
    pub start: WarmStart,
    /// Whether the first ray is followed by a search for a proof that there is no solution, by the simplex method. If
    /// not, the status is [`Infeasible`](crate::Status::Infeasible) only if there is no complementary basis and the
    /// right-hand side is outside the span of all columns.
    pub prove_infeasible: bool,
    /// Whether [`Solution::trace`](crate::Solution::trace) records every pivot.
    pub trace: bool,
}

impl Default for LemkeSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            max_pivots: None,
            time_limit: None,
            max_attempts: None,
            covering: Covering::Ones,
            start: WarmStart::None,
            prove_infeasible: true,
            trace: false,
        }
    }
}

/// Checks the tolerance, a setting of every method.
pub(crate) fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if tolerance > 0.0 && tolerance < 1.0 {
        return Ok(());
    }
    Err(Error::Setting { name: "tolerance", value: tolerance, range: "between 0 and 1" })
}

/// Checks a number that must not be zero.
pub(crate) fn check_count(name: &'static str, count: Option<usize>) -> Result<(), Error> {
    if count == Some(0) {
        return Err(Error::Setting { name, value: 0.0, range: "at least 1" });
    }
    Ok(())
}

impl WarmStart {
    /// The start of a problem with these pairs of another problem, whose variables may be exchanged.
    pub(crate) fn of_pairs(&self, pairs: impl Iterator<Item = (usize, bool)>) -> Self {
        match self {
            Self::None => Self::None,
            Self::Basis(basis) => Self::Basis(basis.of_pairs(pairs)),
            Self::Point { t, y } => {
                let values = |(pair, is_exchanged): (usize, bool)| {
                    let (first, second) = if is_exchanged { (y, t) } else { (t, y) };
                    (first[pair], second[pair])
                };
                let (t, y) = pairs.map(values).unzip();
                Self::Point { t, y }
            }
        }
    }

    /// Checks a start for a problem of `n` pairs.
    pub(crate) fn validate(&self, n: usize) -> Result<(), Error> {
        match self {
            Self::None => Ok(()),
            Self::Basis(basis) => check_length("start", basis.len(), n),
            Self::Point { t, y } => {
                for (name, v) in [("start.t", t), ("start.y", y)] {
                    check_length(name, v.len(), n)?;
                    check_vector(name, v)?;
                }
                Ok(())
            }
        }
    }
}

impl LemkeSettings {
    /// Checks the settings for a problem of order `n`.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        check_count("max_attempts", self.max_attempts)?;
        self.start.validate(n)?;
        if let Covering::Given(d) = &self.covering {
            check_length("covering", d.len(), n)?;
            if let Some(&value) = d.iter().find(|&&d| !(d > 0.0 && d.is_finite())) {
                let range = "positive and finite in every entry";
                return Err(Error::Setting { name: "covering", value, range });
            }
        }
        Ok(())
    }
}
