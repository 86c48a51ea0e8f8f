//! From a point near rest to rest itself, on the states of its contacts.

use super::constants::{HELD_CLOSED, ROUNDING, STIFF_CLOSED};
use super::iterate::{Iterate, Pairs, Rest};
use crate::states::{Condensed, Point, Scaled, Springs};
use crate::vector::max_abs;

/// Refinements of the equations of closed and open contacts. Chosen: each reduces the residuals by some powers of ten.
const REFINEMENTS: usize = 10;
/// Rounds in which contacts change their states. Measured on settlements of walls of 10 000 bricks: each leaves a fourth to a half
/// of those that do not fit, from some 100 on; after four rounds one was left in some, with a force outside its cone.
const EXCHANGES: usize = 10;

/// A point to the last digit: closed contacts have no gap, open ones no force, and friction changes as it does at the
/// point. Contacts that do not fit then change their states ([`exchange`]), as long as they become fewer.
pub(super) fn polished(problem: &Scaled, condensed: &mut Condensed, at: &Iterate) -> Rest {
    let points = problem.points.iter().zip(&at.points);
    let mut springs: Vec<Springs> = points.map(|(point, pairs)| held(point, pairs)).collect();
    let (mut u, mut forces) = (at.u.clone(), at.forces());
    let open = forces.iter_mut().zip(&springs).filter(|(_, springs)| is_open(springs));
    open.for_each(|(force, _)| *force = (0.0, 0.0));
    condensed.factorise(problem, &springs, HELD_CLOSED);
    refine((problem, condensed, &springs), (&mut u, &mut forces), true);
    let mut misfits = usize::MAX;
    for _ in 0..EXCHANGES {
        let before = misfits;
        misfits = exchange(problem, &mut springs, (&u, &mut forces));
        if misfits == 0 || misfits >= before {
            break;
        }
        condensed.factorise(problem, &springs, HELD_CLOSED);
        refine((problem, condensed, &springs), (&mut u, &mut forces), true);
        // Gaps that cannot be closed together must not keep the loads from their balance.
        refine((problem, condensed, &springs), (&mut u, &mut forces), false);
    }
    problem.settle(&mut u, &mut forces);
    (u, forces)
}

fn held(point: Point<'_>, pairs: &Pairs) -> Springs {
    if pairs.gap > pairs.t_n {
        return Springs::default();
    }
    Springs { nn: closed(point), tn: 0.0, tt: pairs.resistance(point) }
}

/// The stiffness of a closed contact.
fn closed(point: Point<'_>) -> f64 {
    point.in_series([STIFF_CLOSED, 0.0])[0]
}

fn is_open(springs: &Springs) -> bool {
    springs.nn <= 0.0
}

/// Balances the loads and, where that is wanted, closes the gaps of closed contacts, as long as both come nearer.
fn refine(
    (problem, condensed, springs): (&Scaled, &Condensed, &[Springs]),
    (u, forces): (&mut [f64], &mut [(f64, f64)]),
    with_gaps: bool,
) {
    let mut last = f64::INFINITY;
    for _ in 0..REFINEMENTS {
        let rest = problem.unbalanced(u, forces.iter().copied());
        let gap = |((point, springs), (t_n, _)): ((Point<'_>, &Springs), &(f64, f64))| {
            (if with_gaps && !is_open(springs) { point.gap(u, *t_n) } else { 0.0 }, 0.0)
        };
        let points = problem.points.iter().zip(springs).zip(&*forces);
        let gaps: Vec<(f64, f64)> = points.map(gap).collect();
        let size = gaps.iter().fold(max_abs(&rest), |max, (gap, _)| max.max(gap.abs()));
        if size.is_nan() || size >= 0.5 * last {
            break;
        }
        last = size;
        let (du, changes) = condensed.step(problem, springs, rest, gaps.into_iter());
        u.iter_mut().zip(&du).for_each(|(u, du)| *u += du);
        for ((t_n, t_t), change) in forces.iter_mut().zip(changes) {
            *t_n += change.0;
            *t_t += change.1;
        }
    }
}

/// Gives contacts the states that fit, and says how many had others.
///
/// Bodies that hardly anything holds move far for the last of the balance: they overlap then with others, and these contacts
/// close. Those that pull open. Friction outside its cone is put back on it and stays there; cut off without that, what it
/// carried would be left out of the balance.
fn exchange(
    problem: &Scaled,
    springs: &mut [Springs],
    (u, forces): (&[f64], &mut [(f64, f64)]),
) -> usize {
    let rounding = f64::EPSILON * forces.iter().fold(0.0_f64, |max, it| max.max(it.0));
    let mut changed = 0;
    for ((point, springs), (t_n, t_t)) in problem.points.iter().zip(springs).zip(forces) {
        if is_open(springs) {
            if point.gap(u, *t_n) >= -ROUNDING * point.gap_terms(u, *t_n) {
                continue;
            }
            springs.nn = closed(point);
        } else if *t_n < -rounding {
            (*springs, *t_n, *t_t) = (Springs::default(), 0.0, 0.0);
        } else if point.mu > 0.0 && t_t.abs() > point.mu * *t_n + rounding {
            let mu = point.mu.copysign(*t_t);
            (springs.tn, springs.tt, *t_t) = (mu * springs.nn, 0.0, mu * *t_n);
        } else {
            continue;
        }
        changed += 1;
    }
    changed
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod tests {
    use super::*;
    use crate::{Contact2d, ContactPoint};

    /// Of four contacts one pulls, one has more friction than it can, one is inside its cone, and one is open and overlaps.
    #[test]
    fn contacts_get_the_states_that_fit() {
        let mut builder = Contact2d::builder([[1.0, 0.0], [0.0, 1.0]], vec![1.0, 1.0]);
        for gap in [0.0, 0.0, 0.0, -1.0] {
            let (normal, tangent) = (&[(0, 1.0)], &[(1, 1.0)]);
            builder.add_point(ContactPoint { normal, tangent, gap, mu: 0.5, ..Default::default() });
        }
        let problem = Scaled::of_contact(&builder.build().unwrap());
        let closed = Springs { nn: STIFF_CLOSED, tn: 0.0, tt: 2.0 };
        let mut springs = [closed, closed, closed, Springs::default()];
        let mut forces = [(-1.0, 0.2), (2.0, -1.5), (2.0, 0.9), (0.0, 0.0)];
        let u = [0.0; 2];
        assert_eq!(exchange(&problem, &mut springs, (&u, &mut forces)), 3);
        assert_eq!(forces, [(0.0, 0.0), (2.0, -1.0), (2.0, 0.9), (0.0, 0.0)]);
        // More pressure makes friction larger there, and a slip changes nothing; the last has no friction yet.
        let on_cone = Springs { tn: -0.5 * STIFF_CLOSED, tt: 0.0, ..closed };
        let without_friction = Springs { tt: 0.0, ..closed };
        assert_eq!(springs, [Springs::default(), on_cone, closed, without_friction]);
        assert_eq!(exchange(&problem, &mut springs, (&u, &mut forces)), 0);
    }
}
