//! Rigid bodies at rest: contacts that can all be closed at once, and forces on them.
//!
//! Near rest some contacts carry little force over a small gap. If one of them is taken for closed that has to open, the
//! equations of the contacts have no solution, and forces of rigid bodies are not unique either. But nothing relates their
//! forces to displacements, so that both can be found one after the other, each by a convex program:
//!
//! 1. Bodies go the way `v` that normal forces `t_n` press them, `min eta v.v / 2 + t_n.g` over gaps `g = g_0 + C_n v >= 0`.
//!    Contacts that cannot be closed at once with the others open.
//! 2. On the contacts that are closed then, the forces inside their cones that balance the loads and are the nearest to
//!    those before.
//!
//! What is left of the gaps of closed contacts decreases by some powers of ten a round.

use super::constants::{
    BALANCED, CLEARLY_CLOSED, CLOSED, KEPT, KEPT_EXACTLY, REACH, REFINED, ROUND, ROUNDS,
};
use super::factors::Factors;
use super::homogeneous::{Accuracy, solved};
use super::iterate::{Iterate, Rest};
use super::program::{Program, Units, along};
use super::variables::Variables;
use crate::Status;
use crate::states::{Condensed, Point, Scaled, Springs};

/// The state at rest next to a point that is `accepted`. `go_on` is asked before every step, with the residual.
pub(super) fn rigid_rest<T>(
    problem: &Scaled,
    condensed: &mut Condensed,
    at: &Iterate,
    mut go_on: impl FnMut(f64) -> bool,
    mut accepted: impl FnMut(&mut Condensed, Rest) -> Option<T>,
) -> Option<T> {
    let is_closed = at.points.iter().map(|it| it.gap <= CLEARLY_CLOSED * it.t_n);
    let mut contacts = Contacts { u: at.u.clone(), is_closed: is_closed.collect() };
    let mut forces = at.forces();
    let mut solve = |program: Program, condensed: &mut Condensed, how| {
        let (program, units) = program.scaled();
        let mut factors = Factors::of(&program).ok()?;
        let mut left = ROUND;
        let stop = |residual| {
            left = left.saturating_sub(1);
            (!go_on(residual) || left == 0).then_some(Status::IterationLimit)
        };
        let (found, status) = solved(&program, &mut factors, how, stop, |_| false);
        condensed.factorisations += factors.factorisations;
        (status == Status::Solved).then_some((found, units))
    };
    for _ in 0..ROUNDS {
        let (program, pressed) = contacts.pressed(problem, &forces);
        let how = (KEPT, Accuracy::of_all(CLOSED));
        contacts.move_to(&solve(program, condensed, how)?, &pressed);
        let nearest = contacts.nearest(problem, &forces);
        let (found, units) = solve(nearest, condensed, (0.0, Accuracy::of_products(BALANCED)))?;
        forces = contacts.forces(problem, found.t.iter().map(|t| t * units.force));
        let rest = (contacts.exactly_closed(problem, condensed), forces.clone());
        let found = accepted(condensed, rest);
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Where bodies are, and which contacts are closed there.
struct Contacts {
    u: Vec<f64>,
    is_closed: Vec<bool>,
}

/// The contacts that may close when bodies are pressed together, and the unit of their gaps.
struct Pressed {
    near: Vec<usize>,
    unit: f64,
}

impl Contacts {
    /// How normal forces press bodies together.
    fn pressed(&self, problem: &Scaled, forces: &[(f64, f64)]) -> (Program, Pressed) {
        let gaps: Vec<f64> = problem.points.iter().map(|point| point.gap(&self.u)).collect();
        let closed = gaps.iter().zip(&self.is_closed).filter(|it| *it.1);
        let left = closed.fold(0.0_f64, |max, (gap, _)| max.max(gap.abs()));
        let unit = if left > 0.0 { left } else { 1.0 };
        let near: Vec<usize> = (0..gaps.len()).filter(|i| gaps[*i] <= REACH * left).collect();
        let mut f = vec![0.0; self.u.len()];
        let points = problem.points.iter().zip(forces).zip(&self.is_closed);
        for ((point, force), _) in points.filter(|(_, is_closed)| **is_closed) {
            point.add_forces(-force.0, 0.0, &mut f);
        }
        let program = Program {
            k: problem.k.clone(),
            f,
            a: along(problem.order(), near.iter().map(|i| (problem.points.get(*i), 0.0))),
            x_0: near.iter().map(|i| gaps[*i] / unit).collect(),
            compliance: vec![0.0; near.len()],
        };
        (program, Pressed { near, unit })
    }

    fn move_to(&mut self, (found, units): &(Variables, Units), pressed: &Pressed) {
        for (u, (v, unit)) in self.u.iter_mut().zip(found.u.iter().zip(&units.column)) {
            *u += v * unit * units.length * pressed.unit;
        }
        self.is_closed.fill(false);
        for (i, (t, y)) in pressed.near.iter().zip(found.t.iter().zip(&found.y)) {
            self.is_closed[*i] = t > y;
        }
    }

    /// The edges of the cones of closed contacts.
    fn edges<'a>(&'a self, problem: &'a Scaled) -> impl Iterator<Item = (Point<'a>, f64)> {
        let closed = problem.points.iter().zip(&self.is_closed).filter(|it| *it.1);
        closed.flat_map(|(point, _)| point.edges())
    }

    /// The forces that balance the loads and are the nearest to given ones.
    fn nearest(&self, problem: &Scaled, forces: &[(f64, f64)]) -> Program {
        let mut x_0 = Vec::new();
        let closed = problem.points.iter().zip(forces).zip(&self.is_closed).filter(|it| *it.1);
        for ((point, (t_n, t_t)), _) in closed {
            let share = |mu| if mu == 0.0 { *t_n } else { 0.5 * (t_n + t_t / mu) };
            x_0.extend(point.edges().map(|(_, mu)| -share(mu)));
        }
        Program {
            k: problem.k.clone(),
            f: problem.f.clone(),
            a: along(problem.order(), self.edges(problem)),
            compliance: vec![1.0; x_0.len()],
            x_0,
        }
    }

    /// Forces by contact point of those along the edges.
    fn forces(&self, problem: &Scaled, mut along: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
        let points = problem.points.iter().zip(&self.is_closed);
        let force = |(point, is_closed): (Point<'_>, &bool)| {
            let edges = point.edges().filter(|_| *is_closed);
            edges
                .zip(&mut along)
                .fold((0.0, 0.0), |(n, t), ((_, mu), part)| (n + part, t + mu * part))
        };
        points.map(force).collect()
    }

    /// The nearest displacements at which closed contacts have no gap, as far as they can be closed at once.
    fn exactly_closed(&self, problem: &Scaled, condensed: &mut Condensed) -> Vec<f64> {
        let spring = |is_closed: &bool| Springs { nn: f64::from(*is_closed), ..Springs::default() };
        let springs: Vec<Springs> = self.is_closed.iter().map(spring).collect();
        condensed.factorise(problem, &springs, KEPT_EXACTLY);
        let mut u = self.u.clone();
        for _ in 0..REFINED {
            let gap = |(point, is_closed): (Point<'_>, &bool)| {
                (if *is_closed { point.gap(&u) } else { 0.0 }, 0.0)
            };
            let gaps: Vec<(f64, f64)> =
                problem.points.iter().zip(&self.is_closed).map(gap).collect();
            let (v, _) = condensed.step(problem, &springs, vec![0.0; u.len()], gaps.into_iter());
            u.iter_mut().zip(&v).for_each(|(u, v)| *u += v);
        }
        u
    }
}
