//! Proof that there is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`.

use std::cell::OnceCell;
use std::ops::ControlFlow;

use super::interior::Effort;
use crate::certify::is_proof;
use crate::scaling::equilibrate;
use crate::vector::max_abs;
use crate::{HorizontalLcp, InteriorPoint, InteriorPointSettings, Matrix, Status};

/// The proof that a problem has no solution, looked for at most once.
pub(super) struct Proof<'a> {
    general: &'a dyn Fn() -> HorizontalLcp,
    answer: OnceCell<Option<Vec<f64>>>,
}

impl<'a> Proof<'a> {
    pub(super) fn new(general: &'a dyn Fn() -> HorizontalLcp) -> Self {
        Self { general, answer: OnceCell::new() }
    }

    pub(super) fn is_found(&self, effort: Effort) -> bool {
        self.answer.get_or_init(|| farkas_vector(&(self.general)(), effort)).is_some()
    }

    pub(super) fn into_farkas(self, effort: Effort) -> Option<Vec<f64>> {
        let search = || farkas_vector(&(self.general)(), effort);
        self.answer.into_inner().unwrap_or_else(search)
    }
}

/// A checked Farkas vector with a largest entry of one, if one is found: by the nonnegative values of least size for
/// which the rows hold, which there are none of.
fn farkas_vector(problem: &HorizontalLcp, effort: Effort) -> Option<Vec<f64>> {
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
    let Effort { tolerance, max_iterations, time: time_limit } = effort;
    let defaults = InteriorPointSettings::default();
    let solver = InteriorPoint::new(InteriorPointSettings {
        tolerance,
        max_iterations,
        time_limit,
        ..defaults
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
