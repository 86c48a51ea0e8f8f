//! Springs that hold a contact problem, the bias that they cause, and their removal.

use std::ops::ControlFlow;

use super::constants::DOUBTS;
use super::interior::End;
use super::program::ProgramRun;
use super::settings::SoftConstraints;
use super::{QuadraticProgram, QuadraticProgramSettings};
use crate::problem::ratio;
use crate::{
    Bedding, Contact2d, ContactState, Error, Iteration, Observer, Residuals, Solution, Status,
};

/// The solution of a contact problem with soft springs on all displacements, and the effect of the springs.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SoftSolution {
    /// The status of the problem with springs.
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
    /// Estimate of the error of the displacements that the springs cause, relative to the displacements, in the norm
    /// `sqrt(sum k_j u_j^2)`: the change by re-centring the springs at the solution. Infinite if the re-centred problem
    /// was not solved.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub displacement_error: f64,
}

impl QuadraticProgram {
    /// The problem with a spring of stiffness `epsilon k_j` on every displacement, with the `k_j` of [`Bedding`], whose
    /// `K` is positive definite. Its only solution without friction differs from that of the problem without springs by
    /// `O(epsilon)`.
    ///
    /// # Errors
    /// [`Error::Setting`] for an `epsilon` outside `(0, 1]`, and the errors of [`Solver::solve`](crate::Solver::solve).
    pub fn solve_soft(&self, contact: &Contact2d, epsilon: f64) -> Result<SoftSolution, Error> {
        self.settings.validate(contact.order())?;
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
        let springs = Bedding::new(contact, soft.epsilon)?;
        let general = || contact.to_general();
        let mut run =
            ProgramRun::new(&self.settings, contact, &general, soft.max_recentrings, observer)?;
        let mut centre = vec![0.0; contact.displacements()];
        let (u, forces) = run.search.rest();
        let mut residual = run.search.judge(&u, &forces);
        let (mut idle, mut least) = (0, f64::INFINITY);
        let end = loop {
            if residual <= self.settings.tolerance {
                run.monitor.stop(residual);
                break Ok(End::ProgramPoint);
            }
            if let Some(status) = run.monitor.stop(residual) {
                break Err(status);
            }
            let sprung = springs.attached(contact, &centre)?;
            let mut solver = self.without_soft();
            solver.settings.time_limit = run.time();
            let solution = solver.solve_plain(&sprung, &mut |_| ControlFlow::Continue(()))?;
            run.steps += solution.info.factorisations;
            if !solution.is_solved() {
                break Err(solution.status);
            }
            let state = contact.recover(&solution.t, &solution.y);
            let (u, forces) = run.search.scaled.of_state(&state);
            residual = run.search.judge(&u, &forces);
            let share = springs.share(contact, &springs.forces(&state.u, &centre));
            idle = if share < 0.9 * least { 0 } else { idle + 1 };
            least = least.min(share);
            if idle > DOUBTS {
                run.monitor.history.push(residual);
                break Err(Status::Stalled);
            }
            centre = state.u;
        };
        Ok(run.finish(end))
    }

    /// The solver without springs, for a problem that has them.
    fn without_soft(&self) -> Self {
        Self::new(QuadraticProgramSettings { soft: None, ..self.settings.clone() })
    }
}
