//! Problems that methods treat in another form, and the way back: a conversion never decides.

use std::borrow::Cow;

use crate::certify::Residuals;
use crate::{BoxedLcp, Friction2d, HorizontalLcp, Lcp, MixedLcp, Solution, Status};

/// A problem with a general form. Only the problems of the library are.
pub trait Lowered {
    /// The general form, whose pairs a [`Solution`] of the problem has.
    fn general(&self) -> Cow<'_, HorizontalLcp>;

    /// Residuals of a point of the general form in the variables of the problem itself.
    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals;
}

impl Lowered for HorizontalLcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Borrowed(self)
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.residuals(t, y)
    }
}

impl Lowered for Lcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.clone().into())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.residuals(t, y)
    }
}

impl Lowered for Friction2d {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        self.standard().general()
    }

    fn residuals_of_pairs(&self, t: &[f64], _: &[f64]) -> Residuals {
        self.residuals(&self.forces(t))
    }
}

impl Lowered for MixedLcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.to_general())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.boxed().residuals_of_pairs(t, y)
    }
}

impl Lowered for BoxedLcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.to_general())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        let (z, w) = self.recover(t, y);
        self.residuals(&z, &w)
    }
}

/// The solution of another form, whose pairs were brought back, judged by the problem itself.
pub(crate) fn judged_by(
    problem: &impl Lowered,
    mut solution: Solution,
    tolerance: f64,
) -> Solution {
    solution.residuals = problem.residuals_of_pairs(&solution.t, &solution.y);
    if matches!(solution.status, Status::Solved | Status::AlmostSolved) {
        solution.status = solution.residuals.verdict(tolerance, Status::AlmostSolved);
    }
    solution
}
