//! The route `lemke`: Lemke's method on the forms of the contact problem.
//!
//! The paper's form (3.27) comes first. The form is not copositive, and for large friction the method may end on a
//! secondary ray although there is an equilibrium. Other start bases and covering vectors follow after a ray, and then
//! the copositive mixed form. The ray of the mixed form is a motion of the blocks that no contact stops. Even such a
//! ray is not a proof that there is no equilibrium: a rigid block that just fits between two walls may fall, or may be
//! jammed. The residuals of a solution of the mixed form are also computed in the paper's form.

use lcp::lemke::{self, AttemptStart};
use lcp::{Basis, Covering, Lemke, LemkeSettings, Residuals, Side, Status, WarmStart};

use super::{Event, EventObserver, Request, RouteAnswer, auto};
use crate::data::info::{RouteAttempt, SolveInfo};
use crate::data::motion::Motion;
use crate::data::route::Route;
use crate::data::state::RowState;
use crate::forms::reduction::Reduction;
use crate::forms::{DenseForm, FormKind, Start};
use crate::system::System;

/// Number of attempts from every start basis of a reduced form: the first with the covering vector of [`covering`],
/// then with a random one.
const ATTEMPTS_PER_START: usize = 2;
/// Number of attempts on the mixed form.
const MIXED_ATTEMPTS: usize = 3;
/// Cohesion by which the covering vector opens the friction cone, in units of force.
const COHESION: f64 = 100.0;

/// Displacements below this number, in the dimensionless units of a form, are rounding errors.
const ROUNDING: f64 = 1e-14;

/// The route by Lemke's method on a reduced system.
#[derive(Debug, Clone, Copy)]
pub struct Pivots<'a> {
    /// The system.
    pub system: &'a System,
    /// The reduction of the system.
    pub reduction: &'a Reduction,
    /// The basis at which the pivots of a similar problem in the paper's form ended, which is tried first.
    pub start: Option<&'a Start>,
}

impl Pivots<'_> {
    /// Looks for a solution in one form after another.
    ///
    /// # Errors
    /// As [`Lemke`].
    pub fn solve(
        &self,
        request: &Request,
        observer: EventObserver<'_>,
    ) -> Result<RouteAnswer, lcp::Error> {
        let Self { system, reduction, start } = *self;
        let mut search = Pivoting {
            request,
            start,
            attempts: Vec::new(),
            pivots: 0,
            factorisations: 0,
            coulomb: None,
        };
        let mut answer = None;
        for &kind in auto::forms(request.form) {
            let form = DenseForm::new(kind, system, reduction)?;
            let found = search.run(form, observer)?;
            let done = found.rows.is_some() || found.info.status == Status::Cancelled;
            answer = Some(found);
            if done {
                break;
            }
        }
        Ok(answer.unwrap_or_else(|| unreachable!("every choice of a form names at least one")))
    }
}

/// The work on all forms that were tried so far.
struct Pivoting<'a> {
    request: &'a Request,
    start: Option<&'a Start>,
    attempts: Vec<RouteAttempt>,
    pivots: usize,
    factorisations: usize,
    /// The paper's form, if it was tried: the residuals of any solution in another form are computed in it.
    coulomb: Option<DenseForm>,
}

impl Pivoting<'_> {
    fn run(
        &mut self,
        form: DenseForm,
        observer: EventObserver<'_>,
    ) -> Result<RouteAnswer, lcp::Error> {
        let mut last = None;
        for (settings, start) in self.settings(&form) {
            let solution = Lemke::new(settings)
                .solve_with_progress(&form.problem, &mut |at| observer(Event::Pivots(*at)))?;
            self.pivots += solution.info.pivots;
            self.factorisations += solution.info.factorisations;
            self.attempts.extend(solution.info.attempts.iter().map(|path| RouteAttempt::Pivots {
                form: form.kind.name().to_owned(),
                start: start.filter(|_| is_given(path)).map(str::to_owned),
                path: path.clone(),
            }));
            // If the solver replaced a singular start by its own, it would replace the next start, too.
            let is_own = start.is_some_and(|name| name != Start::LAST);
            let replaced = is_own && !solution.info.attempts.iter().any(is_given);
            let stop = replaced || matches!(solution.status, Status::Solved | Status::Cancelled);
            last = Some(solution);
            if stop {
                break;
            }
        }
        let solution = last.unwrap_or_else(|| unreachable!("there is at least one start"));
        let rows = solution.is_solved().then(|| form.rows(&solution.t, &solution.y));
        let info = SolveInfo {
            form: form.kind.name().to_owned(),
            order: form.order(),
            attempts: self.attempts.clone(),
            pivots: self.pivots,
            factorisations: self.factorisations,
            coulomb_residuals: rows.as_ref().and_then(|rows| self.against_coulomb(&form, rows)),
            ..SolveInfo::new(Route::Lemke, solution.status, solution.residuals)
        };
        let ray = solution.ray().filter(|_| form.kind == FormKind::Mixed).cloned();
        let ray = ray.and_then(|ray| form.amplitudes(&ray.dt));
        let kind = form.kind;
        if form.kind == FormKind::Coulomb {
            self.coulomb = Some(form);
        }
        let basis = solution.basis.filter(|_| rows.is_some() && kind == FormKind::Coulomb);
        let is_t = |side: &Side| *side == Side::T;
        let basis = basis.map(|it| Start::last(it.sides().iter().map(is_t).collect()));
        Ok(RouteAnswer { rows, motion: ray.map(Motion::Rigid), basis, ..RouteAnswer::new(info) })
    }

    /// Lists the settings of the runs on a form, each with the name of its start basis.
    fn settings(&self, form: &DenseForm) -> Vec<(LemkeSettings, Option<&'static str>)> {
        let common = LemkeSettings {
            tolerance: self.request.tolerance,
            max_pivots: self.request.max_pivots,
            max_attempts: Some(MIXED_ATTEMPTS),
            prove_infeasible: false,
            ..LemkeSettings::default()
        };
        if form.starts.is_empty() {
            return vec![(common, None)];
        }
        let from_start = |start: &Start| {
            let settings = LemkeSettings {
                start: WarmStart::Basis(basis(start)),
                covering: Covering::Given(covering(form, start)),
                max_attempts: Some(ATTEMPTS_PER_START),
                ..common.clone()
            };
            (settings, Some(start.name))
        };
        let last = self.start.filter(|_| form.kind == FormKind::Coulomb);
        last.into_iter().chain(&form.starts).map(from_start).collect()
    }

    fn against_coulomb(&self, form: &DenseForm, rows: &RowState) -> Option<Residuals> {
        let coulomb = self.coulomb.as_ref().filter(|_| form.kind != FormKind::Coulomb)?;
        let (t, mut y) = coulomb.pairs(rows, &[], &[]);
        // Displacements that are only rounding errors must not be compared with one another if nothing moves.
        y.iter_mut().filter(|y| y.abs() <= ROUNDING).for_each(|y| *y = 0.0);
        Some(coulomb.problem.residuals(&t, &y))
    }
}

fn basis(start: &Start) -> Basis {
    let side = |&t_basic: &bool| if t_basic { Side::T } else { Side::Y };
    Basis::new(start.t_basic.iter().map(side).collect())
}

/// Returns a covering vector with a mechanical meaning: the artificial variable prestresses the isostatic contacts,
/// opens the others, and adds a much larger cohesion, which opens the friction cone. A covering vector of ones nearly
/// always ends on a ray after a few pivots, in the paper's form and for large `mu`.
fn covering(form: &DenseForm, start: &Start) -> Vec<f64> {
    let cone = |pair: usize| start.t_basic[pair] && pair >= form.points();
    (0..form.order()).map(|pair| if cone(pair) { COHESION } else { 1.0 }).collect()
}

fn is_given(attempt: &lemke::Attempt) -> bool {
    attempt.start == AttemptStart::Given
}
