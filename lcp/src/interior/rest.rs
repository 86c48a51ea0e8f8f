//! Bodies at rest: gaps and normal forces exactly complementary, and friction that turns over a short slip.

use super::constants::{
    ADMISSIBLE, BLUNT, MOST_STEPS, NEARLY_SETTLED, SETTLED, SETTLING, SHARPENED, SHARPER,
};
use super::continuation::centred;
use super::iterate::{Iterate, Rest};
use super::polish::polished;
use super::rigid::rigid_rest;
use crate::states::{Condensed, PROXIMAL, Scaled};

/// The states at rest on the way to the point with smooth friction at which all gaps and normal forces are complementary,
/// until one is `accepted`. The residual has to be halved in `patience` steps down to [`SHARPENED`], which takes no more than
/// [`MOST_STEPS`], and in [`SETTLING`] then. `go_on` is asked before every step, with the residual.
///
/// Where the bodies move hardly farther than friction needs to turn, what vanishes with that slip is no movement: then
/// friction turns over the slip that is `wanted` for these displacements. From near rest, [`rigid_rest`] goes on with rigid
/// bodies.
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
    let mut accepted = |condensed: &mut Condensed, at: &Iterate, rest| {
        let is_admissible = is_admissible(problem, at, &rest);
        if is_admissible { accepted(condensed, at, rest) } else { None }
    };
    if problem.is_rigid() {
        at = settle(condensed, at, NEARLY_SETTLED)?;
        let accepted = |condensed: &mut Condensed, rest| accepted(condensed, &at, rest);
        return rigid_rest(problem, condensed, &at, go_on, accepted);
    }
    for accuracy in SETTLED {
        at = settle(condensed, at, accuracy)?;
        let rest = polished(problem, condensed, &at);
        let found = accepted(condensed, &at, rest);
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Whether a residual decreases fast enough.
struct Progress {
    best: f64,
    patience: usize,
    left: usize,
    steps: usize,
}

impl Progress {
    fn within(patience: usize) -> Self {
        Self { best: f64::INFINITY, patience, left: patience, steps: 0 }
    }

    fn is_made(&mut self, residual: f64) -> bool {
        if residual <= 0.5 * self.best {
            self.best = residual;
            self.left = if residual > SHARPENED { self.patience } else { SETTLING };
        } else {
            self.left = self.left.saturating_sub(1);
        }
        self.steps += 1;
        self.left > 0 && (residual <= SHARPENED || self.steps <= MOST_STEPS)
    }
}

/// Whether forces are inside their cones and gaps open, nearly: what is far outside needs no judge.
fn is_admissible(problem: &Scaled, at: &Iterate, (u, forces): &Rest) -> bool {
    let (force, length) = at.sizes();
    let points = problem.points.iter().zip(forces);
    points.into_iter().all(|(point, (t_n, t_t))| {
        let friction = if point.mu > 0.0 { t_t.abs() - point.mu * t_n } else { 0.0 };
        t_n.min(-friction) >= -ADMISSIBLE * force && point.gap(u, *t_n) >= -ADMISSIBLE * length
    })
}
