//! The interior-point iteration: predictor, correctors, and what to do when they get nowhere.

use super::constants::{
    BACK, CENTRAL, CORRECTORS, IS_CENTRAL, LEAST_AIM, LONG_ENOUGH, LONGER, MIXTURES, PROGRESS,
    SHORT, SHORTER, SHORTEST, WIDTH,
};
use super::iterate::{Defect, Iterate, Pairs, Tangent};
use super::turn::turn;
use crate::states::{Condensed, Scaled};

/// One step of Mehrotra's method (1992) with Gondzio's correctors (1996), which costs one factorisation.
/// The problem is not monotone with friction: where the step is short, the best mixture of predictor and
/// centring takes its place, and where the path turns back, a step along it. No product of a pair
/// becomes much smaller than the mean. Gives the new point and the length of the step.
pub(super) fn advance(
    problem: &Scaled,
    condensed: &mut Condensed,
    at: &Iterate,
    defect: &Defect,
) -> (Iterate, f64) {
    Ahead::of(problem, condensed, at, defect).advance(problem, at)
}

/// What lies ahead of a point.
pub(super) struct Ahead<'a> {
    tangent: Tangent<'a>,
    defect: &'a Defect,
    /// The step to products of zero.
    pub(super) predictor: Iterate,
}

impl<'a> Ahead<'a> {
    pub(super) fn of(
        problem: &'a Scaled,
        condensed: &'a mut Condensed,
        at: &'a Iterate,
        defect: &'a Defect,
    ) -> Self {
        let tangent = Tangent::new(problem, condensed, at);
        let predictor = tangent.step(defect, &targets(problem, at, 0.0, None));
        Self { tangent, defect, predictor }
    }

    /// The step of [`advance`].
    pub(super) fn advance(&self, problem: &Scaled, at: &Iterate) -> (Iterate, f64) {
        let Self { tangent, defect, predictor } = self;
        let (step, alpha) = if tangent.is_backwards() {
            turn(problem, tangent, at, predictor)
        } else {
            forwards(problem, tangent, at, defect, predictor)
        };
        within(problem, at, &step, (BACK * alpha).min(1.0))
    }
}

/// A step that makes the products smaller.
fn forwards(
    problem: &Scaled,
    tangent: &Tangent<'_>,
    at: &Iterate,
    defect: &Defect,
    predictor: &Iterate,
) -> (Iterate, f64) {
    let gap = at.gap(problem);
    let left = at.gap_after(problem, predictor, at.longest(problem, predictor));
    let aim = gap * (left / gap).powi(3).clamp(0.0, 1.0);
    let mut step = tangent.step(defect, &targets(problem, at, aim, Some(predictor)));
    let mut alpha = at.longest(problem, &step);
    for _ in 0..CORRECTORS {
        if alpha >= LONG_ENOUGH {
            break;
        }
        let trial = at.pairs_after(&step, (1.5 * alpha + 0.3).min(1.0));
        let corrections = corrections(problem, trial, aim.max(LEAST_AIM * gap));
        let corrected = step.moved(&tangent.step(&Defect::none(problem), &corrections), 1.0);
        let reached = at.longest(problem, &corrected);
        if reached < alpha + LONGER {
            break;
        }
        (step, alpha) = (corrected, reached);
    }
    if alpha < SHORT {
        let centring = tangent.step(defect, &targets(problem, at, gap, None));
        (step, alpha) = mixture(problem, at, predictor, &centring);
    }
    if alpha < SHORT { turn(problem, tangent, at, predictor) } else { (step, alpha) }
}

/// The longest part of a step that keeps the products near their mean.
fn within(problem: &Scaled, at: &Iterate, step: &Iterate, mut alpha: f64) -> (Iterate, f64) {
    let least = WIDTH.min(0.9 * at.centrality(problem));
    while alpha > SHORTEST && at.centrality_after(problem, step, alpha) < least {
        alpha *= SHORTER;
    }
    (at.moved(step, alpha), alpha)
}

/// The mixture that reduces the products most, or centring alone where none reduces them much.
fn mixture(
    problem: &Scaled,
    at: &Iterate,
    predictor: &Iterate,
    centring: &Iterate,
) -> (Iterate, f64) {
    let reduction = |share: f64| {
        let pairs = predictor.points.iter().zip(&centring.points);
        (1.0 - share) * at.longest_of(problem, pairs.map(|(a, b)| a.mixed(b, share)))
    };
    let tried = MIXTURES.map(|share| (reduction(share), share));
    let (best, share) = tried.into_iter().fold((0.0, 1.0), |a, b| if b.0 > a.0 { b } else { a });
    let share = if best < PROGRESS && !is_central(problem, at) { 1.0 } else { share };
    let step = predictor.mixed(centring, share);
    let alpha = at.longest(problem, &step);
    (step, alpha)
}

fn is_central(problem: &Scaled, at: &Iterate) -> bool {
    let mean = at.gap(problem);
    let mut products = at.products(problem);
    products.all(|it| (IS_CENTRAL.0 * mean..=IS_CENTRAL.1 * mean).contains(&it))
}

/// The residuals of the products of the pairs, where those of the gaps are to be `tau`, less the second-order term of
/// the predictor.
pub(super) fn targets(
    problem: &Scaled,
    at: &Iterate,
    tau: f64,
    predictor: Option<&Iterate>,
) -> Vec<[f64; 3]> {
    let target = |(i, &mu): (usize, &f64)| {
        let mut targets = [0.0; 3];
        for (target, (t, y)) in targets.iter_mut().zip(at.points[i].pairs(mu)) {
            *target = tau - t * y;
        }
        if let Some(predictor) = predictor {
            for (target, (dt, dy)) in targets.iter_mut().zip(predictor.points[i].pairs(mu)) {
                *target -= dt * dy;
            }
        }
        targets
    };
    problem.points.mu.iter().enumerate().map(target).collect()
}

/// What brings the products of a trial point back among those that are central.
pub(super) fn corrections(
    problem: &Scaled,
    trial: impl Iterator<Item = Pairs>,
    tau: f64,
) -> Vec<[f64; 3]> {
    let correction = |(pairs, &mu): (Pairs, &f64)| {
        let mut targets = [0.0; 3];
        let (low, high) = (CENTRAL.0 * tau, CENTRAL.1 * tau);
        for (target, (t, y)) in targets.iter_mut().zip(pairs.pairs(mu)) {
            // Two negative values are as far outside as one.
            let product = if t < 0.0 && y < 0.0 { -t * y } else { t * y };
            *target = if product < low {
                low - product
            } else if product > high {
                (high - product).max(-high)
            } else {
                0.0
            };
        }
        targets
    };
    trial.zip(&problem.points.mu).map(correction).collect()
}
