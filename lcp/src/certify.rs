//! Residuals of the point of a solution, and the validity of proofs.
//!
//! Two answers have a measure of their own, since they are not points of one of the problems: sweeps over rows without
//! a matrix, and least forces. The status `Solved` is given by [`verdict`] alone, to these answers too.
//!
//! A point is measured by the rows and pairs of the problem as stated, so that a conversion does not affect the result.
//! Each row is measured relative to its own terms: the result is the smallest relative change of its data for which the
//! row holds (Oettli and Prager 1964), whatever the scaling of rows and variables. Changes that would make the point
//! feasible and complementary count by the largest share that they have in the terms of a row. A row of a distant
//! point, with large terms, may hold relative to its terms and not at all relative to the loads: so the residual is
//! compared with the loads, too, part by connected part.
//!
//! A row without effect on the rows that carry loads does not count, see [`significance`]. Residuals are computed in
//! `f64`, and in double-double arithmetic if rounding errors of the terms are not small compared with the loads.

mod certificate;
mod constants;
mod contact;
mod farkas;
mod judge;
mod problems;
mod significance;
mod weights;

pub use certificate::{Certificate, Leaf, Ray};

pub(crate) use constants::{MILLIONTH, ROUNDING};
pub(crate) use contact::ContactJudge;
pub(crate) use farkas::{is_proof, is_proof_of, is_proof_of_mixed};
pub(crate) use judge::{Precision, ratio};
pub(crate) use problems::{BoxedJudge, GeneralJudge};
pub(crate) use weights::Couplings;

use crate::Status;

/// The errors of a point: dimensionless, from the given data, independent of units. See
/// [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Residuals {
    /// Largest `|r_i| / terms_i`, with the residual of a row and the sum of the sizes of its terms.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub equation: f64,
    /// The largest effect of a component that violates its sign or its bound: the largest `|a_ij x_j| / terms_i` of
    /// the change that removes the violation.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub feasibility: f64,
    /// The largest effect of the smaller one of a pair whose variables are both positive.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub complementarity: f64,
    /// Feasibility and complementarity in one number.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub natural: f64,
    /// The residual of a row plus the changes of feasibility and complementarity, relative to the largest right-hand
    /// side of its connected part in equilibrated units.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub loads: f64,
}

impl Residuals {
    /// The largest of the residuals, which decides the status.
    pub fn worst(&self) -> f64 {
        self.equation.max(self.natural).max(self.loads)
    }

    /// A measure of progress: the geometric mean of [`worst`](Self::worst) and [`loads`](Self::loads). If a contact
    /// comes to rest, the former decreases only at the end, long after the latter.
    pub fn merit(&self) -> f64 {
        let worst = self.worst();
        (worst * self.loads.max(f64::EPSILON * worst)).sqrt()
    }

    /// Whether a method that iterates to the tolerance prefers this point: a point within the tolerance comes before
    /// all others, else the one with the smaller merit.
    pub(crate) fn is_better_than(&self, other: &Self, tolerance: f64) -> bool {
        match (self.worst() <= tolerance, other.worst() <= tolerance) {
            (false, false) => self.merit() < other.merit(),
            (true, true) => self.worst() < other.worst(),
            (is_solved, _) => is_solved,
        }
    }

    /// The status of a point with these residuals, see [`verdict`].
    pub(crate) fn verdict(&self, tolerance: f64, otherwise: Status) -> Status {
        verdict(self.worst(), tolerance, otherwise)
    }

    /// The residuals of a point that is not a number.
    pub(crate) fn infinite() -> Self {
        let inf = f64::INFINITY;
        Self { equation: inf, feasibility: inf, complementarity: inf, natural: inf, loads: inf }
    }
}

/// The status of a point with this residual: `Solved` within the tolerance, else the status that the method gives to
/// other points; of these, `AlmostSolved` becomes `NumericalTrouble` above the root of the tolerance, and `Solved`
/// becomes `Stalled`.
pub(crate) fn verdict(residual: f64, tolerance: f64, otherwise: Status) -> Status {
    if residual <= tolerance {
        Status::Solved
    } else if otherwise == Status::AlmostSolved && residual > tolerance.sqrt() {
        Status::NumericalTrouble
    } else if otherwise == Status::Solved {
        Status::Stalled
    } else {
        otherwise
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn residuals(natural: f64, loads: f64) -> Residuals {
        Residuals { natural, loads, ..Residuals::default() }
    }

    #[test]
    fn a_point_within_the_tolerance_is_kept_before_one_of_smaller_merit() {
        let solved = residuals(9e-11, 9e-11);
        let other = residuals(1e-6, 1e-17);
        assert!(other.merit() < solved.merit());
        assert!(solved.is_better_than(&other, 1e-10) && !other.is_better_than(&solved, 1e-10));
        assert!(other.is_better_than(&residuals(0.5, 1e-3), 1e-10));
        assert!(residuals(1e-12, 1e-11).is_better_than(&solved, 1e-10));
    }

    #[test]
    fn no_method_says_solved_of_a_point_beyond_the_tolerance() {
        let verdict = |natural| residuals(natural, 0.0).verdict(1e-10, Status::Solved);
        assert_eq!((verdict(9e-11), verdict(2e-10)), (Status::Solved, Status::Stalled));
    }
}
