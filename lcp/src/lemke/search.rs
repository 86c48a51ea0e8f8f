//! The attempts on one problem, and their result.

use std::ops::ControlFlow;
use web_time::Instant;

use super::Progress;
use super::artificial::{completed, part_outside, without_artificial};
use super::constants::{ATTEMPT, FIRST_ROUND, KINDS, WORK};
use super::crash::{Crash, find_basis};
use super::feasibility::farkas_vector;
use super::finish::{BasicPoint, solve_basis};
use super::path::Path;
use super::start::{Equilibrated, Start};
use super::trial::{Trial, covering_vector};
use crate::certify::{Precision, is_proof};
use crate::enumerate::{self, MOST_PAIRS};
use crate::pivoting::{Attempt, AttemptCovering, AttemptEnd, AttemptStart, PivotRecord};
use crate::solve::is_over;
use crate::vector::SMALL;
use crate::{
    Basis, Certificate, Covering, HorizontalLcp, Info, LemkeSettings, Matrix, Ray, Side, Solution,
    Status, WarmStart,
};

pub(super) type ProgressObserver<'a> = &'a mut dyn FnMut(&Progress) -> ControlFlow<()>;

pub(super) struct Attempts<'a> {
    settings: &'a LemkeSettings,
    deadline: Option<Instant>,
    problem: Equilibrated<'a>,
    info: Info,
    trace: Vec<PivotRecord>,
    /// The best complementary point so far that is above the tolerance.
    almost: Option<BasicPoint>,
    ray: Option<Ray>,
    /// Whether the problem has artificial columns already.
    is_completed: bool,
}

impl<'a> Attempts<'a> {
    pub(super) fn new(
        settings: &'a LemkeSettings,
        problem: &'a HorizontalLcp,
        deadline: Option<Instant>,
    ) -> Self {
        Self {
            settings,
            deadline,
            problem: Equilibrated::new(problem),
            info: Info::default(),
            trace: Vec::new(),
            almost: None,
            ray: None,
            is_completed: false,
        }
    }

    pub(super) fn run(mut self, observer: ProgressObserver<'_>) -> Solution {
        if self.problem.problem.c().iter().all(|&c| c == 0.0) {
            return self.give_up(Status::Solved);
        }
        let (first_start, kind) = match self.first_start() {
            Ok(start) => start,
            // The basis is nonsingular, but not to working precision.
            Err(Crash::Complete(_)) => return self.prove_or(Status::NumericalTrouble),
            Err(Crash::Late) => return self.give_up(Status::TimeLimit),
            Err(Crash::Partial { .. }) if self.is_completed => {
                return self.give_up(Status::NoComplementaryBasis);
            }
            Err(Crash::Partial { chosen, complement }) => {
                return self.completed(&chosen, &complement, observer);
            }
        };
        if let Some(point) = self.solution_at(&first_start) {
            return self.answer(point);
        }
        let first = Trial { start: kind, covering: self.first_covering(kind) };
        let mut trial = first;
        let mut last_basis = None;
        // Costs of a game are positive: there is no proof to find, and the paths of pairs are short.
        let is_game = first_start.is_feasible_far_out();
        let (mut number, mut had_ray) = (0, false);
        while self.has_another(number) {
            number += 1;
            let other = self.other_start(&mut trial, &first, &first_start, last_basis.as_ref());
            let start = other.as_ref().unwrap_or(&first_start);
            let (mut attempt, basis) = self.attempt(start, &trial, number, observer);
            let end = attempt.end;
            let point = basis.as_ref().and_then(|basis| solve_basis(&self.problem, basis));
            let point = point.map(|point| self.exchanged(point));
            match &point {
                Some(point) => attempt.residual = Some(point.residuals.worst()),
                None if basis.is_some() => attempt.end = AttemptEnd::Singular,
                None => {}
            }
            self.info.attempts.push(attempt);
            if let Some(status) = stopped(end) {
                return self.give_up(status);
            }
            match point {
                Some(point) if self.is_solved(&point) => return self.answer(point),
                Some(point) => self.keep_better(point),
                None => {}
            }
            last_basis = basis.or(last_basis);
            // The search for a proof follows the first ray only; its result does not depend on the attempt.
            let is_first_ray = end == AttemptEnd::Ray && !had_ray;
            had_ray |= is_first_ray;
            if is_first_ray && self.settings.prove_infeasible && !is_game {
                match self.proof(&first_start, number, observer) {
                    Err(status) => return self.give_up(status),
                    Ok(None) => {}
                    Ok(Some(pi)) => return self.infeasible(pi),
                }
            }
            trial = Trial::after(&trial, end, number + 1, &first, is_game);
        }
        self.conclude()
    }

    /// The attempts on a problem without a complementary basis: with artificial columns, on either side of the pairs
    /// that need one.
    fn completed(
        mut self,
        chosen: &[Option<Side>],
        complement: &Matrix,
        observer: ProgressObserver<'_>,
    ) -> Solution {
        if let Some(pi) = part_outside(&self.problem, complement) {
            return self.infeasible(pi);
        }
        let settings = LemkeSettings { start: WarmStart::None, ..self.settings.clone() };
        for side in [Side::Y, Side::T] {
            let completed = completed(&self.problem, chosen, complement, side);
            let search = Attempts::new(&settings, &completed, self.deadline);
            let mut solution = Attempts { is_completed: true, ..search }.run(observer);
            let point = without_artificial(self.problem.problem, chosen, side, &solution);
            let proves = |pi: &&[f64]| is_proof(self.problem.problem, pi);
            let proof = solution.farkas().filter(proves).map(<[f64]>::to_vec);
            self.info.add_work(&mut solution.info);
            match (solution.status, point) {
                (Status::Cancelled | Status::TimeLimit, _) => return self.give_up(solution.status),
                (_, Some(point)) if self.is_solved(&point) => return self.answer(point),
                _ => {}
            }
            self.trace.extend(solution.trace);
            if let Some(pi) = proof {
                return self.infeasible(pi);
            }
        }
        self.prove_or(Status::NoComplementaryBasis)
    }

    /// The first start basis, or the reason for which there is none.
    fn first_start(&self) -> Result<(Start, AttemptStart), Crash> {
        let preferred = match &self.settings.start {
            WarmStart::None => None,
            WarmStart::Basis(basis) => Some(basis.clone()),
            WarmStart::Point { t, y } => Some(Basis::of_larger(t, y)),
        };
        if let Some(given) = &preferred
            && let Some(start) = self.problem.start(given)
        {
            return Ok((start, AttemptStart::Given));
        }
        let found = find_basis(&self.problem, preferred.as_ref(), self.deadline);
        let Crash::Complete(basis) = &found else { return Err(found) };
        let is_all = |side| basis.sides().iter().all(|&it| it == side);
        let kind = if is_all(Side::Y) {
            AttemptStart::AllY
        } else if is_all(Side::T) {
            AttemptStart::AllT
        } else {
            AttemptStart::Found
        };
        self.problem.start(basis).map(|start| (start, kind)).ok_or(found)
    }

    /// The point of the start basis if it solves the problem. Values of a factorised basis that should be zero have
    /// rounding errors, at which a path would start.
    fn solution_at(&self, start: &Start) -> Option<BasicPoint> {
        let is_negative = |(k, &q): (usize, &f64)| q < -SMALL && !start.is_free(k);
        if start.q.iter().enumerate().any(is_negative) {
            return None;
        }
        solve_basis(&self.problem, &start.basis).filter(|point| self.is_solved(point))
    }

    /// The covering vector of the settings; a given vector refers to the rows of the start basis given with it, and not
    /// to those of another.
    fn first_covering(&self, start: AttemptStart) -> AttemptCovering {
        let was_replaced = self.settings.start != WarmStart::None && start != AttemptStart::Given;
        match &self.settings.covering {
            Covering::Ones => AttemptCovering::Ones,
            Covering::Random { seed } => AttemptCovering::Random { seed: *seed },
            Covering::Given(_) if was_replaced => AttemptCovering::Ones,
            Covering::Given(_) => AttemptCovering::Given,
        }
    }

    /// The start of a trial, if its basis is not the first one; a singular basis is replaced by the first one.
    fn other_start(
        &self,
        trial: &mut Trial,
        first: &Trial,
        first_start: &Start,
        last_basis: Option<&Basis>,
    ) -> Option<Start> {
        let other = match trial.start {
            AttemptStart::Flipped { seed } => {
                self.problem.start(&first_start.flipped(seed, self.deadline))
            }
            AttemptStart::LastBasis => last_basis.and_then(|basis| self.problem.start(basis)),
            _ => return None,
        };
        if other.is_none() {
            trial.start = first.start;
        }
        other
    }

    /// Follows one path; also returns the complementary basis, if the path ended on one.
    fn attempt(
        &mut self,
        start: &Start,
        trial: &Trial,
        number: usize,
        observer: ProgressObserver<'_>,
    ) -> (Attempt, Option<Basis>) {
        let order = self.problem.order();
        let settings = self.settings;
        let given: &[f64] = match &settings.covering {
            Covering::Given(d) => d,
            _ => &[],
        };
        let covering = covering_vector(trial.covering, start, given);
        let mut path = Path::new(start, &covering);
        path.trace = settings.trace.then(Vec::new);
        // Every pair has its turn before the limit on paths from pairs is doubled.
        let (round, driver) = match trial.covering {
            AttemptCovering::Column { pair } => (pair / order, Some(pair % order)),
            _ => (0, None),
        };
        let max_pivots = settings.max_pivots.unwrap_or(match driver {
            Some(_) => (FIRST_ROUND * (order + 10)) << round.min(16),
            None => 100 * order + 1000,
        });
        let began = Instant::now();
        let end = path.run(driver, &mut self.limits(number, max_pivots, observer));
        self.info.pivot_seconds += began.elapsed().as_secs_f64();
        self.info.pivots += path.pivots;
        self.info.factorisations += path.factorisations;
        let records = path.trace.take().unwrap_or_default();
        self.trace.extend(records.into_iter().map(|it| PivotRecord { attempt: number, ..it }));
        let has_artificial = path.artificial_row().is_some();
        if end == AttemptEnd::Ray && self.ray.is_none() && has_artificial {
            self.ray = Some(path.ray(&self.problem));
        }
        let is_complementary = end == AttemptEnd::Complementary;
        let basis = is_complementary.then(|| start.basis_with(&path.z_is_basic()));
        let attempt = Attempt {
            start: trial.start,
            covering: driver.map_or(trial.covering, |pair| AttemptCovering::Column { pair }),
            end,
            pivots: path.pivots,
            residual: None,
        };
        (attempt, basis)
    }

    /// Limits of a path, checked before every pivot.
    fn limits<'o>(
        &self,
        attempt: usize,
        max_pivots: usize,
        observer: ProgressObserver<'o>,
    ) -> impl FnMut(usize, f64) -> Option<AttemptEnd> + use<'o> {
        let (order, deadline) = (self.problem.order(), self.deadline);
        move |pivots, artificial| {
            let progress = Progress { attempt, pivots, order, artificial };
            if pivots >= max_pivots {
                Some(AttemptEnd::PivotLimit)
            } else if is_over(deadline) {
                Some(AttemptEnd::TimeLimit)
            } else {
                observer(&progress).is_break().then_some(AttemptEnd::Cancelled)
            }
        }
    }

    /// Whether another attempt follows after this number of attempts.
    fn has_another(&self, made: usize) -> bool {
        if let Some(most) = self.settings.max_attempts {
            return made < most;
        }
        let order = self.problem.order();
        let work = (self.info.pivots + made * order).saturating_mul(order * order);
        let bases = u32::try_from(order).ok().and_then(|order| 1_usize.checked_shl(order));
        let is_spent = work.saturating_add(made * ATTEMPT) >= WORK;
        made < KINDS || !is_spent && bases.is_none_or(|bases| made < KINDS + bases)
    }

    /// A proof that there is no solution, or the status of a limit.
    fn proof(
        &self,
        start: &Start,
        number: usize,
        observer: ProgressObserver<'_>,
    ) -> Result<Option<Vec<f64>>, Status> {
        let covering = covering_vector(AttemptCovering::Ones, start, &[]);
        let mut limits = self.limits(number, 20 * self.problem.order() + 100, observer);
        match farkas_vector(&self.problem, start, &covering, &mut limits) {
            Ok(found) => Ok(found),
            Err(end) => stopped(end).map_or(Ok(None), Err),
        }
    }

    /// The point after exchanges of all pairs with negative values, repeated as long as each improves the point
    /// (Kostreva 1978). A path may end beside the basis of the solution if rounding errors have separated ties.
    fn exchanged(&self, mut point: BasicPoint) -> BasicPoint {
        while !self.is_solved(&point) && !point.negative.is_empty() {
            match solve_basis(&self.problem, &point.exchanged()) {
                Some(next) if next.residuals.worst() < point.residuals.worst() => point = next,
                _ => break,
            }
        }
        point
    }

    fn is_solved(&self, point: &BasicPoint) -> bool {
        point.residuals.worst() <= self.settings.tolerance
    }

    fn keep_better(&mut self, point: BasicPoint) {
        let worst = point.residuals.worst();
        if self.almost.as_ref().is_none_or(|best| worst < best.residuals.worst()) {
            self.almost = Some(point);
        }
    }

    /// Returns a proof by least squares for a small problem without a start basis, else this status.
    fn prove_or(self, status: Status) -> Solution {
        let is_small = self.problem.order() <= MOST_PAIRS && !self.is_completed;
        let is_wanted = is_small && self.settings.prove_infeasible;
        match is_wanted.then(|| enumerate::farkas_vector(self.problem.problem)).flatten() {
            Some(pi) => self.infeasible(pi),
            None => self.give_up(status),
        }
    }

    /// The solution if no attempt reached the tolerance: the best point if it is near, else the status of the attempts.
    fn conclude(mut self) -> Solution {
        let nearly = self.settings.tolerance.sqrt();
        if let Some(point) = self.almost.take_if(|point| point.residuals.worst() <= nearly) {
            return self.answer(point);
        }
        let statuses = [
            (AttemptEnd::Ray, Status::RayTermination),
            (AttemptEnd::PivotLimit, Status::PivotLimit),
            (AttemptEnd::Cycle, Status::Cycling),
        ];
        let has_ended = |end| self.info.attempts.iter().any(|attempt| attempt.end == end);
        let said = statuses.into_iter().find(|(end, _)| has_ended(*end));
        self.give_up(said.map_or(Status::NumericalTrouble, |(_, status)| status))
    }

    fn answer(self, point: BasicPoint) -> Solution {
        let BasicPoint { t, y, basis, residuals, condition, .. } = point;
        let tolerance = self.settings.tolerance;
        let judged = Solution::judged(t, y, residuals, tolerance, Status::AlmostSolved);
        let (basis, condition) = (Some(basis), Some(condition));
        Solution { basis, condition, trace: self.trace, info: self.info, ..judged }
    }

    fn infeasible(self, pi: Vec<f64>) -> Solution {
        self.give_up(Status::Infeasible).proved(Certificate::Farkas { pi })
    }

    /// The answer without a point: zero, with its residuals.
    fn give_up(self, status: Status) -> Solution {
        let zero = vec![0.0; self.problem.order()];
        let residuals = self.problem.judge.residuals(&[&zero, &zero], Precision::Exact);
        let tolerance = self.settings.tolerance;
        let judged = Solution::judged(zero.clone(), zero, residuals, tolerance, status);
        let ray = self.ray.filter(|_| status == Status::RayTermination);
        let certificate = ray.map(Certificate::Ray);
        Solution { certificate, trace: self.trace, info: self.info, ..judged }
    }
}

/// The status of a limit that ends all attempts.
fn stopped(end: AttemptEnd) -> Option<Status> {
    match end {
        AttemptEnd::Cancelled => Some(Status::Cancelled),
        AttemptEnd::TimeLimit => Some(Status::TimeLimit),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
