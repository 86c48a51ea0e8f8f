//! Turns of the central path.

use super::constants::{ARC_FRACTIONS, LONG};
use super::iterate::{Direction, Iterate};
use super::newton_system::NewtonSystem;
use crate::solve::StepKind;

/// A step along the central path near a turn.
///
/// The path consists of the points whose products all have one value `tau`. The determinant of Newton's equations
/// changes its sign at a turn: while it is negative, `tau` grows forwards along the path (Allgower and Georg 1990). The
/// equations for a fixed `tau` near a turn have no solution or two, so that corrections grow beyond bounds. The
/// correction here is normal to the path, in relative changes, and leaves `tau` free; a piece of arc length along the
/// path is added.
pub(super) fn turn(system: &NewtonSystem<'_>, at: &Iterate, predictor: &Iterate) -> Direction {
    let along = system.correction(&vec![[1.0; 3]; at.points.len()]);
    let (mut product, mut square, mut largest) = (0.0, 0.0, 0.0_f64);
    for (((t, y), (t_along, y_along)), (dt, dy)) in
        at.pairs().zip(along.pairs()).zip(predictor.pairs())
    {
        for (along, change) in [(t_along / t, dt / t), (y_along / y, dy / y)] {
            product += along * change;
            square += along * along;
            largest = largest.max(along.abs());
        }
    }
    let aim = -product / square;
    let sense = if system.is_backwards() { 1.0 } else { -1.0 };
    let mut best = Direction { step: predictor.clone(), alpha: 0.0, kind: StepKind::Turn };
    for piece in ARC_FRACTIONS {
        let step = predictor.moved(&along, aim + sense * piece / largest);
        let alpha = at.longest(&step);
        if alpha > best.alpha {
            best = Direction { step, alpha, kind: StepKind::Turn };
        }
        if alpha > LONG {
            break;
        }
    }
    best
}
