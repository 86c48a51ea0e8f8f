//! One implicit step.

use std::ops::ControlFlow;

use super::account::Taken;
use super::data::Data;
use super::{Account, Dynamics, DynamicsSettings, METHOD, Plan};
use crate::active::{Effort, Original, Search};
use crate::interior::follow_path;
use crate::problem::{ContactStatus, column_of};
use crate::solve::Monitor;
use crate::states::nearest;
use crate::{Contact2d, ContactState, Error, Iteration, Solution, Status};

/// Steps of the path of interior points in one try. Measured on settlements of walls of 100 to 1000 bricks: those that are
/// solved take 20 to 45.
const PATH: usize = 80;

impl Dynamics {
    /// A step of the length `h` to some data, by whatever solves it.
    pub(super) fn taken(
        &mut self,
        problem: &Contact2d,
        (data, h): (&Data, f64),
        plan: &mut Plan,
        monitor: &mut Monitor<'_>,
    ) -> Result<Taken, Error> {
        let stepped = self.stepped(problem, data, Some(h));
        let (mut search, is_found) = self.by_states(&stepped, &Effort::QUICK, plan)?;
        let mut limit = None;
        let status = if is_found {
            Status::Solved
        } else {
            let mut observer = |at: &Iteration| {
                limit = monitor.stop(at.residual);
                if limit.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let tolerance = self.settings.tolerance;
            let mut own = Monitor::new(PATH, None, &mut observer);
            follow_path(&stepped, tolerance, &mut search, &mut own)
        };
        let solution = self.concluded(search, status, plan);
        if !solution.is_solved() {
            return Ok(Taken::No(limit.unwrap_or(Status::Stalled)));
        }
        Ok(Taken::Yes(self.moved(problem, (&stepped, data), Some(h), solution)))
    }

    /// Whether the states of the contacts, or those that they lead to with some effort, are those of bodies that rest under
    /// some data; then they are there.
    pub(super) fn holds(
        &mut self,
        problem: &Contact2d,
        data: &Data,
        effort: &Effort,
        plan: &mut Plan,
    ) -> Result<Option<Account>, Error> {
        let at_rest = self.stepped(problem, data, None);
        let (search, is_found) = self.by_states(&at_rest, effort, plan)?;
        let status = if is_found { Status::Solved } else { Status::Stalled };
        let solution = self.concluded(search, status, plan);
        Ok(solution.is_solved().then(|| self.moved(problem, (&at_rest, data), None, solution)))
    }

    /// The problem of a step of some length, or that of rest.
    fn stepped(&self, problem: &Contact2d, data: &Data, h: Option<f64>) -> Contact2d {
        let n = self.velocity.len();
        let (resistance, momentum) = h.map_or((0.0, 0.0), |h| {
            let inertia = if self.settings.inertia { 1.0 / h } else { 0.0 };
            ((inertia + self.settings.drag) / h, inertia)
        });
        let mut f = data.f.clone();
        for j in 0..n {
            let pull = resistance * self.state.u[j] + momentum * self.velocity[j];
            column_of(&self.mass, j).for_each(|(i, m)| f[i] += m * pull);
        }
        let s_0 = data.s_0.iter().zip(&self.slips[1]).map(|(s, slip)| s - slip).collect();
        problem.stepped((&self.mass, resistance), f, (data.x_0.clone(), s_0))
    }

    /// A search for the solution of a step, and whether the states of the contacts lead to it with some effort.
    fn by_states<'a>(
        &self,
        stepped: &'a Contact2d,
        effort: &Effort,
        plan: &mut Plan,
    ) -> Result<(Search<'a>, bool), Error> {
        let mut search = Search::planned(METHOD, stepped, self.settings.tolerance, plan.take())?;
        let (u, forces) = search.scaled.of_state(&self.state);
        search.judge(&u, &forces);
        let contacts = match &self.contacts {
            Some(contacts) => contacts.clone(),
            None => nearest(&search.scaled, &u, &forces),
        };
        let is_found = search.cross_over((&u, &forces), contacts, effort);
        Ok((search, is_found))
    }

    /// The end of a search, whose linear system is kept for the next one.
    fn concluded(&mut self, search: Search<'_>, status: Status, plan: &mut Plan) -> Solution {
        let before = search.condensed.factorisations;
        let (solution, condensed) = search.ended(status);
        self.factorisations += before;
        *plan = Some(condensed);
        solution
    }

    /// Goes to the solution of a step, and gives its account.
    fn moved(
        &mut self,
        problem: &Contact2d,
        (stepped, data): (&Contact2d, &Data),
        h: Option<f64>,
        solution: Solution,
    ) -> Account {
        let next = solution.contact.unwrap_or_else(|| unreachable!("a contact problem has one"));
        let contacts = if let Some(basis) = &solution.basis {
            Original::contacts(stepped, basis)
        } else {
            let scaled = stepped.scaled();
            let (u, forces) = scaled.of_state(&next);
            nearest(&scaled, &u, &forces)
        };
        let velocity: Vec<f64> = match h {
            Some(h) => next.u.iter().zip(&self.state.u).map(|(u, u_k)| (u - u_k) / h).collect(),
            None => vec![0.0; next.u.len()],
        };
        // What is computed for a contact that sticks is an error, and no slip.
        let slid = contacts.iter().zip(&next.slip);
        let slid: Vec<f64> = slid
            .map(|(contact, slip)| if *contact == ContactStatus::Stick { 0.0 } else { *slip })
            .collect();
        let mut step = self.of_bodies(problem, data, &next.u, &velocity);
        self.add_contacts(problem, data, (&next, &slid), &mut step);
        self.account.add(&step);
        let slips = self.slips[1].iter().zip(&slid).map(|(slip, more)| slip + more).collect();
        self.slips = [std::mem::take(&mut self.slips[1]), slips];
        (self.state, self.velocity, self.data) = (next, velocity, data.clone());
        self.contacts = Some(contacts);
        step
    }

    /// The account of a step as far as bodies and loads are concerned.
    fn of_bodies(&self, problem: &Contact2d, data: &Data, u: &[f64], velocity: &[f64]) -> Account {
        let mut step = Account::default();
        let DynamicsSettings { drag, inertia, .. } = self.settings;
        let (u_k, v_k) = (&self.state.u, &self.velocity);
        for j in 0..u.len() {
            let du = u[j] - u_k[j];
            step.work += data.f[j] * du;
            for (i, k) in column_of(problem.stiffness(), j) {
                step.stored += 0.5 * (u[i] + u_k[i]) * k * du;
                step.lost += 0.5 * (u[i] - u_k[i]) * k * du;
            }
            for (i, m) in column_of(&self.mass, j) {
                step.dragged += drag * velocity[i] * m * du;
                if inertia {
                    let dv = velocity[j] - v_k[j];
                    step.kinetic += 0.5 * (velocity[i] + v_k[i]) * m * dv;
                    step.lost += 0.5 * (velocity[i] - v_k[i]) * m * dv;
                }
            }
        }
        step
    }

    /// Adds what contacts and supports do in a step.
    fn add_contacts(
        &self,
        problem: &Contact2d,
        data: &Data,
        (next, slid): (&ContactState, &[f64]),
        step: &mut Account,
    ) {
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
    }
}
