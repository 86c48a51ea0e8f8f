//! Newton's method on contact problems with friction: which contacts are open, stick and slide.

use super::SemismoothNewton;
use super::constants::{
    EXACT, EXCHANGES, FAILURES, FEW, GLUE, HARDER, INEXACT, LEAST_SPRING, LEAST_STIFFNESS, MORE,
    MOST_STIFFNESS, ROUNDS, SOFTER, SPRING, STEPS, STIFFER, STIFFNESS,
};
use super::proximal::{Proximal, ProximalPoint};
use crate::active::{Effort, Search};
use crate::problem::ContactStatus;
use crate::solve::Monitor;
use crate::states::{PointRef, Springs};
use crate::{Contact2d, Error, Method, Observer, Solution, Solver, Status};

impl Solver<Contact2d> for SemismoothNewton {
    fn method(&self) -> Method {
        Method::Newton
    }

    fn solve_pairs(
        &self,
        problem: &Contact2d,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let settings = self.settings();
        settings.validate(problem.order())?;
        let monitor = Monitor::new(settings.max_iterations, settings.time_limit, observer);
        let mut search = Search::new(Method::Newton, problem, settings.tolerance)?;
        let is_tried = search.try_start(&settings.start) || search.try_rest(true);
        let mut rounds = Rounds { tolerance: settings.tolerance, search, monitor };
        let status = if is_tried { Status::Solved } else { rounds.run() };
        let Rounds { search, mut monitor, .. } = rounds;
        if matches!(status, Status::Solved | Status::Stalled) {
            // Where it ended; before every step it is noted where that began.
            monitor.history.push(search.residual());
        }
        Ok(search.finish(status, monitor))
    }
}

/// Rounds of Newton's method, each with springs that are centred where the last one ended.
struct Rounds<'a, 'b> {
    tolerance: f64,
    search: Search<'a>,
    monitor: Monitor<'b>,
}

impl Rounds<'_, '_> {
    fn run(&mut self) -> Status {
        let (mut u, mut forces) = self.glued();
        let (mut stiffness, mut spring) = (STIFFNESS, SPRING);
        let (mut failures, mut answers) = (0, 0);
        for _ in 0..ROUNDS {
            let proximal = Proximal { centre: &u, forces: &forces, spring, stiffness };
            let round = match self.round(&proximal) {
                Ok(round) => round,
                Err(status) => return status,
            };
            if round.is_solved && self.is_answer(&round.at) {
                answers += 1;
                if self.search.residual() <= EXACT || answers > MORE {
                    return Status::Solved;
                }
            }
            if round.is_solved {
                failures = 0;
                spring = (SOFTER * spring).max(LEAST_SPRING);
                if round.steps <= FEW {
                    stiffness = (STIFFER * stiffness).min(MOST_STIFFNESS);
                }
            } else {
                failures += 1;
                if failures > FAILURES {
                    break;
                }
                spring *= HARDER;
                stiffness = (stiffness / STIFFER).max(LEAST_STIFFNESS);
            }
            if round.is_nearer {
                (u, forces) = (round.at.u, round.at.forces);
            }
        }
        Status::Stalled
    }

    /// Displacements if all contacts stuck, also where that takes tension, and the forces of those that do not.
    fn glued(&mut self) -> (Vec<f64>, Vec<(f64, f64)>) {
        let Search { scaled, condensed, .. } = &mut self.search;
        let (stiffness, spring) = GLUE;
        let points = || scaled.points.iter();
        let springs: Vec<Springs> =
            points().map(|point| ContactStatus::Stick.springs(point, stiffness)).collect();
        condensed.factorise(scaled, &springs, spring);
        let pulls = points().zip(&springs).map(|(p, springs)| springs.forces(-p.x_0, -p.s_0));
        let rest = vec![0.0; scaled.order()];
        let mut u = scaled.unbalanced(&rest, pulls);
        condensed.solve(&mut u);
        let none = vec![(0.0, 0.0); scaled.points.len()];
        let proximal = Proximal { centre: &rest, forces: &none, spring, stiffness };
        let at = proximal.at(scaled, u);
        (at.u, at.forces)
    }

    /// Newton's steps for fixed springs; a status where there must be no more of them.
    fn round(&mut self, proximal: &Proximal<'_>) -> Result<Round, Status> {
        let mut at = proximal.at(&self.search.scaled, proximal.centre.to_vec());
        let first = at.unbalanced();
        for steps in 1..=STEPS {
            let residual = self.search.judge(&at.u, &at.forces);
            if let Some(status) = self.monitor.stop(residual) {
                return Err(status);
            }
            let Search { scaled, condensed, .. } = &mut self.search;
            let (next, is_exact) = proximal.step(scaled, condensed, &at);
            at = next;
            let left = at.unbalanced();
            if left.is_finite() && (is_exact || left <= INEXACT * first) {
                return Ok(Round { at, steps, is_solved: true, is_nearer: true });
            }
        }
        let is_nearer = at.unbalanced() <= first;
        Ok(Round { at, steps: STEPS, is_solved: false, is_nearer })
    }

    /// Whether a point is the answer, or its states lead to it.
    fn is_answer(&mut self, at: &ProximalPoint) -> bool {
        let is_near = self.search.judge(&at.u, &at.forces) <= self.tolerance;
        let effort = if is_near { &Effort::THOROUGH } else { &EXCHANGES };
        let point = PointRef { u: &at.u, forces: &at.forces };
        self.search.cross_over(point, at.contacts.clone(), effort) || is_near
    }
}

/// Where a round ended.
struct Round {
    at: ProximalPoint,
    steps: usize,
    /// Well enough.
    is_solved: bool,
    /// Less is unbalanced than at its start.
    is_nearer: bool,
}
