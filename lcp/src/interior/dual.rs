//! Newton's method for programs in which every force opens its own gap.
//!
//! The free variables of such a program are the minimum of
//!
//! ```text
//! phi(u) = u.K u / 2 - f.u + t.D t / 2,   with the forces   t = max(0, -(A^T u + x_0)) / D,
//! ```
//!
//! which is convex, and quadratic as long as the same pairs carry forces. Newton's method with an exact line search
//! converges to the minimum, if there is one (Mangasarian 2004): in 5 to 12 steps on walls of 100 to 10 000 bricks that
//! stand, with a third of the solves of a step of the homogeneous problem. If there is no minimum, steps become short,
//! and the homogeneous problem finds the proof.
//!
//! Mangasarian, Journal of Optimization Theory and Applications 121 (2004), 1-18.

use std::ops::Range;

use super::homogeneous::{Accuracy, End, Homogeneous};
use super::program::{Program, ProgramFactors};
use super::variables::{Variables, dot};
use crate::Status;
use crate::states::PROXIMAL;
use crate::vector::HALF_DIGITS;

/// Lengths of a step, relative to Newton's step, outside which the method ends. Measured on walls of 1000 bricks: steps
/// near the limit are between 0.2 and 1.1, and the third of a wall that falls is shorter than 1e-4.
const LENGTHS: Range<f64> = 0.1..10.0;

/// Descends to the minimum of a program; `None` at a step of a length outside [`LENGTHS`], at a pair without
/// compliance, or if numbers overflow. `stop` is called before every step, with the residual.
pub(super) fn descend(
    program: &Program,
    factors: &mut ProgramFactors,
    accuracy: Accuracy,
    mut stop: impl FnMut(f64) -> Option<Status>,
) -> Option<End> {
    let stiffness: Vec<f64> = program.compliance.iter().map(|c| 1.0 / c).collect();
    if stiffness.iter().any(|k| !k.is_finite()) {
        return None;
    }
    let mut u = vec![0.0; program.f.len()];
    // Every pair at rest is about to act.
    let mut acting = stiffness.clone();
    let mut before = f64::INFINITY;
    loop {
        let now = Homogeneous::new(program, point(program, u));
        let defect = now.defect();
        let residual = now.residual(&defect, accuracy);
        // Only rounding errors of the free variables are left.
        let is_least = residual <= HALF_DIGITS && residual > 0.5 * before;
        if is_least || residual <= accuracy.tolerance() {
            return Some(End { at: now.at, status: Status::Solved });
        }
        if let Some(status) = stop(residual) {
            return Some(End { at: now.at, status });
        }
        factors.factorise(program, acting, PROXIMAL)?;
        let mut step = defect.balance;
        factors.gram.solve(&mut step);
        let length = length_to_minimum(program, &now.at, &step);
        if !LENGTHS.contains(&length) {
            return None;
        }
        u = now.at.u;
        u.iter_mut().zip(&step).for_each(|(u, step)| *u += length * step);
        let gaps = program.gaps(&u).zip(&stiffness);
        acting = gaps.map(|(gap, k)| if gap < 0.0 { *k } else { 0.0 }).collect();
        before = residual;
    }
}

/// The point with these free variables.
fn point(program: &Program, u: Vec<f64>) -> Variables {
    let pairs = program.gaps(&u).zip(&program.compliance);
    let (t, y) = pairs.map(|(gap, c)| ((-gap).max(0.0) / c, gap.max(0.0))).unzip();
    Variables { u, t, y, tau: 1.0, kappa: 0.0 }
}

/// The multiple of a step at which `phi` is least; infinite if there is none.
fn length_to_minimum(program: &Program, at: &Variables, step: &[f64]) -> f64 {
    let (strained, opened) = (program.strained(step), program.opened(step));
    let gaps: Vec<f64> = program.gaps(&at.u).collect();
    let (from, curvature) = (dot(&strained, &at.u) - dot(&program.f, step), dot(&strained, step));
    let slope = |length: f64| {
        let pairs = gaps.iter().zip(&opened).zip(&program.compliance);
        let works = pairs.map(|((gap, rate), c)| (-(gap + length * rate)).max(0.0) / c * rate);
        from + length * curvature - works.sum::<f64>()
    };
    // The slope increases, along a straight line between lengths at which a pair begins or ceases to act.
    let bends = gaps.iter().zip(&opened).map(|(gap, rate)| -gap / rate);
    let mut bends: Vec<f64> = bends.filter(|bend| *bend > 0.0 && bend.is_finite()).collect();
    bends.sort_unstable_by(f64::total_cmp);
    let before = bends.partition_point(|bend| slope(*bend) < 0.0);
    let low = if before == 0 { 0.0 } else { bends[before - 1] };
    let high = bends.get(before).copied().unwrap_or(2.0 * low + 1.0);
    let (falls, rises) = (slope(low), slope(high));
    if rises > falls { low + (high - low) * falls / (falls - rises) } else { f64::INFINITY }
}
