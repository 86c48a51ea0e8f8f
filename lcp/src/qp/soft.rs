//! Springs that hold a contact problem, the bias that they cause, and their removal.

use std::ops::ControlFlow;
use std::time::Instant;

use super::contact::primal_form;
use super::definite::indefiniteness;
use super::farkas::farkas_vector;
use super::form::Point;
use super::interior::End;
use super::program::{Best, Candidate, Proof};
use super::reduced::Place;
use super::scale::Scaled;
use super::settings::{SoftConstraints, check_epsilon};
use super::{QuadraticProgram, QuadraticProgramSettings, refused};
use crate::problem::{column_of, max_abs};
use crate::solve::Monitor;
use crate::{
    Contact2d, ContactState, Error, Iteration, Matrix, Observer, Residuals, Solution, Status,
};

/// A contact problem with soft springs on all displacements, solved, and what the springs changed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SoftSolution {
    /// Of the problem with springs.
    pub status: Status,
    /// Displacements and forces of the problem with springs.
    pub state: ContactState,
    /// Residuals of the state in the problem with springs.
    pub with_springs: Residuals,
    /// Residuals of the state in the problem without springs.
    pub without_springs: Residuals,
    /// The forces of the springs, `-epsilon k_j u_j`.
    pub spring_forces: Vec<f64>,
    /// The share of the load that the springs carry: `|spring forces| / |f|` in the norm
    /// `sqrt(sum f_j^2 / k_j)`, in which units do not matter.
    pub spring_share: f64,
    /// Estimate of the error of the displacements that the springs cause, relative to the displacements, in
    /// the norm `sqrt(sum k_j u_j^2)`: what centring the springs at the solution changes. Infinite where
    /// that problem was not solved.
    pub displacement_error: f64,
}

impl QuadraticProgram {
    /// The problem with a spring of stiffness `epsilon k_j` on every displacement, with `k_j` as
    /// [`SoftConstraints`] says: its `K` is positive definite, so that without friction it has exactly one
    /// solution, which differs from that of the problem without springs, where there is one, by
    /// `O(epsilon)`.
    ///
    /// # Errors
    /// [`Error::Setting`] for an `epsilon` outside `(0, 1]`, and as
    /// [`Solver::solve`](crate::Solver::solve).
    pub fn solve_soft(&self, contact: &Contact2d, epsilon: f64) -> Result<SoftSolution, Error> {
        check_epsilon(epsilon)?;
        self.settings.validate(contact.order())?;
        if let Some(reason) = indefiniteness("K", contact.stiffness()) {
            return Err(refused(&reason));
        }
        let springs = Springs::new(contact, epsilon);
        let solver = self.without_soft();
        let mut ignore = |_: &Iteration| ControlFlow::Continue(());
        let rest = vec![0.0; contact.displacements()];
        let sprung = springs.attached(contact, &rest)?;
        let solution = solver.solve_plain(&sprung, &mut ignore)?;
        let state = sprung.recover(&solution.t, &solution.y);
        let again = solver.solve_plain(&springs.attached(contact, &state.u)?, &mut ignore)?;
        let moved = sprung.recover(&again.t, &again.y).u;
        let change: Vec<f64> = moved.iter().zip(&state.u).map(|(a, b)| a - b).collect();
        let spring_forces = springs.forces(&state.u, &rest);
        Ok(SoftSolution {
            status: solution.status,
            with_springs: solution.residuals,
            without_springs: contact.residuals(&state),
            spring_share: springs.share(contact, &spring_forces),
            spring_forces,
            displacement_error: if again.is_solved() {
                ratio(springs.size(&change), springs.size(&moved))
            } else {
                f64::INFINITY
            },
            state,
        })
    }

    /// Proximal steps: the springs are centred at the last solution until it solves the problem without
    /// springs (Rockafellar 1976).
    pub(super) fn solve_recentred(
        &self,
        contact: &Contact2d,
        soft: SoftConstraints,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        /// Steps in which the springs let go of nothing.
        const IDLE: usize = 6;
        let settings = &self.settings;
        let springs = Springs::new(contact, soft.epsilon);
        let began = Instant::now();
        let mut monitor = Monitor::new(soft.max_recentrings, settings.time_limit, observer);
        let mut centre = vec![0.0; contact.displacements()];
        let scaled = Scaled::new(&primal_form(contact));
        let assemble =
            |point: &Point, _: Option<&[Place]>| Candidate::of(contact, &state_of(contact, point));
        let mut best = Best::new(&scaled, &assemble);
        let (mut idle, mut least) = (0, f64::INFINITY);
        let mut residual = best.residual;
        let end = loop {
            if residual <= settings.tolerance {
                monitor.stop(residual);
                break Ok(End::Point);
            }
            if let Some(status) = monitor.stop(residual) {
                break Err(status);
            }
            let sprung = springs.attached(contact, &centre)?;
            let mut solver = self.without_soft();
            solver.settings.time_limit = self.effort(began).time;
            let solution = solver.solve_plain(&sprung, &mut |_| ControlFlow::Continue(()))?;
            best.factorisations += solution.info.factorisations;
            if !solution.is_solved() {
                break Err(solution.status);
            }
            let state = contact.recover(&solution.t, &solution.y);
            let point = scaled.scaled(&point_of(contact, &state));
            residual = best.offer(&scaled, (&point, None), &assemble);
            let share = springs.share(contact, &springs.forces(&state.u, &centre));
            idle = if share < 0.9 * least { 0 } else { idle + 1 };
            least = least.min(share);
            if idle > IDLE {
                monitor.history.push(residual);
                break Err(Status::Stalled);
            }
            centre = state.u;
        };
        let search = || farkas_vector(&contact.to_general(), self.effort(began));
        Ok(self.concluded(best, end, &monitor, Proof::new(&search)))
    }

    /// The same solver for a problem that has its springs.
    fn without_soft(&self) -> Self {
        Self::new(QuadraticProgramSettings { soft: None, ..self.settings.clone() })
    }
}

/// Unknowns of the primal form.
fn point_of(contact: &Contact2d, state: &ContactState) -> Point {
    let friction = contact.frictional().iter().map(|&i| state.t_t[i]);
    Point { x: state.u.clone(), lambda: state.t_n.iter().copied().chain(friction).collect() }
}

fn state_of(contact: &Contact2d, point: &Point) -> ContactState {
    let (t_n, friction) = point.lambda.split_at(contact.points());
    let mut t_t = vec![0.0; contact.points()];
    for (&i, t) in contact.frictional().iter().zip(friction) {
        t_t[i] = *t;
    }
    contact.state(point.x.clone(), t_n.to_vec(), t_t)
}

/// The stiffnesses of the springs.
struct Springs {
    /// `k_j`.
    unit: Vec<f64>,
    epsilon: f64,
}

impl Springs {
    fn new(contact: &Contact2d, epsilon: f64) -> Self {
        Self { unit: units(contact), epsilon }
    }

    /// The problem with springs that are at rest at `centre`.
    fn attached(&self, contact: &Contact2d, centre: &[f64]) -> Result<Contact2d, Error> {
        let n = contact.displacements();
        let stiffness = |j: usize| self.epsilon * self.unit[j];
        let k = contact.stiffness();
        let entries = (0..n).flat_map(|j| column_of(k, j).map(move |(i, v)| (i, j, v)));
        let k = Matrix::from_entries(n, n, entries.chain((0..n).map(|j| (j, j, stiffness(j)))));
        let f = contact.loads().iter().zip(centre).enumerate();
        let f = f.map(|(j, (f, u))| f + stiffness(j) * u).collect();
        let [c_n, c_t] = [contact.normal(), contact.tangent()].map(|c| Matrix::from(c.clone()));
        let (x_0, s_0) = (contact.initial_gaps().to_vec(), contact.initial_slips().to_vec());
        Contact2d::new(k, f, c_n, c_t, x_0, s_0, contact.mu().to_vec())
    }

    fn forces(&self, u: &[f64], centre: &[f64]) -> Vec<f64> {
        let forces = u.iter().zip(centre).zip(&self.unit);
        forces.map(|((u, centre), k)| -self.epsilon * k * (u - centre)).collect()
    }

    /// Of the load, carried by these forces.
    fn share(&self, contact: &Contact2d, forces: &[f64]) -> f64 {
        let size = |v: &[f64]| norm(v.iter().zip(&self.unit).map(|(v, k)| v / k.sqrt()));
        ratio(size(forces), size(contact.loads()))
    }

    /// Of displacements.
    fn size(&self, u: &[f64]) -> f64 {
        norm(u.iter().zip(&self.unit).map(|(u, k)| u * k.sqrt()))
    }
}

/// See [`SoftConstraints`].
fn units(contact: &Contact2d) -> Vec<f64> {
    let n = contact.displacements();
    let diagonal = |j: usize| contact.stiffness().get(j, j).copied().unwrap_or(0.0);
    let squared: Vec<f64> = (0..n)
        .map(|j| {
            let both = [contact.normal(), contact.tangent()];
            both.into_iter().flat_map(|c| column_of(c, j)).map(|(_, v)| v * v).sum()
        })
        .collect();
    let logs: Vec<f64> = (0..n)
        .filter(|&j| diagonal(j) > 0.0 && squared[j] > 0.0)
        .map(|j| (diagonal(j) / squared[j]).ln())
        .collect();
    let mean = if logs.is_empty() {
        let force = (0..n)
            .filter(|&j| squared[j] > 0.0)
            .map(|j| contact.loads()[j].abs() / squared[j].sqrt())
            .fold(0.0, f64::max);
        let length = max_abs(contact.initial_gaps()).max(max_abs(contact.initial_slips()));
        let length = if length > 0.0 { length } else { 1.0 };
        if force > 0.0 { force / length } else { 1.0 }
    } else {
        (logs.iter().sum::<f64>() / logs.len() as f64).exp()
    };
    let unit = |j: usize| {
        let from_contact = mean * squared[j];
        match diagonal(j) {
            stiffness if stiffness > 0.0 => stiffness,
            _ if from_contact > 0.0 => from_contact,
            _ => mean,
        }
    };
    (0..n).map(unit).collect()
}

fn norm(v: impl Iterator<Item = f64>) -> f64 {
    v.map(|v| v * v).sum::<f64>().sqrt()
}

fn ratio(a: f64, b: f64) -> f64 {
    if a <= 0.0 {
        0.0
    } else if b > 0.0 {
        a / b
    } else {
        f64::INFINITY
    }
}
