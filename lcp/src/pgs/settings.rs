//! Settings of projected Gauss-Seidel.

use std::time::Duration;

use crate::{Error, WarmStart};

/// The order in which a sweep goes over the rows, or over the contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SweepOrder {
    /// From the first to the last.
    #[default]
    Forward,
    /// Every second sweep from the last to the first.
    Symmetric,
    /// By colours, so that no two rows of one colour are coupled: red-black for the five-point Laplacian. Colours are
    /// assigned greedily, in the order of the rows. A dense matrix has as many colours as rows, which is the same as
    /// [`Forward`](Self::Forward), and so is a matrix whose [`neighbours`](crate::pgs::Rows::neighbours) are not
    /// known. The rows of a colour could be relaxed in parallel; they are relaxed on one thread.
    Coloured,
}

/// Settings of [`ProjectedGaussSeidel`](crate::ProjectedGaussSeidel).
///
/// ```
/// use lcp::pgs::SweepOrder;
/// use lcp::{ProjectedGaussSeidel, ProjectedGaussSeidelSettings};
/// let settings = ProjectedGaussSeidelSettings {
///     relaxation: 1.5,
///     order: SweepOrder::Coloured,
///     ..ProjectedGaussSeidelSettings::default()
/// };
/// let solver = ProjectedGaussSeidel::new(settings);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ProjectedGaussSeidelSettings {
    /// Largest residual, dimensionless, of a solution with status `Solved`. In `(0, 1)`. The default is `1e-8`: every
    /// further digit costs the same number of sweeps.
    pub tolerance: f64,
    /// Sweeps.
    pub max_iterations: usize,
    /// Wall-clock time, checked before every sweep; `None` is no limit.
    pub time_limit: Option<Duration>,
    /// Start: zero, or a point, of which `z` is used. A basis is refused, since it does not give the size of `z`.
    pub start: WarmStart,
    /// The over-relaxation `omega`: the diagonal is divided by it. In `(0, 2)`, outside of which the
    /// sweeps do not converge even for symmetric positive definite matrices.
    pub relaxation: f64,
    /// The order of the rows.
    pub order: SweepOrder,
    /// Sweeps between two evaluations of the residual, each of which costs as much as several sweeps. It is evaluated
    /// earlier if the changes of a sweep are below the tolerance. In between the history repeats the last value. At
    /// least 1.
    pub residual_interval: usize,
    /// Number of sweeps in which the best residual must decrease by the factor `stall_factor`; otherwise the status
    /// is [`Stalled`](crate::Status::Stalled). `None` is 2000, or the number of rows if that is more. Information
    /// spreads from row to row, so the largest residual may be constant for a while and decrease later: along a chain
    /// of `n` bodies this takes about `n^2` sweeps without over-relaxation. At least 1.
    pub stall_window: Option<usize>,
    /// See `stall_window`. In `(0, 1]`.
    pub stall_factor: f64,
}

impl Default for ProjectedGaussSeidelSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            max_iterations: 10_000,
            time_limit: None,
            start: WarmStart::None,
            relaxation: 1.0,
            order: SweepOrder::Forward,
            residual_interval: 20,
            stall_window: None,
            stall_factor: 0.9,
        }
    }
}

impl ProjectedGaussSeidelSettings {
    /// Checks the settings for a problem of `n` pairs.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        let Self { tolerance, relaxation, stall_factor, .. } = *self;
        let ranges = [
            ("tolerance", tolerance, tolerance > 0.0 && tolerance < 1.0, "between 0 and 1"),
            ("relaxation", relaxation, relaxation > 0.0 && relaxation < 2.0, "between 0 and 2"),
            (
                "stall_factor",
                stall_factor,
                stall_factor > 0.0 && stall_factor <= 1.0,
                "above 0 and at most 1",
            ),
        ];
        if let Some(&(name, value, _, range)) =
            ranges.iter().find(|(_, _, is_within, _)| !is_within)
        {
            return Err(Error::Setting { name, value, range });
        }
        let counts = [
            ("residual_interval", Some(self.residual_interval)),
            ("stall_window", self.stall_window),
        ];
        if let Some((name, _)) = counts.into_iter().find(|(_, count)| *count == Some(0)) {
            return Err(Error::Setting { name, value: 0.0, range: "at least 1" });
        }
        self.start.validate(n)
    }
}
