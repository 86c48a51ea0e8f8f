//! Lemke's method on every kind of problem.

use web_time::{Duration, Instant};

use super::{Lemke, Progress};
use crate::conversion::{Converted, solve_in_general_form};
use crate::states::Scaled;
use crate::vector::SMALL;
use crate::{
    Basis, Certificate, Contact2d, Covering, Error, HorizontalLcp, Iteration, LemkeSettings,
    Method, Named, Observer, Side, Solution, Solver, Status, WarmStart,
};

impl Lemke {
    /// Solves with an observer of any method: see [`Iteration`].
    fn solve_iterating(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.solve_with_progress(problem, &mut |at: &Progress| {
            observer(&Iteration {
                iteration: at.pivots,
                residual: at.artificial,
                method: Method::Lemke,
                step: None,
            })
        })
    }
}
impl Named for Lemke {
    fn method(&self) -> Method {
        Method::Lemke
    }
}

/// Solves the general form of the problem; the answer is judged by the problem itself.
impl<P: Converted> Solver<P> for Lemke {
    fn solve_pairs(&self, problem: &P, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        solve_in_general_form(problem, self.settings().tolerance, |general, is_other| {
            if is_other {
                // A start and a covering vector have the pairs of the problem as it was given.
                let (covering, start) = (Covering::Ones, WarmStart::None);
                let settings = LemkeSettings { covering, start, ..self.settings().clone() };
                return Self::new(settings).solve_iterating(general, observer);
            }
            self.solve_iterating(general, observer)
        })
    }
}

/// Solves the mixed problem of [`Contact2d::to_mixed`], to which a given covering vector belongs. Without a
/// start the path begins from open contacts, with the displacements that they leave free. The answer has
/// neither a basis nor a ray, which would belong to the mixed problem.
impl Solver<Contact2d> for Lemke {
    fn solve_pairs(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let began = Instant::now();
        if let Some(closed) = without_rounding(problem) {
            let mut solution = self.solve_contact(&closed, observer)?;
            if let Some(state) = solution.contact.take_if(|_| solution.status == Status::Solved) {
                // Gaps and slips follow from the given data.
                let state = problem.state(state.u, state.t_n, state.t_t);
                (solution.t, solution.y) = problem.to_pairs(&state);
                solution.judge_again(problem.residuals(&state), self.settings().tolerance);
                solution.contact = Some(state);
                if solution.is_solved() {
                    return Ok(solution);
                }
            } else if solution.status == Status::Cancelled {
                return Ok(solution);
            }
        }
        let left = |limit: Duration| limit.saturating_sub(began.elapsed());
        let time_limit = self.settings().time_limit.map(left);
        let settings = LemkeSettings { time_limit, ..self.settings().clone() };
        Self::new(settings).solve_contact(problem, observer)
    }
}

/// The problem with gaps and slips of zero in place of rounding errors, if there are any: closed contacts
/// contradict each other by rounding errors, so that no basis is exactly right.
fn without_rounding(problem: &Contact2d) -> Option<Contact2d> {
    let points = Scaled::of_contact(problem).points;
    let mut has_any = false;
    let mut cleared = |given: &[f64], scaled: &[f64]| -> Vec<f64> {
        let both = given.iter().zip(scaled);
        both.map(|(given, scaled)| {
            let is_rounding = *given != 0.0 && scaled.abs() <= SMALL;
            has_any |= is_rounding;
            if is_rounding { 0.0 } else { *given }
        })
        .collect()
    };
    let x_0 = cleared(problem.initial_gaps(), &points.x_0);
    let s_0 = cleared(problem.initial_slips(), &points.s_0);
    has_any.then(|| problem.clone().under(problem.loads().to_vec(), x_0, s_0))
}

impl Lemke {
    fn solve_contact(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mixed = problem.to_mixed();
        let mut settings = LemkeSettings { covering: Covering::Ones, ..self.settings().clone() };
        settings.validate(problem.order())?;
        settings.covering = self.settings().covering.clone();
        settings.start = problem.mixed_start(&mixed, &settings.start);
        if settings.start == WarmStart::None {
            // The problem is copositive from this basis, if `K` is regular; it is not from a basis with
            // contact forces, and a path may end on a ray.
            settings.start = WarmStart::Basis(Basis::all(Side::Y, mixed.order()));
        }
        let mut solution = Self::new(settings).solve_iterating(&mixed.to_general(), observer)?;
        let (z, _) = mixed.recover(&solution.t, &solution.y);
        let state = problem.from_mixed(&z);
        solution.judge_again(problem.residuals(&state), self.settings().tolerance);
        (solution.t, solution.y) = problem.to_pairs(&state);
        solution.contact = Some(state);
        // The basis and the ray belong to the pairs of the mixed problem.
        solution.basis = None;
        solution.certificate =
            solution.farkas().map(|pi| Certificate::Farkas { pi: problem.farkas_of_mixed(pi) });
        Ok(solution)
    }
}
