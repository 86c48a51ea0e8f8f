//! The contact problem with springs: on all displacements, and in the place of hard contacts.

use super::constants::{FLAT, MARGIN, TRIALS};
use crate::problem::ContactStatus;
use crate::states::{Condensed, Point, Scaled, Springs};
use crate::vector::max_abs;

/// One step of the proximal method: displacements are held by springs at those of the last one, and forces
/// follow from gaps and slips by a finite stiffness,
///
/// ```text
/// K u + spring (u - u_0) = f + C^T t,
/// t_n = [t_n0 - stiffness g]_+ ,    t_t = t_t0 - stiffness s, cut off at -mu t_n and mu t_n.
/// ```
///
/// Gap and slip of a compliant contact depend on the new forces, so that its stiffness is in series with the other.
///
/// With `u = u_0` and `t = t_0` these are the equations of the problem itself, whatever both stiffnesses.
pub(super) struct Proximal<'a> {
    pub(super) centre: &'a [f64],
    pub(super) forces: &'a [(f64, f64)],
    pub(super) spring: f64,
    pub(super) stiffness: f64,
}

/// What belongs to displacements.
pub(super) struct ProximalPoint {
    pub(super) u: Vec<f64>,
    pub(super) contacts: Vec<ContactStatus>,
    pub(super) forces: Vec<(f64, f64)>,
    /// The unbalanced forces.
    unbalanced: Vec<f64>,
}

impl ProximalPoint {
    /// The largest unbalanced force; not finite where one is not.
    pub(super) fn unbalanced(&self) -> f64 {
        let is_finite = self.unbalanced.iter().all(|v| v.is_finite());
        if is_finite { max_abs(&self.unbalanced) } else { f64::INFINITY }
    }
}

impl Proximal<'_> {
    pub(super) fn at(&self, problem: &Scaled, u: Vec<f64>) -> ProximalPoint {
        let points = problem.points.iter().zip(self.forces);
        let (contacts, forces): (Vec<_>, Vec<_>) =
            points.map(|(point, last)| project(point, (*last).into(), self.stiffness, &u)).unzip();
        let mut unbalanced = problem.unbalanced(&u, forces.iter().copied());
        for ((rest, u), centre) in unbalanced.iter_mut().zip(&u).zip(self.centre) {
            *rest -= self.spring * (u - centre);
        }
        ProximalPoint { u, contacts, forces, unbalanced }
    }

    /// Newton's step, which solves the equations of the states of all contacts, as far as the line search
    /// goes; and whether these are those of the new point, so that it is exact.
    pub(super) fn step(
        &self,
        problem: &Scaled,
        condensed: &mut Condensed,
        at: &ProximalPoint,
    ) -> (ProximalPoint, bool) {
        let points = problem.points.iter().zip(&at.contacts);
        let springs: Vec<Springs> =
            points.map(|(point, contact)| contact.springs(point, self.stiffness)).collect();
        condensed.factorise(problem, &springs, self.spring);
        let mut step = at.unbalanced.clone();
        condensed.solve(&mut step);
        let full = self.moved(problem, at, &step, 1.0);
        if full.contacts == at.contacts {
            return (full, true);
        }
        (self.searched(problem, at, &step, full), false)
    }

    fn moved(
        &self,
        problem: &Scaled,
        at: &ProximalPoint,
        step: &[f64],
        length: f64,
    ) -> ProximalPoint {
        self.at(problem, at.u.iter().zip(step).map(|(u, du)| u + length * du).collect())
    }

    /// The point on the way of a step where what is unbalanced does no work on it. Without friction the
    /// potential energy is least there.
    fn searched(
        &self,
        problem: &Scaled,
        at: &ProximalPoint,
        step: &[f64],
        full: ProximalPoint,
    ) -> ProximalPoint {
        let work = |at: &ProximalPoint| dot(step, &at.unbalanced);
        let first = work(at);
        let (mut low, mut high) = ((0.0, first), (1.0, work(&full)));
        let mut found = full;
        if first <= 0.0 || high.1 >= -FLAT * first {
            return found;
        }
        for _ in 0..TRIALS {
            let (width, margin) = (high.0 - low.0, MARGIN * (high.0 - low.0));
            let secant = low.0 + width * low.1 / (low.1 - high.1);
            let length = secant.clamp(low.0 + margin, high.0 - margin);
            found = self.moved(problem, at, step, length);
            let left = work(&found);
            if left.abs() < FLAT * first {
                break;
            }
            *(if left > 0.0 { &mut low } else { &mut high }) = (length, left);
        }
        found
    }
}

/// State and forces of a contact, from those of the last step.
fn project(
    point: Point<'_>,
    [last_n, last_t]: [f64; 2],
    stiffness: f64,
    u: &[f64],
) -> (ContactStatus, (f64, f64)) {
    let [softer_n, softer_t] = point.compliance.map(|a| 1.0 + a * stiffness);
    let t_n = (last_n - stiffness * point.gap(u, 0.0)) / softer_n;
    if t_n <= 0.0 {
        return (ContactStatus::Open, (0.0, 0.0));
    }
    if point.mu == 0.0 {
        return (ContactStatus::Stick, (t_n, 0.0));
    }
    let t_t = (last_t - stiffness * point.slip(u, 0.0)) / softer_t;
    let bound = point.mu * t_n;
    if t_t > bound {
        (ContactStatus::Backwards, (t_n, bound))
    } else if t_t < -bound {
        (ContactStatus::Forwards, (t_n, -bound))
    } else {
        (ContactStatus::Stick, (t_n, t_t))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
