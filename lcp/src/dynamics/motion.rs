//! Steps one after the other: to other loads and supports, and to rest or flow.

use super::account::Taken;
use super::data::Data;
use super::{Account, Dynamics, Plan};
use crate::active::Effort;
use crate::problem::column_of;
use crate::solve::Monitor;
use crate::vector::max_abs;
use crate::{Contact2d, Error, Status};

/// How steps of a [`Dynamics`](crate::Dynamics) have ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ending {
    /// The bodies are under the loads and gaps that they were taken to, and may move.
    Arrived,
    /// They rest: their state solves the problem without mass.
    Rests,
    /// They move on for ever with the [velocity](crate::Dynamics::velocity) that they have.
    Flows,
    /// They have moved further than the problem means anything, and still move.
    Left,
    /// A limit was reached, or no step however short was solved ([`Status::Stalled`]).
    Open(Status),
}

impl Ending {
    /// Whether the bodies rest.
    pub fn rests(self) -> bool {
        self == Self::Rests
    }
}

/// No part of a way is shorter, and no step by this part of the first. Chosen: with twenty halvings in sequence something
/// else is wrong.
const LEAST_PART: f64 = 1e-6;
/// A velocity that changes less in a step of twice the length has settled, if it strains bodies and joints by less. Rounding:
/// displacements are far larger than those of a step.
const SETTLED: f64 = 1e-6;

impl Dynamics {
    /// To the data of `problem`, which change evenly in a time.
    pub(super) fn driven(
        &mut self,
        problem: &Contact2d,
        duration: f64,
        plan: &mut Plan,
        monitor: &mut Monitor<'_>,
    ) -> Result<Ending, Error> {
        let (begin, end) = (self.data.clone(), Data::of(problem));
        let origin = self.state.u.clone();
        let (mut done, mut part) = (0.0, 1.0_f64);
        while done < 1.0 {
            if let Some(limit) = monitor.stop(0.0) {
                return Ok(Ending::Open(limit));
            }
            let next = (done + part).min(1.0);
            let data = begin.towards(&end, next);
            let rests = self.is_quasi_static()
                && self.holds(problem, &data, &Effort::GIVEN, plan)?.is_some();
            let taken = if rests {
                None
            } else {
                Some(self.taken(problem, (&data, duration * (next - done)), plan, monitor)?)
            };
            match taken {
                None | Some(Taken::Yes(_)) => (done, part) = (next, 2.0 * part),
                Some(Taken::No(Status::Stalled)) => part = 0.5 * (next - done),
                Some(Taken::No(limit)) => return Ok(Ending::Open(limit)),
            }
            if self.is_beyond(&origin) {
                return Ok(Ending::Left);
            }
            if part < LEAST_PART {
                return Ok(Ending::Open(Status::Stalled));
            }
        }
        Ok(Ending::Arrived)
    }

    /// Under data that stay, until the bodies rest or flow.
    pub(super) fn settled(
        &mut self,
        problem: &Contact2d,
        first: f64,
        plan: &mut Plan,
        monitor: &mut Monitor<'_>,
    ) -> Result<Ending, Error> {
        let (data, origin) = (Data::of(problem), self.state.u.clone());
        let mut h = first;
        loop {
            if let Some(limit) = monitor.stop(0.0) {
                return Ok(Ending::Open(limit));
            }
            if self.is_slow() && self.holds(problem, &data, &Effort::QUICK, plan)?.is_some() {
                // A place far away where bodies would rest is none that they come to.
                return Ok(if self.is_beyond(&origin) { Ending::Left } else { Ending::Rests });
            }
            let before = self.motion_now();
            match self.taken(problem, (&data, h), plan, monitor)? {
                Taken::Yes(step) if self.flows(problem, &before, &step) => {
                    return Ok(Ending::Flows);
                }
                Taken::Yes(_) => h *= 2.0,
                Taken::No(Status::Stalled) => h *= 0.25,
                Taken::No(limit) => return Ok(Ending::Open(limit)),
            }
            if self.is_beyond(&origin) {
                return Ok(Ending::Left);
            }
            if h < LEAST_PART * first {
                return Ok(Ending::Open(Status::Stalled));
            }
        }
    }

    fn is_quasi_static(&self) -> bool {
        !self.settings.inertia
    }

    /// Whether rest can be looked for: moving bodies with inertia pass through states of equilibrium.
    fn is_slow(&self) -> bool {
        self.is_quasi_static() || max_abs(&self.velocity) <= 0.0
    }

    fn is_beyond(&self, origin: &[f64]) -> bool {
        let reach = self.settings.reach;
        self.state.u.iter().zip(origin).any(|(u, before)| (u - before).abs() > reach)
    }

    /// What the next step is compared with.
    fn motion_now(&self) -> Before {
        let forces = [self.state.t_n.clone(), self.state.t_t.clone()];
        Before { velocity: self.velocity.clone(), forces }
    }

    /// Whether the velocity goes on for ever: it is that of the step before, strains neither bodies nor joints, and takes no
    /// body to another contact, while the loads do work.
    fn flows(&self, problem: &Contact2d, before: &Before, step: &Account) -> bool {
        let v = &self.velocity;
        let size = max_abs(v);
        let change =
            v.iter().zip(&before.velocity).fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()));
        if !(step.work > 0.0 && size > 0.0 && change <= SETTLED * size) {
            return false;
        }
        let (n, m) = (v.len(), problem.points());
        let (mut strained, mut terms) = (vec![0.0; n], vec![0.0_f64; n]);
        let (mut rates, mut rate_terms) = (vec![0.0; m], vec![0.0_f64; m]);
        for (j, v) in v.iter().enumerate() {
            for (i, k) in column_of(problem.stiffness(), j) {
                strained[i] += k * v;
                terms[i] += (k * v).abs();
            }
            for (i, c) in column_of(problem.normal(), j) {
                rates[i] += c * v;
                rate_terms[i] += (c * v).abs();
            }
        }
        let is_free = strained.iter().zip(&terms).all(|(sum, terms)| sum.abs() <= SETTLED * terms);
        let is_ahead = |i: usize| self.state.t_n[i] <= 0.0 && rates[i] < -SETTLED * rate_terms[i];
        is_free && !(0..m).any(is_ahead) && self.keeps_forces(before)
    }

    /// Whether the forces of the contacts are those of the step before: springs of the joints are not strained.
    fn keeps_forces(&self, before: &Before) -> bool {
        let now = [&self.state.t_n, &self.state.t_t];
        let largest = max_abs(now[0]);
        let pairs = now.iter().zip(&before.forces).flat_map(|(a, b)| a.iter().zip(b));
        pairs.into_iter().all(|(a, b)| (a - b).abs() <= SETTLED * largest)
    }
}

/// How bodies moved in the step before.
struct Before {
    velocity: Vec<f64>,
    /// Normal and tangential ones.
    forces: [Vec<f64>; 2],
}
