//! The points that a method comes to, of which the best one is kept.

use super::crossover::{Effort, Vertex, cross_over};
use super::original::{At, Judge, Judged, Original, brought_right, confirmed};
use crate::certify::Precision;
use crate::problem::ContactStatus;
use crate::solve::Monitor;
use crate::states::{Condensed, Scaled, nearest};
use crate::{Error, Method, Solution, Status, WarmStart};

/// A problem with the best point so far.
pub(crate) struct Search<'a> {
    method: Method,
    problem: &'a dyn Original,
    judge: Box<dyn Judge + 'a>,
    tolerance: f64,
    pub(crate) scaled: Scaled,
    pub(crate) condensed: Condensed,
    /// With its states if it is exact.
    best: Option<(Judged, Option<Vertex>)>,
}

impl<'a> Search<'a> {
    /// For a method, with the largest residual of a solution.
    pub(crate) fn new(
        method: Method,
        problem: &'a dyn Original,
        tolerance: f64,
    ) -> Result<Self, Error> {
        let scaled = problem.scaled();
        let condensed = Condensed::new(&scaled).map_err(|error| Error::NotTreated {
            method,
            reason: format!("its sparse factors cannot be planned: {error}"),
        })?;
        let judge = problem.judge();
        Ok(Self { method, problem, judge, tolerance, scaled, condensed, best: None })
    }

    /// Whether the states of the contacts of a given start, if there is one, are the answer.
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
        self.cross_over((&u, &forces), contacts, &Effort::THOROUGH)
    }

    /// Whether nothing moves and no force acts, a point that iterations only come nearer to without end.
    /// Its states are asked for too, or not.
    pub(crate) fn try_rest(&mut self, crossover: bool) -> bool {
        let (u, forces) = self.rest();
        if self.judge(&u, &forces) > self.tolerance {
            return false;
        }
        if crossover {
            let contacts = nearest(&self.scaled, &u, &forces);
            self.cross_over((&u, &forces), contacts, &Effort::THOROUGH);
        }
        true
    }

    /// Whether a point is a solution, or what its contacts lead to with some effort.
    pub(crate) fn try_point(
        &mut self,
        at: (&[f64], &[(f64, f64)]),
        effort: Option<&Effort>,
    ) -> bool {
        let is_solved = self.judge(at.0, at.1) <= self.tolerance;
        let contacts = nearest(&self.scaled, at.0, at.1);
        effort.is_some_and(|effort| self.cross_over(at, contacts, effort)) || is_solved
    }

    /// Nothing moves and no force acts.
    pub(crate) fn rest(&self) -> (Vec<f64>, Vec<(f64, f64)>) {
        (vec![0.0; self.scaled.order()], vec![(0.0, 0.0); self.scaled.points.len()])
    }

    /// Whether the states of the contacts, or those that they lead to, are those of a solution.
    pub(crate) fn cross_over(
        &mut self,
        at: (&[f64], &[(f64, f64)]),
        contacts: Vec<ContactStatus>,
        effort: &Effort,
    ) -> bool {
        let Self { judge, tolerance, scaled, condensed, best, .. } = self;
        cross_over(scaled, condensed, at, contacts, effort, |condensed, vertex, is_consistent| {
            let point = (&vertex.u[..], &vertex.forces[..]);
            let contacts = || vertex.contacts.clone();
            let with = (judge.as_ref(), &*scaled, &mut *condensed);
            let mut judged = judged(with, point, *tolerance, contacts);
            if is_consistent || judged.worst() <= *tolerance {
                let with = (judge.as_ref(), &*scaled, condensed);
                judged = brought_right(with, (point, judged), &vertex.contacts, *tolerance);
            }
            let is_solution = judged.worst() <= *tolerance;
            keep_better(best, judged, is_solution.then_some(vertex), *tolerance);
            is_solution
        })
    }

    /// The worst residual of a point, which is kept if none was better.
    pub(crate) fn judge(&mut self, u: &[f64], forces: &[(f64, f64)]) -> f64 {
        let Self { judge, tolerance, scaled, condensed, best, .. } = self;
        let (mut u, mut forces) = (u.to_vec(), forces.to_vec());
        scaled.settle(&mut u, &mut forces);
        let contacts = || nearest(scaled, &u, &forces);
        let with = (judge.as_ref(), &*scaled, condensed);
        let judged = judged(with, (&u, &forces), *tolerance, contacts);
        let worst = judged.worst();
        keep_better(best, judged, None, *tolerance);
        worst
    }

    /// The worst residual of the best point.
    pub(crate) fn residual(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |(judged, _)| judged.worst())
    }

    /// The best point, with this status unless it is a solution.
    pub(crate) fn finish(self, otherwise: Status, monitor: Monitor<'_>) -> Solution {
        let Some((judged, vertex)) = self.best else {
            unreachable!("every solve judges a point");
        };
        let basis = vertex.map(|vertex| {
            let points = self.scaled.points.iter();
            let slips: Vec<f64> = points.map(|point| point.slip(&vertex.u)).collect();
            self.problem.basis(&vertex.contacts, &judged, &slips)
        });
        let Judged { t, y, contact, residuals } = judged;
        // Steps may end with a point that is solved and another that the iteration gave up.
        let otherwise = if otherwise == Status::Solved { Status::Stalled } else { otherwise };
        let mut solution = Solution::judged((t, y), residuals, self.tolerance, otherwise);
        solution.contact = contact;
        solution.basis = basis;
        solution.info = monitor.info(self.method);
        solution.info.factorisations = self.condensed.factorisations;
        solution
    }
}

/// Quickly, and with all digits where the point may be a solution.
fn judged(
    (judge, scaled, condensed): (&dyn Judge, &Scaled, &mut Condensed),
    at: At<'_>,
    tolerance: f64,
    contacts: impl FnOnce() -> Vec<ContactStatus>,
) -> Judged {
    let quick = judge.judged(scaled, at, Precision::Quick);
    if quick.worst() > tolerance {
        return quick;
    }
    confirmed((judge, scaled, condensed), at, &contacts(), tolerance)
}

/// An exact solution is better than a point inside, whose residuals may be smaller.
fn keep_better(
    best: &mut Option<(Judged, Option<Vertex>)>,
    judged: Judged,
    vertex: Option<&Vertex>,
    tolerance: f64,
) {
    let is_better = best.as_ref().is_none_or(|(other, exact)| match (vertex, exact) {
        (Some(_), None) => true,
        (None, Some(_)) => false,
        _ => judged.residuals.is_better_than(&other.residuals, tolerance),
    });
    if is_better {
        *best = Some((judged, vertex.cloned()));
    }
}
