//! One implicit step.

use std::ops::ControlFlow;

use super::target::{Course, Data, Rest, Taken, Target, close};
use super::{Account, Evolution, EvolutionSettings};
use crate::active::{Effort, Original, Search};
use crate::interior::follow_path;
use crate::problem::{ContactStatus, column_of};
use crate::solve::Monitor;
use crate::states::{PointRef, nearest};
use crate::vector::{ROUNDING, max_abs};
use crate::{Contact2d, ContactState, Error, Iteration, Method, Solution, Status};

impl Evolution {
    /// Takes a step by the first method that solves it. If bodies may rest, and a solution without drag is found next
    /// to the end of the step, they move to that solution instead: friction is the same, with slips measured from the
    /// same place.
    pub(super) fn taken(
        &mut self,
        target: Target<'_>,
        rest: Rest,
        course: &mut Course<'_, '_>,
    ) -> Result<Taken, Error> {
        let stepped = self.stepped(target);
        let state = ContactState { u: vec![0.0; self.state.u.len()], ..self.state.clone() };
        let now = StepEnd { state, contacts: self.contacts.clone() };
        let (mut search, is_found) = self.searched(&stepped, &now, &Effort::QUICK, course)?;
        let mut limit = None;
        let status = if is_found {
            Status::Solved
        } else {
            let mut observer = |at: &Iteration| {
                limit = course.monitor.stop_after(at.residual, at.step);
                if limit.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let EvolutionSettings { tolerance, max_iterations, .. } = self.settings;
            let mut own = Monitor::new(Method::Interior, max_iterations, None, &mut observer);
            follow_path(&stepped, tolerance, &mut search, &mut own)
        };
        let solution = self.concluded(search, status, course);
        if !solution.is_solved() || solution.basis.is_none() {
            return Ok(Taken::No(limit.unwrap_or(Status::Stalled)));
        }
        let end = end_of(&stepped, solution);
        let at_rest = Target { h: None, ..target };
        let rests = match rest {
            Rest::Never => false,
            Rest::ByStates => self.rests(at_rest, &end, &Effort::QUICK, course)?,
            Rest::ByPath => {
                self.rests(at_rest, &end, &Effort::THOROUGH, course)?
                    || matches!(self.taken(at_rest, Rest::Never, course)?, Taken::Yes(_))
            }
        };
        if rests {
            return Ok(Taken::Rests);
        }
        Ok(Taken::Yes(self.moved(target, end)))
    }

    /// Whether the states of the contacts at the end of a step, or those that they lead to, are those of bodies at
    /// rest; if so, moves the bodies there.
    fn rests(
        &mut self,
        at_rest: Target<'_>,
        from: &StepEnd,
        effort: &Effort,
        course: &mut Course<'_, '_>,
    ) -> Result<bool, Error> {
        let problem = self.stepped(at_rest);
        let (search, is_found) = self.searched(&problem, from, effort, course)?;
        let status = if is_found { Status::Solved } else { Status::Stalled };
        let solution = self.concluded(search, status, course);
        let added = solution.contact.as_ref().map(|it| &it.u[..]).unwrap_or_default();
        let rests = solution.is_solved() && !self.is_beyond(&self.displaced(added));
        if rests {
            self.moved(at_rest, end_of(&problem, solution));
        }
        Ok(rests)
    }

    /// The problem of the displacements that a step adds. Closed contacts begin the step with a gap and a slip of
    /// exactly zero: redundant contacts would contradict each other by the errors of earlier steps, and no forces,
    /// however large, would close all of them.
    fn stepped(&self, Target { problem, data, h }: Target<'_>) -> Contact2d {
        let EvolutionSettings { drag, inertia, .. } = self.settings;
        let (resistance, momentum) = h.map_or((0.0, 0.0), |h| {
            let momentum = if inertia { 1.0 / h } else { 0.0 };
            ((momentum + drag) / h, momentum)
        });
        let ContactState { u, t_n, t_t, gap, .. } = &self.state;
        let mut f = data.f.clone();
        for (j, (u, v)) in u.iter().zip(&self.velocity).enumerate() {
            column_of(problem.stiffness(), j).for_each(|(i, k)| f[i] -= k * u);
            column_of(&self.mass, j).for_each(|(i, m)| f[i] += m * momentum * v);
        }
        let compliance = problem.compliance();
        let x_0 = (0..gap.len())
            .map(|i| gap[i] + (data.x_0[i] - self.data.x_0[i]) - compliance[i][0] * t_n[i]);
        let s_0 =
            (0..gap.len()).map(|i| (data.s_0[i] - self.data.s_0[i]) - compliance[i][1] * t_t[i]);
        let (x_0, s_0) = (x_0.collect(), s_0.collect());
        problem.resisted(&self.mass, resistance).under(f, x_0, s_0)
    }

    /// A search for a solution, and whether the states of the contacts of a given end lead to one.
    fn searched<'a>(
        &self,
        problem: &'a Contact2d,
        from: &StepEnd,
        effort: &Effort,
        course: &mut Course<'_, '_>,
    ) -> Result<(Search<'a>, bool), Error> {
        let (tolerance, plan) = (self.settings.tolerance, course.plan.take());
        let mut search = Search::new(Method::Interior, problem, tolerance, plan)?;
        let (u, forces) = search.scaled.of_state(&from.state);
        search.judge(&u, &forces);
        let contacts = match &from.contacts[..] {
            [] => nearest(&search.scaled, &u, &forces),
            contacts => contacts.to_vec(),
        };
        let is_found = search.cross_over(PointRef { u: &u, forces: &forces }, contacts, effort);
        Ok((search, is_found))
    }

    /// The end of a search, whose linear system is kept for the next one.
    fn concluded(
        &mut self,
        mut search: Search<'_>,
        status: Status,
        course: &mut Course<'_, '_>,
    ) -> Solution {
        search.without_rounding();
        let (solution, condensed) = search.ended(status);
        self.factorisations += condensed.factorisations;
        course.plan = Some(condensed);
        solution
    }

    /// The displacements after a step that adds these.
    fn displaced(&self, added: &[f64]) -> Vec<f64> {
        self.state.u.iter().zip(added).map(|(u, du)| u + du).collect()
    }

    /// Moves to the end of a step and returns its account.
    fn moved(
        &mut self,
        target: Target<'_>,
        StepEnd { state: mut next, contacts }: StepEnd,
    ) -> Account {
        let Target { problem, data, h } = target;
        let total = self.displaced(&next.u);
        let added = std::mem::replace(&mut next.u, total);
        let velocity: Vec<f64> = match h {
            Some(h) => added.iter().map(|du| du / h).collect(),
            None => vec![0.0; added.len()],
        };
        close(&mut next, self.settings.tolerance);
        // Slips below the rounding errors of displacements, and those of contacts that stick, are zero.
        let least = ROUNDING * max_abs(&next.u);
        let slipped = |slip: &f64| if slip.abs() <= least { 0.0 } else { *slip };
        let slid = contacts.iter().zip(&next.slip).map(|(contact, slip)| {
            if *contact == ContactStatus::Stick { 0.0 } else { slipped(slip) }
        });
        let slid: Vec<f64> = slid.collect();
        let mut step = self.of_bodies(problem, data, &added, &velocity);
        step.add(&self.of_contacts(target, &next, &slid));
        self.account.add(&step);
        self.steps += 1;
        let slips = self.slips[1].iter().zip(&next.slip);
        let slips = slips.map(|(slip, more)| slip + slipped(more)).collect();
        self.slips = [std::mem::take(&mut self.slips[1]), slips];
        (self.state, self.velocity, self.data) = (next, velocity, data.clone());
        self.contacts = contacts;
        step
    }

    /// The part of the account of a step due to bodies and loads.
    fn of_bodies(&self, problem: &Contact2d, data: &Data, du: &[f64], velocity: &[f64]) -> Account {
        let mut step = Account::default();
        let EvolutionSettings { drag, inertia, .. } = self.settings;
        let (u_k, v_k) = (&self.state.u, &self.velocity);
        for j in 0..du.len() {
            step.work += data.f[j] * du[j];
            for (i, k) in column_of(problem.stiffness(), j) {
                step.stored += (u_k[i] + 0.5 * du[i]) * k * du[j];
                step.lost += 0.5 * du[i] * k * du[j];
            }
            for (i, m) in column_of(&self.mass, j) {
                step.dragged += drag * velocity[i] * m * du[j];
                if inertia {
                    let dv = velocity[j] - v_k[j];
                    step.kinetic += 0.5 * (velocity[i] + v_k[i]) * m * dv;
                    step.lost += 0.5 * (velocity[i] - v_k[i]) * m * dv;
                }
            }
        }
        step
    }

    /// The part of the account due to contacts and supports, which slide by these lengths to the next state.
    fn of_contacts(
        &self,
        Target { problem, data, .. }: Target<'_>,
        next: &ContactState,
        slid: &[f64],
    ) -> Account {
        let mut step = Account::default();
        let before = &self.state;
        let mut strain = |compliance: f64, force: f64, was: f64| {
            step.stored += 0.5 * compliance * (force + was) * (force - was);
            step.lost += 0.5 * compliance * (force - was) * (force - was);
        };
        for (i, [normal, tangential]) in problem.compliance().iter().enumerate() {
            strain(*normal, next.t_n[i], before.t_n[i]);
            if problem.mu()[i] > 0.0 {
                strain(*tangential, next.t_t[i], before.t_t[i]);
            }
        }
        for (i, mu) in problem.mu().iter().enumerate() {
            let (t_n, t_t) = (next.t_n[i], next.t_t[i]);
            step.work -= t_n * (data.x_0[i] - self.data.x_0[i]);
            // A gap that was open and has closed within the step.
            step.lost -= t_n * (next.gap[i] - before.gap[i]);
            if *mu > 0.0 {
                step.work -= t_t * (data.s_0[i] - self.data.s_0[i]);
                let taken = -t_t * slid[i];
                step.dissipation += taken;
                step.created += (-taken).max(0.0);
                step.capacity += mu * t_n * slid[i].abs();
            }
        }
        step
    }
}

/// The end of a step: the displacements that it adds, and the state of the contacts.
struct StepEnd {
    state: ContactState,
    /// States of the contacts; empty if not known.
    contacts: Vec<ContactStatus>,
}

fn end_of(problem: &Contact2d, solution: Solution) -> StepEnd {
    let state = solution.contact.unwrap_or_else(|| unreachable!("a contact problem has one"));
    let contacts = if let Some(basis) = &solution.basis {
        Original::contacts(problem, basis)
    } else {
        let scaled = problem.scaled();
        let (u, forces) = scaled.of_state(&state);
        nearest(&scaled, &u, &forces)
    };
    StepEnd { state, contacts }
}
