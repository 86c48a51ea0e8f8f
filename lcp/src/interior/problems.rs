//! The interior-point method on every kind of problem.

use std::time::Duration;

use super::constants::{PIVOTED_ATTEMPTS, PIVOTED_ORDER};
use super::{InteriorPoint, InteriorPointSettings};
use crate::conversion::{judged_by, solve_in_mixed_form, solve_in_standard_form};
use crate::{
    BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, Lcp, Lemke, LemkeSettings, Method,
    MixedLcp, Observer, Solution, Solver, Status, WarmStart,
};

impl Solver<Contact2d> for InteriorPoint {
    fn solve_pairs(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.run(problem, observer)
    }
}

/// The solution is that of [`MixedLcp::to_general`].
///
/// Convex programs have steps of their own, if the crossover is switched off and the bounded variables act on the free
/// ones only, as forces do on bodies: a step factorises a matrix with the order of the free ones, and a homogeneous
/// problem ends at a solution or at a Farkas vector, [`Status::Infeasible`](crate::Status::Infeasible) (Andersen and Ye
/// 1999).
impl Solver<MixedLcp> for InteriorPoint {
    fn solve_pairs(
        &self,
        problem: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        if !self.settings.crossover
            && let Some(solution) = self.solve_convex(problem, observer)?
        {
            return Ok(solution);
        }
        self.to_vertex(problem, observer)
    }
}

impl InteriorPoint {
    /// Follows the path, and pivots from its end if the loads are balanced but no vertex nearby has consistent states:
    /// the matrices of the path do not show the basic variables of rows that have only rounding errors.
    fn to_vertex(
        &self,
        problem: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let InteriorPointSettings { tolerance, time_limit, crossover, .. } = self.settings;
        let mut end = self.run(problem, observer)?;
        let is_near = end.residuals.loads <= tolerance && problem.order() <= PIVOTED_ORDER;
        if end.status != Status::Stalled || !crossover || !is_near {
            return Ok(end);
        }
        let left =
            time_limit.map(|it| it.saturating_sub(Duration::from_secs_f64(end.info.seconds)));
        let pivots = Lemke::new(LemkeSettings {
            tolerance,
            time_limit: left,
            max_pivots: Some(problem.order()),
            max_attempts: Some(PIVOTED_ATTEMPTS),
            start: WarmStart::Point { t: end.t.clone(), y: end.y.clone() },
            prove_infeasible: false,
            ..LemkeSettings::default()
        });
        // The point of the path stays if pivots do not treat the problem.
        let Ok(mut vertex) = pivots.solve_pairs(problem, observer) else { return Ok(end) };
        if matches!(vertex.status, Status::Cancelled | Status::TimeLimit) {
            end.status = vertex.status;
        }
        let seconds = end.info.seconds + vertex.info.seconds;
        let (mut best, other) =
            if vertex.is_solved() { (vertex, &mut end) } else { (end, &mut vertex) };
        best.info.add_work(&mut other.info);
        (best.info.method, best.info.seconds) = (Method::Interior, seconds);
        Ok(best)
    }
}

impl Solver<Lcp> for InteriorPoint {
    fn solve_pairs(&self, problem: &Lcp, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        self.to_vertex(&MixedLcp::of_standard(problem)?, observer)
    }
}

impl Solver<Friction2d> for InteriorPoint {
    fn solve_pairs(
        &self,
        problem: &Friction2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let solution = self.solve_pairs(problem.standard(), observer)?;
        Ok(judged_by(problem, solution, self.settings.tolerance))
    }
}

/// Problems that can be converted to the standard form ([`HorizontalLcp::to_standard`]).
impl Solver<HorizontalLcp> for InteriorPoint {
    fn solve_pairs(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let (start, tolerance) = (&self.settings.start, self.settings.tolerance);
        solve_in_standard_form(Method::Interior, problem, start, tolerance, |lcp, start| {
            let settings = InteriorPointSettings { start, ..self.settings.clone() };
            Self::new(settings).solve_pairs(lcp, observer)
        })
    }
}

/// The problem is solved in mixed form, by the distances from bounds.
impl Solver<BoxedLcp> for InteriorPoint {
    fn solve_pairs(
        &self,
        problem: &BoxedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let InteriorPointSettings { start, tolerance, .. } = &self.settings;
        solve_in_mixed_form(problem, start, *tolerance, |mixed, start| {
            let settings = InteriorPointSettings { start, ..self.settings.clone() };
            Self::new(settings).solve_pairs(mixed, observer)
        })
    }
}
