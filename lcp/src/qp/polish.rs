//! From a point near a solution to one that is exact to rounding.

use super::form::{Bounds, Form, Point};
use super::reduced::{Law, Place, solve_reduced};
use crate::problem::max_abs;

/// Systems that are solved before the search for the right places is given up.
const ROUNDS: usize = 30;
/// What is wrong by less than this, relative to the largest of its kind, is a rounding error.
const ROUNDING: f64 = 1e-14;
/// A multiplier below this, relative to the largest, may be one that vanishes.
const NOISE: f64 = 1e-11;

/// The places of the multipliers that a point suggests: of every pair what is larger is taken to be
/// the one that does not vanish.
pub(super) fn places_of(form: &Form, law: Law<'_>, point: &Point) -> Vec<Place> {
    let (lambda, slacks) = (&point.lambda, form.slacks(point));
    let place = |(i, bounds): (usize, &Bounds)| match *bounds {
        Bounds::Free => Place::Inside,
        Bounds::Nonnegative if lambda[i] > slacks[i] => Place::Inside,
        Bounds::Nonnegative => Place::Lower,
        Bounds::Cone { normal, mu } => {
            let limit = law.limit(i, normal, mu, lambda);
            if limit - lambda[i].abs() > slacks[i].abs() {
                Place::Inside
            } else if slacks[i] > lambda[i] {
                Place::Lower
            } else {
                Place::Upper
            }
        }
    };
    form.bounds.iter().enumerate().map(place).collect()
}

/// A multiplier in the wrong place, and how wrong it is.
#[derive(Debug, Clone, Copy)]
struct Wrong {
    row: usize,
    right: Place,
    by: f64,
}

/// Solves the systems that belong to `places`, and to those to which the signs of the answers lead,
/// and shows every answer to `judge`, until it says that it is good enough or there is nothing wrong.
/// Returns how many systems were solved.
///
/// All that are wrong change places at once, which is a Newton method (Hintermüller, Ito and Kunisch
/// 2002); where it comes back to the same places, only the one that is wrong the most.
pub(super) fn polish(
    form: &Form,
    law: Law<'_>,
    (mut places, start): (Vec<Place>, &Point),
    judge: &mut dyn FnMut(&Point, &[Place]) -> bool,
) -> usize {
    let mut seen: Vec<Vec<Place>> = Vec::new();
    for round in 0..ROUNDS {
        let Some(point) = solve_reduced(form, law, &places, start) else { return round };
        if judge(&point, &places) {
            return round + 1;
        }
        let wrong = wrong_places(form, law, &places, &point);
        let Some(worst) = wrong.iter().max_by(|a, b| a.by.total_cmp(&b.by)).copied() else {
            let Some(places) = without_noise(form, &places, &point) else { return round + 1 };
            if let Some(point) = solve_reduced(form, law, &places, start) {
                judge(&point, &places);
            }
            return round + 2;
        };
        let mut next = places.clone();
        for wrong in &wrong {
            next[wrong.row] = wrong.right;
        }
        if seen.contains(&next) {
            next.clone_from(&places);
            next[worst.row] = worst.right;
            if seen.contains(&next) {
                return round + 1;
            }
        }
        seen.push(std::mem::replace(&mut places, next));
    }
    ROUNDS
}

/// Where both variables of a pair vanish, a multiplier inside is nothing but noise, which leaves its row
/// with a residual if it is negative, or others that it should cancel are. Such multipliers are put at
/// zero; none where there is no such one.
fn without_noise(form: &Form, places: &[Place], point: &Point) -> Option<Vec<Place>> {
    let size = NOISE * max_abs(&point.lambda);
    let is_noise = |i: usize| {
        form.bounds[i] == Bounds::Nonnegative
            && places[i] == Place::Inside
            && point.lambda[i].abs() <= size
    };
    let clean = |i: usize| if is_noise(i) { Place::Lower } else { places[i] };
    (0..form.rows()).any(is_noise).then(|| (0..form.rows()).map(clean).collect())
}

fn wrong_places(form: &Form, law: Law<'_>, places: &[Place], point: &Point) -> Vec<Wrong> {
    let (lambda, slacks) = (&point.lambda, form.slacks(point));
    let unit = |v: f64| if v > 0.0 { v } else { 1.0 };
    let lambda_unit = unit(max_abs(lambda));
    // With the offset, where all slacks vanish there would be nothing but noise to measure them by.
    let slack_unit = unit(max_abs(&slacks).max(max_abs(&point.x)).max(max_abs(&form.offset)));
    let wrong = |(row, bounds): (usize, &Bounds)| {
        let (lambda_i, slack) = (lambda[row] / lambda_unit, slacks[row] / slack_unit);
        let (right, by) = match (*bounds, places[row]) {
            (Bounds::Free, _) => return None,
            (Bounds::Nonnegative, Place::Inside) => (Place::Lower, -lambda_i),
            (Bounds::Nonnegative, _) => (Place::Inside, -slack),
            (Bounds::Cone { normal, mu }, place) => {
                let limit = law.limit(row, normal, mu, lambda) / lambda_unit;
                // Without a normal force there is nothing in between.
                let between = |other| if limit > 0.0 { Place::Inside } else { other };
                match place {
                    Place::Inside if lambda_i > 0.0 => (Place::Upper, lambda_i - limit),
                    Place::Inside => (Place::Lower, -lambda_i - limit),
                    Place::Lower => (between(Place::Upper), -slack),
                    Place::Upper => (between(Place::Lower), slack),
                }
            }
        };
        (by > ROUNDING).then_some(Wrong { row, right, by })
    };
    form.bounds.iter().enumerate().filter_map(wrong).collect()
}
