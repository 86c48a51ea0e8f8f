//! Where there may be no equilibrium: soft springs that are reduced step by step.

use super::constants::{
    ACCURACY, CONSTANT, FIRST_SPRING, IN_SEQUENCE, LAST_SPRING, LEAST_STEP, LIFT, NOTHING,
    RESISTANCE, ROUNDING, SOFT, SOFTER, STEPS, WIDTH,
};
use super::iterate::{Defect, Iterate, Pairs};
use super::path::advance;
use super::start::start;
use crate::SoftSprings;
use crate::problem::column_of;
use crate::states::{Condensed, Scaled};

/// How the continuation ended.
pub(super) enum End {
    /// The springs carry nothing any more.
    Standing(Iterate),
    /// They keep their share of the load.
    Falling(SoftSprings),
    /// Neither, within the steps that there were.
    Open,
}

/// Follows the solution from stiff springs to soft ones. `go_on` is asked before every step.
pub(super) fn follow(
    problem: &Scaled,
    condensed: &mut Condensed,
    mut go_on: impl FnMut() -> bool,
) -> End {
    let load: f64 = problem.f.iter().map(|f| f.abs()).sum();
    let mut spring = FIRST_SPRING;
    let mut at = start(problem, condensed, spring);
    let mut before = at.clone();
    let mut path = SoftSprings::default();
    let mut constant = 0;
    while spring >= LAST_SPRING {
        let Some(next) = centred(problem, condensed, at, (spring, ACCURACY), &mut go_on) else {
            return End::Open;
        };
        at = next;
        let share = spring * at.u.iter().map(|u| u.abs()).sum::<f64>() / load;
        if share <= NOTHING {
            return End::Standing(at);
        }
        let is_constant = path.shares.last().is_some_and(|last| share > CONSTANT * last);
        constant = if is_constant { constant + 1 } else { 0 };
        path.stiffness.push(spring);
        path.shares.push(share);
        let step = at.moved(&before, -1.0);
        if constant >= IN_SEQUENCE && spring <= SOFT && is_free(problem, &step, spring) {
            path.motion = problem.displacements(&at.u);
            return End::Falling(path);
        }
        spring *= SOFTER;
        before = at.clone();
        at = at.lifted(problem, LIFT);
    }
    End::Open
}

/// Whether nothing but the spring resists the motion from one spring to the next. Bodies that are softer than
/// the springs leave them their share of the load too, as long as they are.
///
/// Of bodies that are at rest the motion has a part of the order of the spring, and their resistance is that
/// of its square, far below that of the springs. Every body is looked at by itself, and every compliant contact: what a
/// soft one resists would be lost in the rounding errors of a stiff one.
fn is_free(problem: &Scaled, step: &Iterate, spring: f64) -> bool {
    let motion = &step.u;
    let body = bodies(problem);
    let mut resistance = vec![(0.0_f64, 0.0); motion.len()];
    for (j, v) in motion.iter().enumerate() {
        for (i, k) in column_of(&problem.k, j) {
            let term = k * v * motion[i];
            resistance[body[j]].0 += term;
            resistance[body[j]].1 += term.abs();
        }
    }
    let size: f64 = motion.iter().map(|v| v * v).sum();
    let least = RESISTANCE * spring * spring * size;
    let of_contact = |([normal, tangential], pairs): (&[f64; 2], &Pairs)| {
        normal * pairs.t_n * pairs.t_n + tangential * pairs.t_t * pairs.t_t
    };
    let mut contacts = problem.points.compliance.iter().zip(&step.points).map(of_contact);
    resistance.iter().all(|(resistance, terms)| *resistance <= least.max(ROUNDING * terms))
        && contacts.all(|resistance| resistance <= least)
}

/// For every displacement the first of those that it is coupled to by stiffness.
fn bodies(problem: &Scaled) -> Vec<usize> {
    let mut first: Vec<usize> = (0..problem.order()).collect();
    let root = |first: &[usize], mut j: usize| {
        while first[j] != j {
            j = first[j];
        }
        j
    };
    for j in 0..problem.order() {
        for (i, _) in column_of(&problem.k, j).filter(|(_, k)| *k != 0.0) {
            let (a, b) = (root(&first, i), root(&first, j));
            first[a.max(b)] = a.min(b);
            // Paths stay short.
            (first[i], first[j]) = (a.min(b), a.min(b));
        }
    }
    (0..problem.order()).map(|j| root(&first, j)).collect()
}

/// The point with springs of a stiffness, to this accuracy relative to the largest force; `None` where the steps get
/// nowhere. `go_on` is asked before every step.
pub(super) fn centred(
    problem: &Scaled,
    condensed: &mut Condensed,
    mut at: Iterate,
    (spring, accuracy): (f64, f64),
    mut go_on: impl FnMut() -> bool,
) -> Option<Iterate> {
    for _ in 0..STEPS {
        let size = at.points.iter().fold(1.0_f64, |max, pairs| max.max(pairs.t_n));
        let defect = Defect::of(problem, &at, spring);
        let residual = at.natural(problem, (1.0, 1.0)).max(defect.size()) / size;
        if residual <= accuracy {
            return Some(at);
        }
        if !go_on() {
            return None;
        }
        let (next, alpha) = advance(problem, condensed, (&at, &defect), (spring, WIDTH));
        if !next.is_finite() || alpha < LEAST_STEP {
            return None;
        }
        at = next;
    }
    None
}
