//! Mixed problems in which every variable and every equation has a unit of its own.

use crate::scaling::{GIVEN, equilibrate};
use crate::{Matrix, MixedLcp};

/// Rounds of equilibration: what is far below the others of its row and column counts only after these
/// are near one.
const ROUNDS: usize = 4;
/// Factors that differ by less than this leave the residuals a measure of every variable.
const SPREAD: f64 = 1e4;

/// The same problem with equilibrated rows and columns.
///
/// Residuals measure all variables by the largest one, and rows by the largest term that they could have.
/// Where units are far apart, the largest variable may be so large that no other counts, and a point with
/// small residuals is no solution.
pub(crate) struct OwnUnits {
    problem: MixedLcp,
    rows: Vec<f64>,
    columns: Vec<f64>,
}

impl OwnUnits {
    /// `None` where the problem has no need of them.
    pub(crate) fn of(problem: &MixedLcp) -> Option<Self> {
        let n = problem.order();
        let mut m = problem.m().clone();
        let (mut rows, mut columns) = (vec![1.0; n], vec![1.0; n]);
        for _ in 0..ROUNDS {
            let slices: Vec<_> = (0..n).map(|j| m.slice(j)).collect();
            let (row, column) = equilibrate(n, &slices, GIVEN);
            let entries = (0..n).flat_map(|j| {
                let (row, factor) = (&row, column[j]);
                m.column(j).map(move |(i, v)| (i, j, row[i] * v * factor))
            });
            m = Matrix::from_entries(n, n, entries);
            rows.iter_mut().zip(row).for_each(|(all, row)| *all *= row);
            columns.iter_mut().zip(column).for_each(|(all, column)| *all *= column);
        }
        if spread(&rows).max(spread(&columns)) < SPREAD {
            return None;
        }
        let q = problem.q().iter().zip(&rows).map(|(q, row)| q * row).collect();
        let problem = MixedLcp::new(m, q, problem.free().to_vec()).ok()?;
        Some(Self { problem, rows, columns })
    }

    /// The worst residual of a point of the problem as it was given.
    pub(crate) fn residual(&self, z: &[f64], w: &[f64]) -> f64 {
        let z: Vec<f64> = z.iter().zip(&self.columns).map(|(z, column)| z / column).collect();
        let w: Vec<f64> = w.iter().zip(&self.rows).map(|(w, row)| w * row).collect();
        self.problem.residuals(&z, &w).worst()
    }
}

fn spread(factors: &[f64]) -> f64 {
    let largest = factors.iter().fold(0.0_f64, |max, v| max.max(*v));
    let least = factors.iter().fold(f64::INFINITY, |min, v| min.min(*v));
    largest / least
}
