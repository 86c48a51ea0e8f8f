//! Problems that methods treat in another form, and the way back: a conversion never decides.

use std::borrow::Cow;

use crate::certify::{Residuals, SMALL};
use crate::problem::Between;
use crate::{
    BoxedLcp, Certificate, Contact2d, ContactState, Error, Friction2d, HorizontalLcp, Lcp,
    MixedLcp, Solution, Status, WarmStart,
};

/// A problem with a general form. Only the problems of the library are.
pub trait General {
    /// The general form, whose pairs a [`Solution`] of the problem has.
    fn general(&self) -> Cow<'_, HorizontalLcp>;

    /// Residuals of a point of the general form in the variables of the problem itself.
    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals;

    /// The state that a point of the general form is, of contact.
    fn state_of_pairs(&self, _: &[f64], _: &[f64]) -> Option<ContactState> {
        None
    }
}

/// A problem that pivots treat in its general form.
pub trait Converted: General + Sized {
    /// The equations of what is between its bounds at a solution, if it has bounds.
    fn between_bounds(&self, _solution: &Solution) -> Option<Between> {
        None
    }

    /// The solution with the answer to these equations.
    fn with_between(
        &self,
        _between: &Between,
        _answer: &Solution,
        solution: &Solution,
    ) -> Solution {
        solution.clone()
    }
}

impl Converted for HorizontalLcp {}

impl Converted for Lcp {}

impl Converted for Friction2d {}

impl Converted for MixedLcp {}

impl Converted for BoxedLcp {
    fn between_bounds(&self, solution: &Solution) -> Option<Between> {
        let (z, w) = self.recover(&solution.t, &solution.y);
        self.between(&z, &w)
    }

    fn with_between(&self, between: &Between, answer: &Solution, solution: &Solution) -> Solution {
        let (z, _) = self.recover(&solution.t, &solution.y);
        // All of them are free.
        let inside: Vec<f64> = answer.t.iter().zip(&answer.y).map(|(t, y)| t - y).collect();
        let (z, w) = self.with_inside(z, &between.variables, &inside);
        let (t, y) = self.to_pairs(&z, &w);
        let residuals = self.residuals(&z, &w);
        Solution { t, y, residuals, boxed: Some((z, w)), certificate: None, ..solution.clone() }
    }
}

impl General for HorizontalLcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Borrowed(self)
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.residuals(t, y)
    }
}

impl General for Lcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.clone().into())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.residuals(t, y)
    }
}

impl General for Friction2d {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        self.standard().general()
    }

    fn residuals_of_pairs(&self, t: &[f64], _: &[f64]) -> Residuals {
        self.residuals(&self.forces(t))
    }
}

impl General for MixedLcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.to_general())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.boxed().residuals_of_pairs(t, y)
    }
}

impl General for BoxedLcp {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.to_general())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        let (z, w) = self.recover(t, y);
        self.residuals(&z, &w)
    }
}

impl General for Contact2d {
    fn general(&self) -> Cow<'_, HorizontalLcp> {
        Cow::Owned(self.to_general())
    }

    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals {
        self.residuals(&self.recover(t, y))
    }

    fn state_of_pairs(&self, t: &[f64], y: &[f64]) -> Option<ContactState> {
        Some(self.recover(t, y))
    }
}

/// Solves a problem by its general form; the second argument says that it is another one, of its parts.
///
/// # Errors
/// Those of the method.
pub(crate) fn solve_in_general_form<P: Converted>(
    problem: &P,
    tolerance: f64,
    mut solve: impl FnMut(&HorizontalLcp, bool) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let solution = judged_by(problem, solve(&problem.general(), false)?, tolerance);
    with_all_digits(problem, solution, tolerance, |equations| solve(&equations.to_general(), true))
}

/// Solves a problem with bounds in its mixed form, with the start converted. The last argument solves equations.
///
/// # Errors
/// Those of the method, and [`Error::Overflow`].
pub(crate) fn solve_in_mixed_form(
    problem: &BoxedLcp,
    start: &WarmStart,
    tolerance: f64,
    mut solve: impl FnMut(&MixedLcp, WarmStart) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    start.validate(problem.pairs())?;
    let form = problem.to_mixed()?;
    let mut solution = solve(form.mixed(), form.start(start))?;
    (solution.t, solution.y) = form.to_pairs(&solution.t, &solution.y);
    solution.basis = solution.basis.map(|basis| form.basis(&basis, &solution.y));
    if let Some(Certificate::Farkas { pi }) = &mut solution.certificate {
        *pi = form.farkas(pi);
    }
    let solution = judged_by(problem, solution, tolerance);
    with_all_digits(problem, solution, tolerance, |equations| solve(equations, WarmStart::None))
}

/// A solution with the digits of what is between its bounds: a distance from a bound has lost those of a value that is
/// small against the bound.
fn with_all_digits<P: Converted>(
    problem: &P,
    solution: Solution,
    tolerance: f64,
    solve: impl FnOnce(&MixedLcp) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let is_near =
        matches!(solution.status, Status::Solved | Status::AlmostSolved | Status::NumericalTrouble);
    if !is_near || solution.residuals.worst() <= SMALL {
        return Ok(solution);
    }
    let Some(between) = problem.between_bounds(&solution) else { return Ok(solution) };
    let free = vec![true; between.q.len()];
    let Ok(equations) = MixedLcp::new(between.m.clone(), between.q.clone(), free) else {
        return Ok(solution);
    };
    let mut right = problem.with_between(&between, &solve(&equations)?, &solution);
    right.judge_again(right.residuals, tolerance);
    let is_better = right.residuals.worst() < solution.residuals.worst();
    Ok(if is_better { right } else { solution })
}

/// Solves a problem in its standard form, with the start converted.
///
/// # Errors
/// Those of the method, and for other problems the one given.
pub(crate) fn solve_in_standard_form(
    problem: &HorizontalLcp,
    start: &WarmStart,
    tolerance: f64,
    refused: impl FnOnce() -> Error,
    solve: impl FnOnce(&Lcp, WarmStart) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let standard = problem.to_standard().ok_or_else(refused)?;
    let mut solution = solve(standard.lcp(), standard.start(start))?;
    (solution.t, solution.y) = standard.to_pairs(&solution.t, &solution.y);
    solution.basis = solution.basis.map(|basis| standard.basis(&basis));
    Ok(judged_by(problem, solution, tolerance))
}

/// A point of the general form, judged by the problem itself.
pub(crate) fn judged_point(
    problem: &impl General,
    t: Vec<f64>,
    y: Vec<f64>,
    tolerance: f64,
    otherwise: Status,
) -> Solution {
    let residuals = problem.residuals_of_pairs(&t, &y);
    let contact = problem.state_of_pairs(&t, &y);
    Solution { contact, ..Solution::judged(t, y, residuals, tolerance, otherwise) }
}

/// The solution of another form, whose pairs were brought back, judged by the problem itself.
pub(crate) fn judged_by(
    problem: &impl General,
    mut solution: Solution,
    tolerance: f64,
) -> Solution {
    solution.judge_again(problem.residuals_of_pairs(&solution.t, &solution.y), tolerance);
    solution
}
