//! The step from an interior point to the exact one on the boundary: the state of every contact is guessed, the
//! equations of these states are solved, and the few contacts that contradict their state change it.

use crate::problem::ContactStatus;
use crate::states::{Condensed, PROXIMAL, Point, PointRef, Scaled, Springs};
use crate::vector::{HALF_DIGITS, SMALL, max_abs};

/// Largest number of steps of refinement. Chosen: refinement of vanishing values would go on down to the smallest
/// number.
const REFINEMENTS: usize = 12;
/// Contradictions smaller than this part of the largest are left alone until its exchange has changed them. Chosen.
const LARGE: f64 = 0.01;
/// A largest contradiction below this part of those before counts as progress, as a smaller number of contradictions
/// does. Chosen.
const SMALLER: f64 = 0.1;

/// The effort spent on exchanges. Every round costs a factorisation, as a step of the iteration does.
pub(crate) struct Effort {
    /// Rounds of exchanges.
    pub(crate) rounds: usize,
    /// Rounds without a decrease of the number of contradictions by a quarter, or of the largest one by the factor
    /// [`SMALLER`].
    pub(crate) patience: usize,
    /// Number of points for each contradiction that is allowed, beyond a few.
    pub(crate) points: usize,
    /// Whether rounds start from the given point, and so keep unknowns that the states leave free.
    pub(crate) anchored: bool,
    /// Whether all contacts with contradictions change their state even if there were fewer before. Exchanges with
    /// friction may then cycle.
    pub(crate) all_at_once: bool,
    /// The proximal term with which the equations of the states are solved. States with a few errors may leave a motion
    /// free, which is arbitrarily large for a small proximal term.
    pub(crate) proximal: f64,
}

impl Effort {
    /// Effort for an iteration that converges, when few contacts are left to exchange.
    pub(crate) const QUICK: Self = Self { rounds: 8, patience: 2, points: 400, ..Self::THOROUGH };
    /// Effort for an iteration that does not converge any further.
    pub(crate) const THOROUGH: Self = Self {
        rounds: 60,
        patience: 10,
        points: 20,
        anchored: false,
        all_at_once: false,
        proximal: PROXIMAL,
    };
    /// Effort for given states; any number of them may be wrong.
    pub(crate) const START: Self =
        Self { patience: 3, points: 1, all_at_once: true, ..Self::THOROUGH };
    /// Effort for a point amid all solutions of a convex problem.
    #[cfg(feature = "clarabel")]
    pub(crate) const ANCHORED: Self = Self { anchored: true, ..Self::THOROUGH };

    /// Effort for a point that is right except for its last digits: unknowns that the states leave free are held.
    pub(crate) const fn held(proximal: f64) -> Self {
        Self { rounds: 3, anchored: true, proximal, ..Self::THOROUGH }
    }

    /// The largest number of contradictions with which exchanges begin.
    fn most(&self, points: usize) -> usize {
        10 + points / self.points
    }
}

/// Displacements and forces that the equations give for the states of the contacts.
#[derive(Debug, Clone)]
pub(crate) struct Vertex {
    pub(crate) u: Vec<f64>,
    pub(crate) forces: Vec<(f64, f64)>,
    pub(crate) contacts: Vec<ContactStatus>,
}

/// Solves for given states and exchanges those that contradict, as long as their number decreases. The forces are those
/// nearest to the given ones if redundant contacts leave a choice. `is_solution` is called with every point and whether
/// its states are free of contradictions; the result is whether it accepted one. Exchanges go on from an accepted point
/// to one whose states are free of contradictions.
pub(crate) fn cross_over(
    problem: &Scaled,
    condensed: &mut Condensed,
    at: PointRef<'_>,
    contacts: Vec<ContactStatus>,
    effort: &Effort,
    mut is_solution: impl FnMut(&mut Condensed, &Vertex, bool) -> bool,
) -> bool {
    let mut vertex = Vertex { u: at.u.to_vec(), forces: at.forces.to_vec(), contacts };
    let (mut fewest, mut least, mut since) = (effort.most(problem.points.len()), f64::INFINITY, 0);
    let mut is_found = false;
    let has_friction = problem.points.mu.iter().any(|mu| *mu > 0.0);
    for _ in 0..effort.rounds {
        if effort.anchored {
            (vertex.u, vertex.forces) = (at.u.to_vec(), at.forces.to_vec());
        }
        if vertex.solve(problem, condensed, effort.proximal).is_none() {
            break;
        }
        problem.settle(&mut vertex.u, &mut vertex.forces);
        let mut contradictions = vertex.contradictions(problem, SMALL);
        is_found |= is_solution(condensed, &vertex, contradictions.is_empty());
        let is_dust = contradictions.is_empty();
        if is_dust && !is_found {
            // Contradictions as small as rounding errors count too.
            contradictions = vertex.contradictions(problem, 0.0);
        }
        let (exchanged, largest) = (contradictions.len(), largest_of(&contradictions));
        let is_nearer = exchanged < fewest - fewest / 4 || largest < SMALLER * least;
        since = if is_nearer { 0 } else { since + 1 };
        let is_hopeless = exchanged > fewest && (is_found || exchanged > 10 * fewest);
        if exchanged == 0 || since > effort.patience || is_hopeless {
            break;
        }
        // Exchanges of all contacts at a time may cycle, above all with friction.
        let are_all = is_nearer || is_dust || !has_friction || effort.all_at_once;
        vertex.exchange(&contradictions, are_all);
        fewest = fewest.min(exchanged);
        least = least.min(largest);
    }
    is_found
}

impl Vertex {
    /// Solves the equations of the states; `None` if they have no solution.
    fn solve(&mut self, problem: &Scaled, condensed: &mut Condensed, proximal: f64) -> Option<()> {
        let points = problem.points.iter().zip(&self.contacts);
        // The equations are solved to the last digit by refinement: the stiffness is not a penalty but the size of a
        // proximal step, which redundant contacts need.
        let springs: Vec<Springs> =
            points.map(|(point, contact)| contact.springs(point, 1.0 / HALF_DIGITS)).collect();
        condensed.factorise(problem, &springs, proximal);
        for ((mu, contact), (t_n, t_t)) in
            problem.points.mu.iter().zip(&self.contacts).zip(&mut self.forces)
        {
            [*t_n, *t_t] = contact.on_cone(*mu, [*t_n, *t_t]);
        }
        let before = max_abs(&self.u);
        let mut last = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let rest = problem.unbalanced(&self.u, self.forces.iter().copied());
            let points = problem.points.iter().zip(&self.contacts).zip(&self.forces);
            let opened: Vec<(f64, f64)> = points
                .map(|((point, contact), forces)| contact.opened(point, &self.u, (*forces).into()))
                .collect();
            let size =
                opened.iter().fold(max_abs(&rest), |max, (g, s)| max.max(g.abs()).max(s.abs()));
            if !size.is_finite() {
                return None;
            }
            if size == 0.0 || size > 0.5 * last {
                break;
            }
            last = size;
            let (du, changes) = condensed.step(problem, &springs, rest, opened.into_iter());
            for ((t_n, t_t), change) in self.forces.iter_mut().zip(changes) {
                *t_n += change.0;
                *t_t += change.1;
            }
            self.u.iter_mut().zip(&du).for_each(|(u, du)| *u += du);
        }
        self.close(problem);
        if max_abs(&self.u) <= SMALL * before.max(1.0) {
            // Bodies at rest: the displacements left are rounding errors, which must not serve as a measure.
            self.u.fill(0.0);
        }
        Some(())
    }

    /// Makes displacements that one closed contact determines alone exact to the last digit.
    fn close(&mut self, problem: &Scaled) {
        let points = problem.points.iter().zip(&self.contacts).zip(&self.forces);
        for ((point, contact), (t_n, _)) in points {
            if *contact != ContactStatus::Open
                && let ([j], [[n, _]]) = (point.columns, point.coefficients)
                && *n != 0.0
            {
                self.u[*j] = -(point.x_0 + point.compliance[0] * t_n) / n;
            }
        }
    }

    /// The contacts that contradict their states by more than `rounding`: the size, the contact, and the state that
    /// fits better.
    fn contradictions(&self, problem: &Scaled, rounding: f64) -> Vec<(f64, usize, ContactStatus)> {
        let force =
            self.forces.iter().fold(max_abs(&problem.f), |max, (t_n, _)| max.max(t_n.abs()));
        let length = max_abs(&self.u).max(self.pressed(problem));
        let relative = |v: f64, unit: f64| if unit > 0.0 { v / unit } else { 0.0 };
        let mut contradictions = Vec::new();
        for (i, point) in problem.points.iter().enumerate() {
            let (t_n, t_t) = self.forces[i];
            let bound = point.mu * t_n.max(0.0);
            let (gap, slip) = (point.gap(&self.u, t_n), point.slip(&self.u, t_t));
            let (size, next) = match self.contacts[i] {
                ContactStatus::Open => (relative(-gap, length), closed(point, gap, slip)),
                // A rounding error of the normal force must not hide a tangential one outside the cone.
                _ if relative(-t_n, force) > rounding => {
                    (relative(-t_n, force), ContactStatus::Open)
                }
                ContactStatus::Stick if point.mu == 0.0 => continue,
                ContactStatus::Stick if t_t > 0.0 => {
                    (relative(t_t - bound, force), ContactStatus::Backwards)
                }
                ContactStatus::Stick => (relative(-t_t - bound, force), ContactStatus::Forwards),
                ContactStatus::Forwards => (relative(-slip, length), ContactStatus::Stick),
                ContactStatus::Backwards => (relative(slip, length), ContactStatus::Stick),
            };
            if size > rounding {
                contradictions.push((size, i, next));
            }
        }
        contradictions
    }

    /// The largest compression or tangential deformation of the spring of a contact.
    fn pressed(&self, problem: &Scaled) -> f64 {
        let all = problem.points.compliance.iter().zip(&self.forces);
        all.fold(0.0, |max, ([normal, tangential], (t_n, t_t))| {
            max.max((normal * t_n).abs()).max((tangential * t_t).abs())
        })
    }

    /// Gives other states to the contacts with the largest contradictions; or only to the first contact with one, a
    /// rule that cannot cycle if all principal minors are positive.
    fn exchange(&mut self, contradictions: &[(f64, usize, ContactStatus)], is_block: bool) {
        let least = LARGE * largest_of(contradictions);
        let all = contradictions.iter().filter(|(size, ..)| *size >= least || !is_block);
        let most = if is_block { usize::MAX } else { 1 };
        for (_, i, next) in all.take(most) {
            self.contacts[*i] = *next;
        }
    }
}

/// The largest contradiction of a contact.
fn largest_of(contradictions: &[(f64, usize, ContactStatus)]) -> f64 {
    contradictions.iter().fold(0.0_f64, |max, (size, ..)| max.max(*size))
}

/// The state of a contact that closes. A contact that has slid by more than it overlaps goes on sliding: if it stuck,
/// the whole slip would have to be undone, against forces that give no guidance.
fn closed(point: Point<'_>, gap: f64, slip: f64) -> ContactStatus {
    if point.mu == 0.0 || slip.abs() <= -gap {
        ContactStatus::Stick
    } else if slip > 0.0 {
        ContactStatus::Forwards
    } else {
        ContactStatus::Backwards
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use faer::mat;

    use super::*;
    use crate::Contact2d;

    /// Normal forces are zero to the last digit, negative or not: the tangential force, which exceeds friction, is the
    /// contradiction.
    #[test]
    fn a_force_beside_the_tip_of_the_cone_contradicts() {
        let (zero, mu) = (vec![0.0], vec![0.5]);
        let (c_n, c_t) = (mat![[1.0, 0.0]], mat![[0.0, 1.0]]);
        let k = mat![[1.0, 0.0], [0.0, 1.0]];
        let problem = Contact2d::new(k, vec![-1.0, 1.0], c_n, c_t, zero.clone(), zero, mu).unwrap();
        let scaled = Scaled::of_contact(&problem);
        for t_n in [1e-15, 0.0, -1e-15] {
            for (t_t, next) in [(1e-9, ContactStatus::Backwards), (-1e-9, ContactStatus::Forwards)]
            {
                let contacts = vec![ContactStatus::Stick];
                let vertex = Vertex { u: vec![0.0; 2], forces: vec![(t_n, t_t)], contacts };
                let found = vertex.contradictions(&scaled, SMALL);
                assert!(matches!(found[..], [(_, 0, state)] if state == next), "{found:?}");
            }
        }
    }
}
