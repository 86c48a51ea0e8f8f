//! The start of the iteration, and its adaptation to the distances that bodies move.

use super::constants::{WIDE_ENOUGH, WIDENING};
use super::iterate::{Iterate, Pairs};
use super::newton_system::Defect;
#[cfg(test)]
use super::newton_system::NewtonSystem;
use super::predictor_corrector::PredictorCorrector;
#[cfg(test)]
use super::predictor_corrector::targets;
use crate::problem::ContactStatus;
use crate::solve::Step;
use crate::states::{Condensed, PROXIMAL, Point, Scaled, Springs};

/// A start from the forces that the contacts would carry if they were springs that push and pull.
pub(super) fn start(problem: &Scaled, condensed: &mut Condensed) -> Iterate {
    let spring_of = |point: Point<'_>| ContactStatus::Stick.springs(point, 1.0);
    let springs: Vec<Springs> = problem.points.iter().map(spring_of).collect();
    condensed.factorise(problem, &springs, PROXIMAL);
    let mut u = problem.f.clone();
    for (point, springs) in problem.points.iter().zip(&springs) {
        point.add_forces(-springs.nn * point.x_0, -springs.tt * point.s_0, &mut u);
    }
    condensed.solve(&mut u);
    // The gap of a compliant contact is smaller than its spring predicts, by its force times its compliance.
    let gaps = problem.points.iter().zip(&springs);
    let gaps: Vec<f64> = gaps.map(|(point, springs)| springs.nn * point.gap(&u, 0.0)).collect();
    let mean = gaps.iter().map(|g| g.abs()).sum::<f64>() / gaps.len().max(1) as f64;
    let shift = if mean > 0.0 && mean.is_finite() { mean } else { 1.0 };
    let points = problem.points.iter().zip(&springs).zip(&gaps).map(|((point, springs), gap)| {
        let t_n = (-gap).max(0.0) + shift;
        let pairs = Pairs { mu: point.mu, t_n, gap: gap.max(0.0) + shift, ..Pairs::default() };
        if point.mu == 0.0 {
            return pairs;
        }
        let (slip, bound) = (springs.tt * point.slip(&u, 0.0), 0.5 * point.mu * t_n);
        Pairs {
            t_t: (-slip).clamp(-bound, bound),
            slip_plus: slip.max(0.0) + shift,
            slip_minus: (-slip).max(0.0) + shift,
            ..pairs
        }
    });
    Iterate { points: points.collect(), u }
}

/// The first step, from a start that is opened first if necessary.
///
/// A start has the deformations of bodies, but not the bending of slender ones and the rotations of loose ones. Its
/// gaps are too small for these motions if the predictor, with the forces of the start, changes them by more than
/// twice their mean. Forces or the problem are at fault if wider gaps do not halve the change: the path of a rigid
/// wedge that is pulled out jams if a smaller decrease is accepted.
pub(super) fn set_out(
    problem: &Scaled,
    condensed: &mut Condensed,
    at: &Iterate,
) -> (Iterate, Step) {
    let (mut from, mut before) = (at.clone(), (at.clone(), f64::MAX));
    loop {
        let of_from = Defect::of(problem, &from);
        let ahead = PredictorCorrector::of(problem, condensed, &from, &of_from);
        let change = ahead.predictor.largest_gap() / from.mean_gap();
        if change <= WIDE_ENOUGH {
            return ahead.advance();
        }
        if change.is_nan() || change > 0.5 * before.1 {
            let of_before = Defect::of(problem, &before.0);
            return PredictorCorrector::of(problem, condensed, &before.0, &of_before).advance();
        }
        let wider = from.clone().opened(WIDENING * from.mean_gap());
        before = (from, change);
        from = wider;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

    use super::*;
    use crate::{Contact2d, ContactPoint};

    /// A step decreases the error of products by the part of it that is taken, up to the square of that part.
    #[test]
    fn newtons_step_is_exact_to_first_order() {
        let mut builder = Contact2d::builder([[2.0, 0.5], [0.5, 1.0]], vec![-1.0, 0.7]);
        for (normal, slip) in [([(0, 1.0)], 0.0), ([(0, 0.4)], 0.1)] {
            let tangent = &[(1, 1.0)];
            let compliance = [0.2, 0.3];
            builder.add_point(ContactPoint {
                normal: &normal,
                tangent,
                gap: 0.1,
                slip,
                mu: 0.6,
                compliance,
            });
        }
        let problem = Scaled::of_contact(&builder.build().unwrap());
        let mut condensed = Condensed::new(&problem).unwrap();
        let at = start(&problem, &mut condensed);
        let tau = 0.1 * at.mean_product();
        let defect = Defect::of(&problem, &at);
        let system = NewtonSystem::new(&problem, &mut condensed, &at);
        let step = system.step(&defect, &targets(&at, tau, None));
        let missing = |at: &Iterate| -> Vec<f64> { at.pairs().map(|(t, y)| t * y - tau).collect() };
        let part = 1e-4;
        let (before, after) = (missing(&at), missing(&at.moved(&step, part)));
        let size = before.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
        for (before, after) in before.iter().zip(after) {
            let error = (after - (1.0 - part) * before).abs();
            assert!(error < 10.0 * part * part * size, "{error} of {size}");
        }
    }
}
