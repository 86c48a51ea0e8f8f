//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.

use std::ops::ControlFlow;
use std::time::Duration;

use super::constants::INTERIOR;
use crate::certify::is_proof;
use crate::scaling::equilibrate;
use crate::vector::max_abs;
use crate::{HorizontalLcp, InteriorPoint, InteriorPointSettings, Matrix, Status};

/// A checked Farkas vector with a largest entry of one, if one is found: from the problem of nonnegative values of
/// least size for which the rows hold, if no such values exist.
pub(super) fn farkas_vector(
    problem: &HorizontalLcp,
    max_iterations: usize,
    time_limit: Option<Duration>,
) -> Option<Vec<f64>> {
    let n = problem.order();
    let columns = problem.columns();
    let (rows, cols) = equilibrate(n, &columns);
    let mut entries = Vec::new();
    for (k, (column, col)) in columns.iter().zip(&cols).enumerate() {
        column.for_each(|i, v| entries.push((i, k, v * rows[i] * col)));
    }
    let nonzero = entries.into_iter().filter(|(_, _, v)| *v != 0.0);
    let equilibrated = Matrix::from_entries(n, columns.len(), nonzero).into_sparse();
    let loads: Vec<f64> = problem.c().iter().zip(&rows).map(|(c, row)| -c * row).collect();
    let solver = InteriorPoint::new(InteriorPointSettings {
        tolerance: INTERIOR,
        max_iterations,
        time_limit,
        ..InteriorPointSettings::default()
    });
    let go_on = &mut |_: &_| ControlFlow::Continue(());
    let found = solver.least_forces(&equilibrated, &loads, go_on).ok()?;
    if found.status != Status::Infeasible {
        return None;
    }
    let pi: Vec<f64> = found.u.iter().zip(&rows).map(|(u, row)| -u * row).collect();
    let largest = max_abs(&pi);
    let pi: Vec<f64> = pi.iter().map(|pi| pi / largest).collect();
    is_proof(problem, &pi).then_some(pi)
}
