//! What a point lacks in units of the loads.

use super::ContactStatus;
use super::at::At;
use super::lack::{self, Lack, Shifts};
use super::solve::refined;
use crate::active::Scaled;

/// What equations and inequalities lack, relative to the largest load and initial gap and computed without
/// rounding errors: at a point, or, where that is more than the tolerance, where the equations of its states
/// lead to.
///
/// The terms of the equations may be far larger than loads and gaps. In a sound problem what a point lacks is
/// then due to its own rounding; of a problem without a solution no refinement brings it down, while the
/// residuals, relative to the terms, are the smaller the farther out a point is.
pub(crate) fn lack_of_loads(
    scaled: &Scaled,
    (u, forces): (&[f64], &[(f64, f64)]),
    statuses: &[ContactStatus],
    tolerance: f64,
) -> f64 {
    let at = At::of(u, forces);
    let floating = lack::floating(scaled, statuses);
    let lack_at = |at: &At| largest(scaled, at, statuses, &floating);
    let given = lack_at(&at);
    if given <= tolerance {
        return given;
    }
    refined(scaled, &at, statuses).map(|at| lack_at(&at)).fold(given, f64::min)
}

fn largest(scaled: &Scaled, at: &At, statuses: &[ContactStatus], floating: &[bool]) -> f64 {
    let gap_size = scaled.gap_size();
    let lack = Lack::extended(scaled, statuses, at, &Shifts::new(scaled), floating);
    let unbalanced = lack.unbalanced.iter().map(|v| v.rounded().abs());
    let of_law = scaled.points.iter().zip(&at.forces).flat_map(|(point, [t_n, t_t])| {
        let gap = at.row(point, point.x_0, &point.normal).rounded() / gap_size;
        let beyond = (t_t.abs() - *t_n * point.mu).rounded() / point.mu.max(1.0);
        [-gap, -t_n.rounded(), beyond]
    });
    let all = unbalanced.chain(of_law);
    all.fold(0.0, |worst, v| if v.is_nan() { f64::INFINITY } else { worst.max(v) })
}
