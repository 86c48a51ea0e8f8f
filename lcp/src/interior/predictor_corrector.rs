//! One step of the interior-point iteration: predictor, correctors, and the alternatives to steps without progress.

use super::constants::{
    CENTRAL, FRACTION_TO_BOUNDARY, IS_CENTRAL, LEAST_AIM, MIXTURES, SHORT, SHORTER,
};
use super::iterate::{Direction, Iterate, Pairs};
use super::newton_system::{Defect, NewtonSystem};
use super::step::{correction, lengthened};
use super::turn::turn;
use crate::solve::{Step, StepKind};
use crate::states::{Condensed, Scaled};
use crate::vector::HALF_DIGITS;

/// The predictor of a point, and the system by which it is corrected.
pub(super) struct PredictorCorrector<'a> {
    system: NewtonSystem<'a>,
    at: &'a Iterate,
    defect: &'a Defect,
    /// The step to products of zero.
    pub(super) predictor: Iterate,
}

impl<'a> PredictorCorrector<'a> {
    pub(super) fn of(
        problem: &'a Scaled,
        condensed: &'a mut Condensed,
        at: &'a Iterate,
        defect: &'a Defect,
    ) -> Self {
        let system = NewtonSystem::new(problem, condensed, at);
        let predictor = system.step(defect, &targets(at, 0.0, None));
        Self { system, at, defect, predictor }
    }

    /// One step of Mehrotra's method (1992) with Gondzio's correctors (1996), which costs one factorisation. The
    /// problem is not monotone if there is friction: a short step is replaced by the best mixture of predictor and
    /// centring, and by a step along the path if the path turns back. A step that makes the product of a pair much
    /// smaller than the mean is shortened, down to the root of [`HALF_DIGITS`]. Returns the new point, and the step
    /// that leads there.
    pub(super) fn advance(&self) -> (Iterate, Step) {
        let Self { system, at, predictor, .. } = self;
        let Direction { step, alpha, kind } =
            if system.is_backwards() { turn(system, at, predictor) } else { self.forwards() };
        let (next, length) = within(at, &step, (FRACTION_TO_BOUNDARY * alpha).min(1.0));
        let mean_product = next.mean_product();
        (next, Step { kind, length, mean_product })
    }

    /// A step that makes the products smaller, or a step along the path if that step is too short.
    fn forwards(&self) -> Direction {
        let Self { system, at, defect, predictor } = self;
        let mean = at.mean_product();
        let left = at.moved(predictor, at.longest(predictor)).mean_product();
        let aim = mean * (left / mean).powi(3).clamp(0.0, 1.0);
        let step = system.step(defect, &targets(at, aim, Some(predictor)));
        let corrector = |step: &Iterate, trial: f64| {
            let central = aim.max(LEAST_AIM * mean);
            let corrections = of_pairs(&at.moved(step, trial), |t, y| correction(t, y, central));
            step.moved(&system.correction(&corrections), 1.0)
        };
        let (step, alpha) = lengthened(step, |step| at.longest(step), corrector);
        if alpha >= SHORT {
            return Direction { step, alpha, kind: StepKind::Corrected };
        }
        let centring = system.step(defect, &targets(at, mean, None));
        let mixed = mixture(at, predictor, centring);
        if mixed.alpha < SHORT { turn(system, at, predictor) } else { mixed }
    }
}

/// The longest part of a step that keeps the products near their mean.
fn within(at: &Iterate, step: &Iterate, mut alpha: f64) -> (Iterate, f64) {
    let least = CENTRAL.min(0.9 * at.centrality());
    let mut next = at.moved(step, alpha);
    while alpha > HALF_DIGITS.sqrt() && next.centrality() < least {
        alpha *= SHORTER;
        next = at.moved(step, alpha);
    }
    (next, alpha)
}

/// The mixture that reduces the products most, or centring alone if no mixture reduces them much.
fn mixture(at: &Iterate, predictor: &Iterate, centring: Iterate) -> Direction {
    let reduction = |share: f64| (1.0 - share) * at.longest(&predictor.mixed(&centring, share));
    let tried = MIXTURES.map(|share| (reduction(share), share));
    let (best, share) = tried.into_iter().fold((0.0, 1.0), |a, b| if b.0 > a.0 { b } else { a });
    let is_little = best < SHORT && !is_central(at);
    let step = if is_little { centring } else { predictor.mixed(&centring, share) };
    let alpha = at.longest(&step);
    Direction { step, alpha, kind: StepKind::Mixed }
}

fn is_central(at: &Iterate) -> bool {
    let mean = at.mean_product();
    at.pairs().all(|(t, y)| (IS_CENTRAL.0 * mean..=IS_CENTRAL.1 * mean).contains(&(t * y)))
}

/// The right-hand sides of the complementarity equations, `tau - t y` of all pairs, less the second-order term of the
/// predictor.
pub(super) fn targets(at: &Iterate, tau: f64, predictor: Option<&Iterate>) -> Vec<[f64; 3]> {
    let mut targets = of_pairs(at, |t, y| tau - t * y);
    if let Some(predictor) = predictor {
        let second = of_pairs(predictor, |dt, dy| dt * dy);
        let all = targets.iter_mut().flatten().zip(second.iter().flatten());
        all.for_each(|(target, second)| *target -= second);
    }
    targets
}

/// A number for each of the pairs of all points.
fn of_pairs(at: &Iterate, number: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
    let of_point = |pairs: &Pairs| {
        let mut numbers = [0.0; 3];
        numbers.iter_mut().zip(pairs.pairs()).for_each(|(out, (t, y))| *out = number(t, y));
        numbers
    };
    at.points.iter().map(of_point).collect()
}
