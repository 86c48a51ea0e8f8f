//! Rigid bodies at rest: contacts that can all be closed at once, and forces on them.
//!
//! Near rest some contacts carry little force over a small gap. If one of them is taken for closed that has to open, the
//! equations of the contacts have no solution, and forces of rigid bodies are not unique either. But nothing relates their
//! forces to displacements, so that both can be found one after the other:
//!
//! 1. Bodies go the way `v` that normal forces `t_n` press them, `min eta v.v / 2 + t_n.g` over gaps `g = g_0 + C_n v >= 0`, a
//!    convex program. Contacts that cannot be closed at once with the others open.
//! 2. Forces of the contacts that are closed then balance the loads by changes in proportion to them, inside their cones.
//!
//! What is left of the gaps of closed contacts decreases by some powers of ten a round.

use super::constants::{
    BALANCINGS, CLEARLY_CLOSED, CLOSED, CLOSED_EXACTLY, KEPT, KEPT_EXACTLY, LIFTED, REACH, REFINED,
    ROUND, ROUNDS, UNBALANCED,
};
use super::factors::Factors;
use super::homogeneous::{Accuracy, solved_from};
use super::iterate::{Iterate, Rest};
use super::program::{Program, Units, along};
use super::variables::Variables;
use crate::Status;
use crate::states::{Condensed, PROXIMAL, Point, Scaled, Springs};
use crate::vector::max_abs;

/// The state at rest next to a point that is `accepted`. `go_on` is asked before every step, with the residual.
pub(super) fn rigid_rest<T>(
    problem: &Scaled,
    condensed: &mut Condensed,
    at: &Iterate,
    mut go_on: impl FnMut(f64) -> bool,
    mut accepted: impl FnMut(&mut Condensed, Rest) -> Option<T>,
) -> Option<T> {
    let is_closed = at.points.iter().map(|it| it.gap <= CLEARLY_CLOSED * it.t_n);
    let mut contacts =
        Contacts { u: at.u.clone(), is_closed: is_closed.collect(), forces: at.forces() };
    let rounding = f64::EPSILON * max_abs(&at.u);
    for _ in 0..ROUNDS {
        let pressed = contacts.pressed(problem);
        let found = pressed.solved(condensed, &mut go_on)?;
        contacts.move_to(&found, &pressed);
        contacts.balance(problem, condensed);
        let mut u = contacts.exactly_closed(problem, condensed);
        u.iter_mut().filter(|u| u.abs() <= rounding).for_each(|u| *u = 0.0);
        let found = accepted(condensed, (u, contacts.forces.clone()));
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Where bodies are, which contacts are closed there, and their forces.
struct Contacts {
    u: Vec<f64>,
    is_closed: Vec<bool>,
    forces: Vec<(f64, f64)>,
}

/// How normal forces press bodies together.
struct Pressed {
    program: Program,
    units: Units,
    /// The unit of gaps.
    gap: f64,
    /// The contacts that may close.
    near: Vec<usize>,
    /// Where the solution is looked for: near the forces and gaps before.
    begin: Variables,
}

impl Pressed {
    /// The solution, as exact as it is reached without slow steps.
    fn solved(
        &self,
        condensed: &mut Condensed,
        mut go_on: impl FnMut(f64) -> bool,
    ) -> Option<Variables> {
        let mut factors = Factors::of(&self.program).ok()?;
        let (mut left, mut least) = (ROUND, f64::INFINITY);
        let stop = |residual: f64| {
            left = left.saturating_sub(1);
            let is_enough = residual <= CLOSED && residual > 0.5 * least;
            least = least.min(residual);
            (!go_on(residual) || left == 0 || is_enough).then_some(Status::IterationLimit)
        };
        let (program, how) = (&self.program, (KEPT, Accuracy::of_all(CLOSED_EXACTLY)));
        let parts = (program, &mut factors);
        let (found, status) = solved_from(self.begin.clone(), parts, how, stop, |_| false);
        condensed.factorisations += factors.factorisations;
        (status == Status::Solved || least <= CLOSED).then_some(found)
    }
}

impl Contacts {
    fn pressed(&self, problem: &Scaled) -> Pressed {
        let gaps: Vec<f64> = problem.points.iter().map(|point| point.gap(&self.u, 0.0)).collect();
        let closed = gaps.iter().zip(&self.is_closed).filter(|it| *it.1);
        let left = closed.fold(0.0_f64, |max, (gap, _)| max.max(gap.abs()));
        let gap = if left > 0.0 { left } else { 1.0 };
        let near: Vec<usize> = (0..gaps.len()).filter(|i| gaps[*i] <= REACH * left).collect();
        let force = |i: &usize| if self.is_closed[*i] { self.forces[*i].0 } else { 0.0 };
        let mut f = vec![0.0; self.u.len()];
        for i in &near {
            problem.points.get(*i).add_forces(-force(i), 0.0, &mut f);
        }
        let program = Program {
            k: problem.k.clone(),
            f,
            a: along(problem.order(), near.iter().map(|i| (problem.points.get(*i), 0.0))),
            x_0: near.iter().map(|i| gaps[*i] / gap).collect(),
            compliance: vec![0.0; near.len()],
        };
        let (program, units) = program.scaled();
        let forces: Vec<f64> = near.iter().map(|i| force(i) / units.force).collect();
        let least = (LIFTED.0 * max_abs(&forces), LIFTED.1 / units.length);
        let begin = Variables {
            u: vec![0.0; self.u.len()],
            t: forces.iter().map(|t| t.max(least.0)).collect(),
            y: program.x_0.iter().map(|y| y.max(least.1)).collect(),
        };
        Pressed { program, units, gap, near, begin }
    }

    fn move_to(&mut self, found: &Variables, pressed: &Pressed) {
        let Units { column, length, .. } = &pressed.units;
        for (u, (v, unit)) in self.u.iter_mut().zip(found.u.iter().zip(column)) {
            *u += v * unit * length * pressed.gap;
        }
        self.is_closed.fill(false);
        for (i, (t, y)) in pressed.near.iter().zip(found.t.iter().zip(&found.y)) {
            self.is_closed[*i] = t > y;
        }
    }

    /// Makes the forces of closed contacts balance the loads, as far as they can inside their cones. They change as if contacts
    /// were springs with a stiffness in proportion to their force, and friction with one that vanishes at the edges of the cone.
    fn balance(&mut self, problem: &Scaled, condensed: &mut Condensed) {
        let open = self.forces.iter_mut().zip(&self.is_closed).filter(|it| !*it.1);
        open.for_each(|(force, _)| *force = (0.0, 0.0));
        let largest = self.forces.iter().fold(0.0_f64, |max, force| max.max(force.0));
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            let spring = |((t_n, t_t), (point, is_closed)): (&(f64, f64), (Point<'_>, &bool))| {
                if !is_closed {
                    return Springs::default();
                }
                let nn = (t_n / largest).max(f64::EPSILON);
                let most = point.mu * t_n;
                let share = if most > 0.0 { (t_t / most).clamp(-1.0, 1.0) } else { 0.0 };
                let tt = point.mu * point.mu * (1.0 - share * share) * nn;
                Springs { nn, tn: point.mu * share * nn, tt }
            };
            let points = problem.points.iter().zip(&self.is_closed);
            let springs: Vec<Springs> = self.forces.iter().zip(points).map(spring).collect();
            condensed.factorise(problem, &springs, PROXIMAL);
            let left = self.balanced_by((problem, condensed, &springs));
            if left >= 0.5 * last || left <= UNBALANCED * largest {
                break;
            }
            last = left;
        }
    }

    /// Changes the forces by those of springs, as long as loads are balanced better. Gives what is left.
    fn balanced_by(
        &mut self,
        (problem, condensed, springs): (&Scaled, &Condensed, &[Springs]),
    ) -> f64 {
        let mut last = f64::INFINITY;
        for _ in 0..BALANCINGS {
            let rest = problem.unbalanced(&self.u, self.forces.iter().copied());
            let size = max_abs(&rest);
            if size.is_nan() || size >= 0.5 * last {
                break;
            }
            last = size;
            let gaps = springs.iter().map(|_| (0.0, 0.0));
            let (_, changes) = condensed.step(problem, springs, rest, gaps);
            for ((force, change), mu) in self.forces.iter_mut().zip(changes).zip(&problem.points.mu)
            {
                let t_n = (force.0 + change.0).max(0.0);
                *force = (t_n, (force.1 + change.1).clamp(-mu * t_n, mu * t_n));
            }
        }
        last
    }

    /// The nearest displacements at which closed contacts have no gap, as far as they can be closed at once.
    fn exactly_closed(&self, problem: &Scaled, condensed: &mut Condensed) -> Vec<f64> {
        let spring = |is_closed: &bool| Springs { nn: f64::from(*is_closed), ..Springs::default() };
        let springs: Vec<Springs> = self.is_closed.iter().map(spring).collect();
        condensed.factorise(problem, &springs, KEPT_EXACTLY);
        let mut u = self.u.clone();
        for _ in 0..REFINED {
            let gap = |(point, is_closed): (Point<'_>, &bool)| {
                (if *is_closed { point.gap(&u, 0.0) } else { 0.0 }, 0.0)
            };
            let gaps: Vec<(f64, f64)> =
                problem.points.iter().zip(&self.is_closed).map(gap).collect();
            let (v, _) = condensed.step(problem, &springs, vec![0.0; u.len()], gaps.into_iter());
            u.iter_mut().zip(&v).for_each(|(u, v)| *u += v);
        }
        u
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use super::*;
    use crate::{Contact2d, ContactPoint};

    /// A rigid body that can be pushed along `x` and `y`, and contacts in the direction `y` or against it, at these heights.
    fn body(load: [f64; 2], contacts: &[(f64, f64)]) -> (Scaled, Condensed) {
        let mut builder = Contact2d::builder([[0.0; 2]; 2], load.to_vec());
        for (direction, gap) in contacts {
            let (normal, tangent) = (&[(1, *direction)], &[(0, 1.0)]);
            builder.add_point(ContactPoint {
                normal,
                tangent,
                gap: *gap,
                mu: 0.5,
                ..Default::default()
            });
        }
        let problem = Scaled::of_contact(&builder.build().unwrap());
        let condensed = Condensed::new(&problem).unwrap();
        (problem, condensed)
    }

    /// Of two closed contacts one is at the edge of its cone; what an open one carried, they take over.
    #[test]
    fn forces_balance_the_loads_inside_their_cones() {
        let (problem, mut condensed) = body([0.3, -1.0], &[(1.0, 0.0); 3]);
        let forces = vec![(0.5, -0.25), (0.3, 0.0), (0.2, 0.0)];
        let is_closed = vec![true, true, false];
        let mut contacts = Contacts { u: vec![0.0; 2], is_closed, forces };
        contacts.balance(&problem, &mut condensed);
        let rest = problem.unbalanced(&contacts.u, contacts.forces.iter().copied());
        assert!(max_abs(&rest) < 1e-14, "{rest:?}");
        let cones = contacts.forces.iter().zip(&problem.points.mu);
        assert!(cones.into_iter().all(|((t_n, t_t), mu)| t_t.abs() <= mu * t_n));
        assert_eq!(contacts.forces[2], (0.0, 0.0));
    }

    /// A body between a floor and a ceiling that is a little too high for both to be closed: the larger force wins.
    #[test]
    fn contacts_that_cannot_be_closed_at_once_open() {
        let (problem, mut condensed) = body([0.0, -1.0], &[(1.0, 1e-4), (-1.0, 1e-3)]);
        let forces = vec![(1.0, 0.0), (0.1, 0.0)];
        let mut contacts = Contacts { u: vec![0.0; 2], is_closed: vec![true; 2], forces };
        let pressed = contacts.pressed(&problem);
        let found = pressed.solved(&mut condensed, |_| true).unwrap();
        contacts.move_to(&found, &pressed);
        assert_eq!(contacts.is_closed, [true, false]);
        let u = contacts.exactly_closed(&problem, &mut condensed);
        assert!(
            problem.points.get(0).gap(&u, 0.0).abs() < 1e-12 * problem.points.get(1).gap(&u, 0.0)
        );
    }
}
