//! Step lengths and centrality correctors, which both iterations share.

use super::constants::{CENTRAL, CORRECTORS, LONG_ENOUGH, LONGER};

/// The largest step, at most one, that leaves the changing numbers positive.
pub(super) fn longest(numbers: impl Iterator<Item = (f64, f64)>) -> f64 {
    numbers.filter(|(_, change)| *change < 0.0).map(|(v, change)| -v / change).fold(1.0, f64::min)
}

/// A step with its length, made longer by correctors of centrality (Gondzio 1996), each of which costs a solve. The
/// corrector gets the step and the part of it at which products are evaluated, and returns the corrected step.
pub(super) fn lengthened<S>(
    mut step: S,
    longest: impl Fn(&S) -> f64,
    corrector: impl Fn(&S, f64) -> S,
) -> (S, f64) {
    let mut alpha = longest(&step);
    for _ in 0..CORRECTORS {
        if alpha >= LONG_ENOUGH {
            break;
        }
        let corrected = corrector(&step, (1.5 * alpha + 0.3).min(1.0));
        let reached = longest(&corrected);
        if reached < alpha + LONGER {
            break;
        }
        (step, alpha) = (corrected, reached);
    }
    (step, alpha)
}

/// The change that brings the product of a pair back among the central ones, which are near `central`.
pub(super) fn correction(t: f64, y: f64, central: f64) -> f64 {
    let (low, high) = (CENTRAL * central, (1.0 / CENTRAL) * central);
    // Two negative values are as far outside as one.
    let product = if t < 0.0 && y < 0.0 { -t * y } else { t * y };
    if product < low {
        low - product
    } else if product > high {
        (high - product).max(-high)
    } else {
        0.0
    }
}
