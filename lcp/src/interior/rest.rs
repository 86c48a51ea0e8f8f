//! Bodies at rest: gaps and normal forces exactly complementary, and friction that turns over a short slip.

use super::constants::{
    ADMISSIBLE, BALANCINGS, BLUNT, HELD_CLOSED, NEARLY_SETTLED, SETTLED, SHARPENED, SHARPER,
    STIFF_CLOSED,
};
use super::continuation::centred;
use super::iterate::{Iterate, Pairs, Rest};
use super::rigid::rigid_rest;
use crate::states::{Condensed, PROXIMAL, Point, Scaled, Springs};
use crate::vector::max_abs;

/// Refinements of the equations of closed and open contacts. Chosen: each reduces the residuals by some powers of ten.
const REFINEMENTS: usize = 10;
/// Rounds in which forces are put back on their cones. Chosen: each costs a factorisation.
const ROUNDS_ON_CONES: usize = 4;

/// The states at rest on the way to the point with smooth friction at which all gaps and normal forces are complementary,
/// until one is `accepted`. `go_on` is asked before every step, with the residual.
///
/// Where the bodies move hardly farther than friction needs to turn, what vanishes with that slip is no movement: then
/// friction turns over the slip that is `wanted` for these displacements. What that leaves open of rigid bodies,
/// [`rigid_rest`] decides.
pub(super) fn settled<T>(
    problem: &Scaled,
    condensed: &mut Condensed,
    (mut at, patience): (Iterate, usize),
    wanted: impl Fn(&[f64]) -> f64,
    mut go_on: impl FnMut(f64) -> bool,
    mut accepted: impl FnMut(&mut Condensed, &Iterate, Rest) -> Option<T>,
) -> Option<T> {
    let mut progress = Progress::within(patience);
    let mut settle = |condensed: &mut Condensed, at, accuracy| {
        let go_on = |residual| go_on(residual) && progress.is_made(residual);
        centred(problem, condensed, at, (PROXIMAL, accuracy), go_on)
    };
    for _ in 0..SHARPER {
        at = settle(condensed, at, SHARPENED)?;
        let slip = wanted(&at.u);
        if at.smooth <= BLUNT * slip {
            break;
        }
        at.smooth = slip;
    }
    let is_rigid = problem.is_rigid();
    if is_rigid {
        at = settle(condensed, at, NEARLY_SETTLED)?;
    }
    let mut accepted = |condensed: &mut Condensed, at: &Iterate, rest| {
        let is_admissible = is_admissible(problem, at, &rest);
        if is_admissible { accepted(condensed, at, rest) } else { None }
    };
    for accuracy in SETTLED {
        let Some(next) = settle(condensed, at.clone(), accuracy) else { break };
        at = next;
        let rest = polished(problem, condensed, &at);
        let found = accepted(condensed, &at, rest);
        if found.is_some() {
            return found;
        }
    }
    let accepted = |condensed: &mut Condensed, rest| accepted(condensed, &at, rest);
    if is_rigid { rigid_rest(problem, condensed, &at, go_on, accepted) } else { None }
}

/// Whether a residual decreases fast enough.
struct Progress {
    best: f64,
    /// Steps in which it has to be halved, and what is left of them.
    patience: usize,
    left: usize,
}

impl Progress {
    fn within(patience: usize) -> Self {
        Self { best: f64::INFINITY, patience, left: patience }
    }

    fn is_made(&mut self, residual: f64) -> bool {
        (self.best, self.left) = if residual <= 0.5 * self.best {
            (residual, self.patience)
        } else {
            (self.best, self.left.saturating_sub(1))
        };
        self.left > 0
    }
}

/// Whether forces are inside their cones and gaps open, nearly: what is far outside needs no judge.
fn is_admissible(problem: &Scaled, at: &Iterate, (u, forces): &Rest) -> bool {
    let (force, length) = at.sizes();
    let points = problem.points.iter().zip(forces);
    points.into_iter().all(|(point, (t_n, t_t))| {
        let friction = if point.mu > 0.0 { t_t.abs() - point.mu * t_n } else { 0.0 };
        t_n.min(-friction) >= -ADMISSIBLE * force && point.gap(u) >= -ADMISSIBLE * length
    })
}

/// A point to the last digit: closed contacts have no gap, open ones no force, and friction changes as it does at the
/// point.
fn polished(problem: &Scaled, condensed: &mut Condensed, at: &Iterate) -> Rest {
    let (mut u, mut forces) = (at.u.clone(), at.forces());
    let points = || problem.points.iter().zip(&at.points);
    let mut springs: Vec<Springs> = points().map(|(point, pairs)| held(point.mu, pairs)).collect();
    let is_open = |springs: &Springs| springs.nn <= 0.0;
    let open = forces.iter_mut().zip(&springs).filter(|(_, springs)| is_open(springs));
    open.for_each(|(force, _)| *force = (0.0, 0.0));
    condensed.factorise(problem, &springs, HELD_CLOSED);
    let mut last = f64::INFINITY;
    for _ in 0..REFINEMENTS {
        let rest = problem.unbalanced(&u, forces.iter().copied());
        let gap = |(point, springs): (Point<'_>, &Springs)| {
            (if is_open(springs) { 0.0 } else { point.gap(&u) }, 0.0)
        };
        let gaps: Vec<(f64, f64)> = problem.points.iter().zip(&springs).map(gap).collect();
        let size = gaps.iter().fold(max_abs(&rest), |max, (gap, _)| max.max(gap.abs()));
        if size.is_nan() || size >= 0.5 * last {
            break;
        }
        last = size;
        let step = condensed.step(problem, &springs, rest, gaps.into_iter());
        add((&mut u, &mut forces), step);
    }
    for _ in 0..ROUNDS_ON_CONES {
        if put_on_cones(problem, &mut springs, &mut forces) == 0 {
            break;
        }
        condensed.factorise(problem, &springs, HELD_CLOSED);
        last = f64::INFINITY;
        for _ in 0..BALANCINGS {
            let rest = problem.unbalanced(&u, forces.iter().copied());
            let size = max_abs(&rest);
            if size.is_nan() || size >= 0.5 * last {
                break;
            }
            last = size;
            let as_they_are = springs.iter().map(|_| (0.0, 0.0));
            let step = condensed.step(problem, &springs, rest, as_they_are);
            add((&mut u, &mut forces), step);
        }
    }
    problem.settle(&mut u, &mut forces);
    (u, forces)
}

/// Puts forces that are outside their cones back on them, where they stay, and gives their number. Cut off without that, what
/// they carried would be left out of the balance.
fn put_on_cones(problem: &Scaled, springs: &mut [Springs], forces: &mut [(f64, f64)]) -> usize {
    let rounding = f64::EPSILON * forces.iter().fold(0.0_f64, |max, it| max.max(it.0));
    let mut outside = 0;
    for ((springs, (t_n, t_t)), mu) in springs.iter_mut().zip(forces).zip(&problem.points.mu) {
        if *t_n < -rounding {
            (*springs, *t_n, *t_t) = (Springs::default(), 0.0, 0.0);
            outside += 1;
        } else if *mu > 0.0 && t_t.abs() > mu * *t_n + rounding {
            let mu = mu.copysign(*t_t);
            (springs.tn, springs.tt, *t_t) = (mu * springs.nn, 0.0, mu * *t_n);
            outside += 1;
        }
    }
    outside
}

/// Adds changes of displacements and forces.
fn add((u, forces): (&mut [f64], &mut [(f64, f64)]), (du, changes): (Vec<f64>, Vec<(f64, f64)>)) {
    u.iter_mut().zip(&du).for_each(|(u, du)| *u += du);
    for ((t_n, t_t), change) in forces.iter_mut().zip(changes) {
        *t_n += change.0;
        *t_t += change.1;
    }
}

fn held(mu: f64, pairs: &Pairs) -> Springs {
    if pairs.gap > pairs.t_n {
        return Springs::default();
    }
    Springs { nn: STIFF_CLOSED, tn: 0.0, tt: pairs.resistance(mu) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use super::*;
    use crate::{Contact2d, ContactPoint};

    /// Of three contacts one pulls, one has more friction than it can, and one is inside its cone.
    #[test]
    fn forces_outside_their_cones_are_put_on_them() {
        let mut builder = Contact2d::builder([[1.0, 0.0], [0.0, 1.0]], vec![1.0, 1.0]);
        for _ in 0..3 {
            let (normal, tangent) = (&[(0, 1.0)], &[(1, 1.0)]);
            builder.add_point(ContactPoint { normal, tangent, gap: 0.0, slip: 0.0, mu: 0.5 });
        }
        let problem = Scaled::of_contact(&builder.build().unwrap());
        let closed = Springs { nn: 8.0, tn: 0.0, tt: 2.0 };
        let (mut springs, mut forces) = ([closed; 3], [(-1.0, 0.2), (2.0, -1.5), (2.0, 0.9)]);
        assert_eq!(put_on_cones(&problem, &mut springs, &mut forces), 2);
        assert_eq!(forces, [(0.0, 0.0), (2.0, -1.0), (2.0, 0.9)]);
        // More pressure makes friction larger there, and a slip changes nothing.
        assert_eq!(springs, [Springs::default(), Springs { nn: 8.0, tn: -4.0, tt: 0.0 }, closed]);
        assert_eq!(put_on_cones(&problem, &mut springs, &mut forces), 0);
    }
}
