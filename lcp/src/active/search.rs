//! The points of a method, of which the best one is kept.

use faer::sparse::FaerError;

use super::crossover::{Effort, Vertex, cross_over};
use super::original::{Answer, Judge, Judged, Original, Refiner, judged as judged_by};
use crate::certify::Precision;
use crate::problem::ContactStatus;
use crate::solve::Monitor;
use crate::states::{Condensed, PointRef, Scaled, nearest};
use crate::{Error, Method, Solution, Status, WarmStart};

/// A problem with the best point so far.
pub(crate) struct Search<'a> {
    problem: &'a dyn Original,
    judge: Box<dyn Judge + 'a>,
    tolerance: f64,
    pub(crate) scaled: Scaled,
    pub(crate) condensed: Condensed,
    best: Option<Best>,
}

/// The best point so far.
struct Best {
    point: Judged,
    /// Its states if the point is exact.
    exact: Option<Vec<ContactStatus>>,
}

impl<'a> Search<'a> {
    /// The search of a method. `tolerance` is the largest residual of a solution, and `plan` the linear system of a
    /// problem of the same pattern.
    pub(crate) fn new(
        method: Method,
        problem: &'a dyn Original,
        tolerance: f64,
        plan: Option<Condensed>,
    ) -> Result<Self, Error> {
        let scaled = problem.scaled();
        let condensed = match plan {
            Some(condensed) => condensed.reloaded(&scaled),
            None => Condensed::new(&scaled).map_err(|error| unplanned(method, error))?,
        };
        let judge = problem.judge();
        Ok(Self { problem, judge, tolerance, scaled, condensed, best: None })
    }

    /// Whether the states of the contacts of a given start, if there is one, solve the problem.
    pub(crate) fn try_start(&mut self, start: &WarmStart) -> bool {
        let (u, forces, contacts) = match start {
            WarmStart::None => return false,
            WarmStart::Basis(basis) => {
                let (u, forces) = self.rest();
                (u, forces, self.problem.contacts(basis))
            }
            WarmStart::Point { t, y } => {
                let (u, forces) = self.problem.point(&self.scaled, t, y);
                let contacts = nearest(&self.scaled, &u, &forces);
                (u, forces, contacts)
            }
        };
        self.cross_over(PointRef { u: &u, forces: &forces }, contacts, &Effort::START)
    }

    /// Whether the point without motion and forces is a solution, which iterations only approach without end.
    /// `crossover` is whether its states are wanted too.
    pub(crate) fn try_rest(&mut self, crossover: bool) -> bool {
        let (u, forces) = self.rest();
        if self.judge(&u, &forces) > self.tolerance {
            return false;
        }
        if crossover {
            let contacts = nearest(&self.scaled, &u, &forces);
            self.cross_over(PointRef { u: &u, forces: &forces }, contacts, &Effort::THOROUGH);
        }
        true
    }

    /// Whether a point is a solution, or the states of its contacts lead to one with some effort.
    pub(crate) fn try_point(&mut self, at: PointRef<'_>, effort: Option<&Effort>) -> bool {
        let is_solved = self.judge(at.u, at.forces) <= self.tolerance;
        let contacts = nearest(&self.scaled, at.u, at.forces);
        effort.is_some_and(|effort| self.cross_over(at, contacts, effort)) || is_solved
    }

    /// The point without motion and forces.
    pub(crate) fn rest(&self) -> (Vec<f64>, Vec<(f64, f64)>) {
        (vec![0.0; self.scaled.order()], vec![(0.0, 0.0); self.scaled.points.len()])
    }

    /// Whether the states of the contacts, or those that they lead to, are those of a solution.
    pub(crate) fn cross_over(
        &mut self,
        at: PointRef<'_>,
        contacts: Vec<ContactStatus>,
        effort: &Effort,
    ) -> bool {
        let Self { judge, tolerance, scaled, condensed, best, .. } = self;
        let is_solution = |condensed: &mut Condensed, vertex: &Vertex, is_consistent: bool| {
            let point = PointRef { u: &vertex.u, forces: &vertex.forces };
            let mut judged = judged(judge.as_ref(), scaled, point, *tolerance);
            if is_consistent || judged.worst() <= *tolerance {
                let mut refiner = Refiner { judge: judge.as_ref(), scaled, condensed };
                judged = refiner.brought_right(judged, point, &vertex.contacts, *tolerance);
            }
            let is_solution = judged.worst() <= *tolerance;
            let contacts = is_solution.then_some(&vertex.contacts[..]);
            keep_better(best, judged, contacts, *tolerance);
            is_solution
        };
        cross_over(scaled, condensed, at, contacts, effort, is_solution)
    }

    /// Removes the rounding errors by large displacements from the forces of the best point, if the result is a
    /// solution too.
    pub(crate) fn without_rounding(&mut self) {
        let Self { judge, tolerance, scaled, condensed, best, .. } = self;
        if let Some(Best { point, exact }) = best
            && point.worst() <= *tolerance
        {
            let contacts =
                exact.clone().unwrap_or_else(|| nearest(scaled, &point.u, &point.forces));
            let mut refiner = Refiner { judge: judge.as_ref(), scaled, condensed };
            let right = refiner.unrounded(point.point(), &contacts);
            if let Some(right) = right.filter(|right| right.worst() <= *tolerance) {
                *point = right;
            }
        }
    }

    /// The worst residual of a point, which is kept if none was better.
    pub(crate) fn judge(&mut self, u: &[f64], forces: &[(f64, f64)]) -> f64 {
        let Self { judge, tolerance, scaled, best, .. } = self;
        let (mut u, mut forces) = (u.to_vec(), forces.to_vec());
        scaled.settle(&mut u, &mut forces);
        let at = PointRef { u: &u, forces: &forces };
        let judged = judged(judge.as_ref(), scaled, at, *tolerance);
        let worst = judged.worst();
        keep_better(best, judged, None, *tolerance);
        worst
    }

    /// The worst residual of the best point.
    pub(crate) fn residual(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |best| best.point.worst())
    }

    /// The best point, with this status unless it is a solution.
    pub(crate) fn finish(self, otherwise: Status, monitor: Monitor<'_>) -> Solution {
        let (mut solution, condensed) = self.ended(otherwise);
        solution.info = monitor.info();
        solution.info.factorisations = condensed.factorisations;
        solution
    }

    /// The best point without its cost, and the linear system.
    pub(crate) fn ended(self, otherwise: Status) -> (Solution, Condensed) {
        let Self { judge, tolerance, scaled, condensed, best, .. } = self;
        let Some(Best { point: best, exact }) = best else {
            unreachable!("every solve judges a point");
        };
        let residuals = if best.worst() > tolerance {
            // Rows that matter to no load counted too on the way.
            judge.residuals(&scaled, best.point(), Precision::Exact)
        } else {
            best.residuals
        };
        let Answer { t, y, contact } = judge.answer(&scaled, best.point());
        let basis = exact.map(|contacts| {
            let points = scaled.points.iter().zip(&best.forces);
            let slips = points.map(|(point, (_, t_t))| point.slip(&best.u, *t_t));
            let slips: Vec<f64> = slips.collect();
            self.problem.basis(&contacts, &y, &slips)
        });
        let mut solution = Solution::judged(t, y, residuals, tolerance, otherwise);
        solution.contact = contact;
        solution.basis = basis;
        (solution, condensed)
    }
}

/// The error of sparse factors for which memory does not suffice.
pub(crate) fn unplanned(method: Method, error: FaerError) -> Error {
    Error::NotTreated { method, reason: format!("its sparse factors cannot be planned: {error}") }
}

/// Judges a point quickly, and with all digits if it may be a solution.
fn judged(judge: &dyn Judge, scaled: &Scaled, at: PointRef<'_>, tolerance: f64) -> Judged {
    let quick = judged_by(judge, scaled, at, Precision::Quick);
    // The residual of the loads does not depend on the rows that matter.
    if quick.residuals.loads > tolerance {
        return quick;
    }
    judged_by(judge, scaled, at, Precision::Exact)
}

/// Keeps the better point. An exact solution is better than an interior point, whose residuals may be smaller.
fn keep_better(
    best: &mut Option<Best>,
    point: Judged,
    exact: Option<&[ContactStatus]>,
    tolerance: f64,
) {
    let is_better = best.as_ref().is_none_or(|other| match (exact, &other.exact) {
        (Some(_), None) => true,
        (None, Some(_)) => false,
        _ => point.residuals.is_better_than(&other.point.residuals, tolerance),
    });
    if is_better {
        *best = Some(Best { point, exact: exact.map(<[_]>::to_vec) });
    }
}
