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
use super::settings::SoftConstraints;
use super::{QuadraticProgram, QuadraticProgramSettings, confirmed, refused};
use crate::solve::Monitor;
use crate::{
    Bedding, Contact2d, ContactState, Error, Iteration, Observer, Residuals, Solution, Status,
};

/// A contact problem with soft springs on all displacements, solved, and what the springs changed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinity"))]
    pub displacement_error: f64,
}

impl QuadraticProgram {
    /// The problem with a spring of stiffness `epsilon k_j` on every displacement, with `k_j` as
    /// [`Bedding`] says: its `K` is positive definite, so that without friction it has exactly one
    /// solution, which differs from that of the problem without springs, where there is one, by
    /// `O(epsilon)`.
    ///
    /// # Errors
    /// [`Error::Setting`] for an `epsilon` outside `(0, 1]`, and as
    /// [`Solver::solve`](crate::Solver::solve).
    pub fn solve_soft(&self, contact: &Contact2d, epsilon: f64) -> Result<SoftSolution, Error> {
        self.settings.validate(contact.order())?;
        if let Some(reason) = indefiniteness("K", contact.stiffness()) {
            return Err(refused(&reason));
        }
        let springs = Bedding::new(contact, epsilon)?;
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
        let springs = Bedding::new(contact, soft.epsilon)?;
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
        let confirm = |it: &Candidate| confirmed(contact, it, settings.tolerance);
        Ok(self.concluded(best, end, &monitor, (Proof::new(&search), &confirm)))
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

fn ratio(a: f64, b: f64) -> f64 {
    if a <= 0.0 {
        0.0
    } else if b > 0.0 {
        a / b
    } else {
        f64::INFINITY
    }
}
