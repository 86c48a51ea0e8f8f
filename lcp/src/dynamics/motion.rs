//! Steps one after the other: to other loads and supports, and to rest or flow.

use super::target::{Course, Data, Taken, Target};
use super::{Account, Dynamics};
use crate::parts::Parts;
use crate::problem::column_of;
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
    /// They have moved further than the problem means anything.
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
/// A velocity, a force or a rate that changes by a smaller part in a step of twice the length has settled. Rounding:
/// displacements are far larger than those of a step.
const SETTLED: f64 = 1e-6;
/// What strains a body by less, relative to the terms that it is the sum of, strains it by nothing. Rounding: errors of short
/// sums.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Dynamics {
    /// To the data of `problem`, which change evenly in a time.
    pub(super) fn driven(
        &mut self,
        problem: &Contact2d,
        duration: f64,
        course: &mut Course<'_, '_>,
    ) -> Result<Ending, Error> {
        let (begin, end) = (self.data.clone(), Data::of(problem));
        let origin = self.state.u.clone();
        let (mut done, mut part) = (0.0, 1.0_f64);
        while done < 1.0 {
            if let Some(limit) = course.monitor.stop(0.0) {
                return Ok(Ending::Open(limit));
            }
            let next = (done + part).min(1.0);
            let data = &begin.towards(&end, next);
            let h = Some(duration * (next - done));
            match self.taken(Target { problem, data, h }, course)? {
                Taken::Yes(_) => (done, part) = (next, 2.0 * part),
                Taken::No(Status::Stalled) => part = 0.5 * (next - done),
                Taken::No(limit) => return Ok(Ending::Open(limit)),
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
        course: &mut Course<'_, '_>,
    ) -> Result<Ending, Error> {
        let (data, origin) = (&Data::of(problem), self.state.u.clone());
        let mut h = first;
        while h >= LEAST_PART * first {
            if let Some(limit) = course.monitor.stop(0.0) {
                return Ok(Ending::Open(limit));
            }
            let rests = self.holds(Target { problem, data, h: None }, course)?;
            let before = self.motion_now();
            let taken = if rests {
                None
            } else {
                Some(self.taken(Target { problem, data, h: Some(h) }, course)?)
            };
            // A place far away where bodies would rest is none that they come to.
            if self.is_beyond(&origin) {
                return Ok(Ending::Left);
            }
            match taken {
                None => return Ok(Ending::Rests),
                Some(Taken::Yes(step)) if self.flows(problem, &before, &step) => {
                    return Ok(Ending::Flows);
                }
                Some(Taken::Yes(_)) => h *= 2.0,
                Some(Taken::No(Status::Stalled)) => h *= 0.25,
                Some(Taken::No(limit)) => return Ok(Ending::Open(limit)),
            }
        }
        Ok(Ending::Open(Status::Stalled))
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
        let (size, change) = (max_abs(&self.velocity), change(&self.velocity, &before.velocity));
        let forces = [&self.state.t_n, &self.state.t_t];
        let largest = max_abs(forces[0]);
        let is_loaded = step.work > 0.0 && size > 0.0;
        let is_same = change <= SETTLED * size
            && forces
                .iter()
                .zip(&before.forces)
                .all(|(now, was)| self::change(now, was) <= SETTLED * largest);
        is_loaded && is_same && !self.strains(problem) && !self.approaches(problem)
    }

    /// Whether the velocity strains any body: every one by itself, since what a soft one resists would be lost in the
    /// rounding errors of a stiff one.
    fn strains(&self, problem: &Contact2d) -> bool {
        let (v, k) = (&self.velocity, problem.stiffness());
        let mut bodies = Parts::new(v.len());
        (0..v.len()).for_each(|j| column_of(k, j).for_each(|(i, _)| bodies.join(i, j)));
        let mut strain = vec![(0.0, 0.0_f64); v.len()];
        for j in 0..v.len() {
            let (sum, terms) = &mut strain[bodies.of(j)];
            for (i, k) in column_of(k, j) {
                let term = v[i] * k * v[j];
                *sum += term;
                *terms += term.abs();
            }
        }
        strain.iter().any(|(sum, terms)| *sum > ROUNDING * terms)
    }

    /// Whether the velocity closes a gap that is open.
    fn approaches(&self, problem: &Contact2d) -> bool {
        let mut rates = vec![(0.0, 0.0_f64); problem.points()];
        for (j, v) in self.velocity.iter().enumerate() {
            for (i, c) in column_of(problem.normal(), j) {
                rates[i] = (rates[i].0 + c * v, rates[i].1 + (c * v).abs());
            }
        }
        let is_open = |t_n: &f64| *t_n <= 0.0;
        let rates = rates.iter().zip(&self.state.t_n).filter(|(_, t_n)| is_open(t_n));
        rates.into_iter().any(|((rate, terms), _)| *rate < -SETTLED * terms)
    }
}

/// How bodies moved in the step before.
struct Before {
    velocity: Vec<f64>,
    /// Normal and tangential ones.
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
    use crate::{ContactPoint, DynamicsSettings, Matrix};

    /// While a block is pushed against a soft spring its velocity hardly changes from one short step to the next.
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
            let mut moving = Dynamics::new(&problem, mass, DynamicsSettings::default()).unwrap();
            // Until the body itself is not strained any more.
            (0..5).for_each(|_| assert_eq!(moving.step(&problem, 1e-6).unwrap(), Status::Solved));
            let (before, account) = (moving.motion_now(), *moving.account());
            moving.step(&problem, 2e-6).unwrap();
            let step = moving.account().since(&account);
            assert_eq!(moving.flows(&problem, &before, &step), flows, "{spring}");
        }
    }
}
