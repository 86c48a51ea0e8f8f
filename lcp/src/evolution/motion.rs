//! Sequences of steps: to other loads and supports, and to rest or flow.

use super::target::{Course, Data, Rest, Taken, Target};
use super::{Account, Evolution};
use crate::parts::Parts;
use crate::problem::column_of;
use crate::vector::{HALF_DIGITS, ROUNDING, max_abs};
use crate::{Contact2d, Error, Status};

/// The ending of the steps of an [`Evolution`](crate::Evolution).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Ending {
    /// The bodies have reached the given loads and gaps, and may move.
    Arrived,
    /// The bodies rest: their state solves the problem without mass.
    Rests,
    /// The bodies move on for ever with their present [velocity](crate::Evolution::velocity).
    Flows,
    /// The bodies have moved beyond the reach of the settings.
    Left,
    /// A limit was reached, or no step was solved, however short ([`Status::Stalled`]).
    Open(Status),
}

impl Ending {
    /// Whether the bodies rest.
    pub fn rests(self) -> bool {
        self == Self::Rests
    }

    /// The status of an ending: solved, no equilibrium, or the reason for which the outcome is unknown.
    pub fn status(self) -> Status {
        match self {
            Self::Rests => Status::Solved,
            Self::Flows | Self::Left => Status::NoEquilibrium,
            Self::Open(status) => status,
            Self::Arrived => Status::Stalled,
        }
    }
}

/// A velocity is constant if it changes by a smaller part in a step of twice the length; its strains do not resist if
/// they would take a smaller part of the work of the loads within the reach; gaps that it closes by a smaller part of
/// the motion do not close. Chosen: far below the accuracy of limit loads.
const SETTLED: f64 = 1e-2;

impl Evolution {
    /// Moves to the data of `problem`, which change evenly in a time; and to rest there, if bodies may rest and do.
    pub(super) fn driven(
        &mut self,
        problem: &Contact2d,
        duration: f64,
        rest: Rest,
        course: &mut Course<'_, '_>,
    ) -> Result<Ending, Error> {
        let (begin, end) = (self.data.clone(), Data::of(problem));
        let (mut done, mut part, mut growth) = (0.0, 1.0_f64, 2.0);
        while done < 1.0 {
            if let Some(limit) = self.stopped(course) {
                return Ok(Ending::Open(limit));
            }
            let next = (done + part).min(1.0);
            let data = &begin.towards(&end, next);
            let h = Some(duration * (next - done));
            let rest = if next >= 1.0 { rest } else { Rest::Never };
            match self.taken(Target { problem, data, h }, rest, course)? {
                Taken::Yes(_) => (done, part, growth) = (next, growth * part, 2.0),
                Taken::Rests => return Ok(Ending::Rests),
                Taken::No(Status::Stalled) => (part, growth) = (0.5 * (next - done), 1.0),
                Taken::No(limit) => return Ok(Ending::Open(limit)),
            }
            if self.is_beyond(&self.state.u) {
                return Ok(Ending::Left);
            }
            // A step that needs this number of halvings fails for another reason than its length.
            if part < HALF_DIGITS {
                return Ok(Ending::Open(Status::Stalled));
            }
        }
        Ok(Ending::Arrived)
    }

    /// Moves to the data of `problem`, and on until the bodies rest or flow.
    pub(super) fn led(
        &mut self,
        problem: &Contact2d,
        duration: f64,
        course: &mut Course<'_, '_>,
    ) -> Result<Ending, Error> {
        match self.driven(problem, duration, Rest::ByPath, course)? {
            Ending::Arrived => self.settled(problem, duration, course),
            other => Ok(other),
        }
    }

    /// Moves under constant data until the bodies rest or flow.
    pub(super) fn settled(
        &mut self,
        problem: &Contact2d,
        first: f64,
        course: &mut Course<'_, '_>,
    ) -> Result<Ending, Error> {
        let data = &Data::of(problem);
        let (mut h, mut growth) = (first, 2.0);
        while h >= HALF_DIGITS * first {
            if let Some(limit) = self.stopped(course) {
                return Ok(Ending::Open(limit));
            }
            let before = self.motion_now();
            match self.taken(Target { problem, data, h: Some(h) }, Rest::ByStates, course)? {
                Taken::Rests => return Ok(Ending::Rests),
                Taken::Yes(step) if self.flows(problem, &before, &step, h) => {
                    return Ok(Ending::Flows);
                }
                Taken::Yes(_) if self.is_beyond(&self.state.u) => return Ok(Ending::Left),
                Taken::Yes(_) => (h, growth) = (growth * h, 2.0),
                Taken::No(Status::Stalled) => (h, growth) = (0.25 * h, 1.0),
                Taken::No(limit) => return Ok(Ending::Open(limit)),
            }
        }
        Ok(Ending::Open(Status::Stalled))
    }

    /// The limit that was reached, before a step.
    fn stopped(&self, course: &mut Course<'_, '_>) -> Option<Status> {
        let is_spent = self.factorisations >= course.last;
        course.monitor.stop(0.0).or_else(|| is_spent.then_some(Status::IterationLimit))
    }

    /// Whether these displacements are larger than those for which the problem is valid.
    pub(super) fn is_beyond(&self, u: &[f64]) -> bool {
        max_abs(u) > self.settings.reach
    }

    /// The motion with which the next step is compared.
    fn motion_now(&self) -> Before {
        let forces = [self.state.t_n.clone(), self.state.t_t.clone()];
        Before { velocity: self.velocity.clone(), forces }
    }

    /// Whether the velocity goes on until bodies are out of reach, or for ever: it equals that of the step before,
    /// strains neither bodies nor joints enough to stop the motion, and closes no gap, while the loads do work.
    fn flows(&self, problem: &Contact2d, before: &Before, step: &Account, h: f64) -> bool {
        let size = max_abs(&self.velocity);
        let is_moved = step.work > 0.0 && size > 0.0;
        if !is_moved || change(&self.velocity, &before.velocity) > SETTLED * size {
            return false;
        }
        let steps = self.settings.reach / (size * h);
        let strain = self.strain(problem, before, h);
        (strain == 0.0 || steps * strain <= SETTLED * step.work)
            && !self.approaches(problem, self.settings.reach / size)
    }

    /// The work of the last step that the change of strains of bodies and joints takes, if that is more than rounding
    /// errors: each by itself, since the resistance of a soft one would be lost in the errors of a stiff one.
    fn strain(&self, problem: &Contact2d, before: &Before, h: f64) -> f64 {
        let (v, k) = (&self.velocity, problem.stiffness());
        let mut bodies = Parts::new(v.len());
        (0..v.len()).for_each(|j| column_of(k, j).for_each(|(i, _)| bodies.join(i, j)));
        let mut strain = vec![(0.0, 0.0_f64); v.len()];
        for j in 0..v.len() {
            let (sum, terms) = &mut strain[bodies.of(j)];
            for (i, k) in column_of(k, j) {
                let term = h * v[i] * k * h * v[j];
                *sum += term;
                *terms += term.abs();
            }
        }
        let above = |(sum, terms): &(f64, f64)| if *sum > ROUNDING * terms { *sum } else { 0.0 };
        let of_bodies: f64 = strain.iter().map(above).sum();
        let largest = max_abs(&self.state.t_n);
        let joints = [&self.state.t_n, &self.state.t_t].into_iter().zip(&before.forces).enumerate();
        let of_joints = joints.flat_map(|(k, (now, was))| {
            let changes = now.iter().zip(was).map(|(now, was)| now - was);
            changes.zip(problem.compliance()).map(move |(change, compliance)| {
                let is_some = change.abs() > ROUNDING * largest;
                if is_some { compliance[k] * change * change } else { 0.0 }
            })
        });
        of_bodies + of_joints.sum::<f64>()
    }

    /// Whether the velocity closes a gap that is open within a time.
    fn approaches(&self, problem: &Contact2d, time: f64) -> bool {
        let mut rates = vec![(0.0, 0.0_f64); problem.points()];
        for (j, v) in self.velocity.iter().enumerate() {
            for (i, c) in column_of(problem.normal(), j) {
                rates[i] = (rates[i].0 + c * v, rates[i].1 + (c * v).abs());
            }
        }
        let gaps = rates.iter().zip(&self.state.gap).zip(&self.state.t_n);
        let mut open = gaps.filter(|(_, t_n)| **t_n <= 0.0);
        open.any(|(((rate, terms), gap), _)| *rate < -SETTLED * terms && *gap < -rate * time)
    }
}

/// The motion of bodies in the step before.
struct Before {
    velocity: Vec<f64>,
    /// Normal and tangential forces.
    forces: [Vec<f64>; 2],
}

/// The largest difference of two vectors.
fn change(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |max, (a, b)| max.max((a - b).abs()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

    use super::*;
    use crate::{ContactPoint, EvolutionSettings, Matrix};

    /// The velocity of a block that is pushed against a soft spring hardly changes from one short step to the next.
    #[test]
    fn a_body_that_a_soft_spring_will_stop_does_not_flow() {
        for (spring, flows) in [(0.0, true), (1e-2, false), (1e-1, false)] {
            let body = 1e10;
            let k = [[body, -body, 0.0], [-body, body + spring, 0.0], [0.0; 3]];
            let mut builder = Contact2d::builder(k, vec![10.0, 0.0, -10.0]);
            builder.add_point(ContactPoint {
                normal: &[(2, 1.0)],
                tangent: &[(0, 1.0)],
                mu: 0.5,
                ..Default::default()
            });
            let problem = builder.build().unwrap();
            let mass = Matrix::from_triplets(3, 3, &[0, 1, 2].map(|j| (j, j, 1.0))).unwrap();
            let mut moving = Evolution::new(&problem, mass, EvolutionSettings::default()).unwrap();
            // Steps until the body itself is not strained any more.
            (0..5).for_each(|_| assert_eq!(moving.step(&problem, 1e-6).unwrap(), Status::Solved));
            let (before, account) = (moving.motion_now(), *moving.account());
            moving.step(&problem, 2e-6).unwrap();
            let step = moving.account().since(&account);
            assert_eq!(moving.flows(&problem, &before, &step, 2e-6), flows, "{spring}");
        }
    }
}
