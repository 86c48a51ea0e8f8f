//! Problems that methods treat in another form, and the way back: a conversion never decides the status.

use std::borrow::Cow;

use crate::certify::Residuals;
use crate::vector::SMALL;
use crate::{
    BoxedLcp, Certificate, Contact2d, ContactState, Error, Friction2d, HorizontalLcp, Lcp, Method,
    MixedLcp, Solution, StandardForm, Status, WarmStart,
};

/// A problem with a general form, implemented by the problems of the library only.
pub trait General {
    /// The general form, whose pairs a [`Solution`] of the problem has.
    fn general(&self) -> Cow<'_, HorizontalLcp>;

    /// Residuals of a point of the general form in the variables of the problem itself.
    fn residuals_of_pairs(&self, t: &[f64], y: &[f64]) -> Residuals;

    /// The state of contact at a point of the general form.
    fn state_of_pairs(&self, _: &[f64], _: &[f64]) -> Option<ContactState> {
        None
    }

    /// The problem itself if it is a problem with bounds, whose general form has distances from the bounds.
    fn with_bounds(&self) -> Option<&BoxedLcp> {
        None
    }
}

/// A problem that pivots treat in its general form.
pub trait Converted: General {}

impl Converted for HorizontalLcp {}
impl Converted for Lcp {}
impl Converted for Friction2d {}
impl Converted for MixedLcp {}
impl Converted for BoxedLcp {}

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

    fn with_bounds(&self) -> Option<&BoxedLcp> {
        Some(self)
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

/// Solves a problem by its general form with `solve`, whose second argument is `false`. A second call, with `true`,
/// may follow for the equations of a problem with bounds.
///
/// # Errors
/// The errors of the method.
pub(crate) fn solve_in_general_form<P: Converted>(
    problem: &P,
    tolerance: f64,
    mut solve: impl FnMut(&HorizontalLcp, bool) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let solution = judged_by(problem, solve(&problem.general(), false)?, tolerance);
    let Some(boxed) = problem.with_bounds() else { return Ok(solution) };
    with_all_digits(boxed, solution, tolerance, |equations| solve(&equations.to_general(), true))
}

/// Solves a problem with bounds in its mixed form, with the start converted. The last argument solves equations.
///
/// # Errors
/// The errors of the method, and [`Error::Overflow`].
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

/// A solution with all digits of values between their bounds: a distance from a bound has lost the digits of a value
/// that is small against the bound.
fn with_all_digits(
    problem: &BoxedLcp,
    mut solution: Solution,
    tolerance: f64,
    solve: impl FnOnce(&MixedLcp) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let is_near =
        matches!(solution.status, Status::Solved | Status::AlmostSolved | Status::NumericalTrouble);
    if !is_near || solution.residuals.worst() <= SMALL {
        return Ok(solution);
    }
    let (z, w) = problem.recover(&solution.t, &solution.y);
    let Some(held) = problem.held(&z, &w) else { return Ok(solution) };
    let Ok(equations) = held.to_mixed() else { return Ok(solution) };
    let answer = solve(equations.mixed())?;
    let (t, y) = equations.to_pairs(&answer.t, &answer.y);
    let (z, _) = held.recover(&t, &y);
    let w = problem.forces(&z);
    let residuals = problem.residuals(&z, &w);
    if residuals.worst() < solution.residuals.worst() {
        (solution.t, solution.y) = problem.to_pairs(&z, &w);
        (solution.boxed, solution.certificate) = (Some((z, w)), None);
        solution.judge_again(residuals, tolerance);
    }
    Ok(solution)
}

/// The standard form of a problem for a method that treats no other.
///
/// # Errors
/// [`Error::NotTreated`].
pub(crate) fn standard_form(
    method: Method,
    problem: &HorizontalLcp,
) -> Result<StandardForm, Error> {
    let reason = "it cannot be converted to the standard form, for which every pair needs a column with one entry, \
                  all in different rows: take Lemke's method";
    problem.to_standard().ok_or_else(|| Error::NotTreated { method, reason: reason.to_owned() })
}

/// Solves a problem in its standard form, with the start converted.
///
/// # Errors
/// The errors of the method, and [`Error::NotTreated`] for a problem without a standard form.
pub(crate) fn solve_in_standard_form(
    method: Method,
    problem: &HorizontalLcp,
    start: &WarmStart,
    tolerance: f64,
    solve: impl FnOnce(&Lcp, WarmStart) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let standard = standard_form(method, problem)?;
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
