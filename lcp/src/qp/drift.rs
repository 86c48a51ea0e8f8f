//! Points that only look exact because they are far away.
//!
//! Residuals are relative to the terms of their row. Where a body can move without any force, or forces can
//! grow without any effect, a point far out in that direction makes all terms large and the residual small,
//! also where there is no solution. In the scaled form loads and matrices are near one, so that there
//! residuals can be measured by the loads alone.

use super::form::{Bounds, Form, Point};
use super::reduced::Place;
use crate::problem::{column_of, max_abs};

/// Rounding errors of a sum, relative to its terms.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// More than this of the loads is not a rounding error, however large the terms are.
const LARGEST_ROUNDING: f64 = 1e-6;

/// What is wrong with a scaled point, in units of the loads, apart from rounding errors.
pub(super) fn load_residual(form: &Form, point: &Point, places: Option<&[Place]>) -> f64 {
    let (stationarity_size, slack_size) = sizes(form, point);
    let beyond = |v: f64, size: f64| v - (ROUNDING * size).min(LARGEST_ROUNDING);
    let mut worst = 0.0_f64;
    for (v, size) in form.stationarity(point).iter().zip(stationarity_size) {
        worst = worst.max(beyond(v.abs(), size));
    }
    let lambda_unit = max_abs(&point.lambda).max(1.0);
    let slacks = form.slacks(point);
    for (i, (w, size)) in slacks.iter().zip(slack_size).enumerate() {
        let lambda = point.lambda[i];
        let wrong = match (form.bounds[i], places.map(|places| places[i])) {
            (Bounds::Free, _) | (_, Some(Place::Inside)) => w.abs(),
            (Bounds::Nonnegative, Some(_)) | (Bounds::Cone { .. }, Some(Place::Lower)) => -w,
            (Bounds::Cone { .. }, Some(Place::Upper)) => *w,
            (Bounds::Nonnegative, None) => w.min(lambda / lambda_unit).abs(),
            // The pairs of a cone are judged by the residuals of the problem.
            (Bounds::Cone { .. }, None) => 0.0,
        };
        worst = worst.max(beyond(wrong, size));
    }
    worst
}

/// Sums of the sizes of all terms: of stationarity and of the slacks.
fn sizes(form: &Form, point: &Point) -> (Vec<f64>, Vec<f64>) {
    let magnitudes = |v: &[f64]| v.iter().map(|v| v.abs()).collect::<Vec<f64>>();
    let (x, lambda) = (magnitudes(&point.x), magnitudes(&point.lambda));
    let (mut stationarity, mut slacks) = (magnitudes(&form.linear), magnitudes(&form.offset));
    for j in 0..x.len() {
        column_of(&form.p, j).for_each(|(i, v)| stationarity[i] += v.abs() * x[j]);
        for (i, v) in column_of(&form.d, j) {
            stationarity[j] += v.abs() * lambda[i];
            slacks[i] += v.abs() * x[j];
        }
    }
    for (j, lambda) in lambda.iter().enumerate() {
        column_of(&form.s, j).for_each(|(i, v)| slacks[i] += v.abs() * lambda);
    }
    (stationarity, slacks)
}
