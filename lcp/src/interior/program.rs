//! Convex programs in few free variables with many forces on them.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};

use crate::problem::{column_of, diagonal};
use crate::scaling::power_of_two;
use crate::states::{Point, Scaled};
use crate::vector::max_abs;

/// `K u = f + A t`, `y = A^T u + D t + x_0`, `0 <= t _|_ y >= 0`, with a diagonal `D >= 0`.
pub(super) struct Program {
    pub(super) k: SparseColMat<usize, f64>,
    pub(super) f: Vec<f64>,
    /// What every force does to the free variables.
    pub(super) a: SparseColMat<usize, f64>,
    pub(super) x_0: Vec<f64>,
    pub(super) compliance: Vec<f64>,
}

/// What the variables of a program were measured in.
pub(super) struct Units {
    pub(super) column: Vec<f64>,
    pub(super) force: f64,
    pub(super) length: f64,
}

/// The forces of one along the edges of all friction cones.
pub(super) fn edges(problem: &Scaled) -> SparseColMat<usize, f64> {
    along(problem.order(), problem.edges())
}

/// The forces of one along edges of friction cones: points, each with a coefficient of friction and its sign.
pub(super) fn along<'a>(
    order: usize,
    edges: impl Iterator<Item = (Point<'a>, f64)>,
) -> SparseColMat<usize, f64> {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for (point, mu) in edges {
        rows.extend(point.columns);
        values.extend(point.coefficients.iter().map(|[n, t]| n + mu * t));
        starts.push(rows.len());
    }
    assembled(order, starts, rows, values)
}

/// A matrix of this number of rows from its columns.
pub(super) fn assembled(
    count: usize,
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
) -> SparseColMat<usize, f64> {
    let columns = starts.len() - 1;
    let pattern = SymbolicSparseColMat::new_checked(count, columns, starts, None, rows);
    SparseColMat::new(pattern, values)
}

impl Program {
    /// The same with variables of order one, and what they are measured in.
    pub(super) fn scaled(mut self) -> (Self, Units) {
        let mut largest = vec![0.0_f64; self.f.len()];
        for entry in self.a.triplet_iter() {
            largest[entry.row] = largest[entry.row].max(entry.val.abs());
        }
        let factor = |n: &f64| if *n > 0.0 { power_of_two(1.0 / n) } else { 1.0 };
        let column: Vec<f64> = largest.iter().map(factor).collect();
        self.f.iter_mut().zip(&column).for_each(|(f, d)| *f *= d);
        let (load, gap, soft) = (max_abs(&self.f), max_abs(&self.x_0), max_abs(&self.compliance));
        let stiff: Vec<f64> =
            diagonal(&self.k).iter().zip(&column).map(|(k, d)| k * d * d).collect();
        let compliance = match (soft, max_abs(&stiff)) {
            (soft, _) if soft > 0.0 => soft,
            (_, stiff) if stiff > 0.0 => 1.0 / stiff,
            _ => 1.0,
        };
        let force = if load > 0.0 { load } else { gap / compliance };
        let force = power_of_two(if force > 0.0 { force } else { 1.0 });
        let length = power_of_two(force * compliance);
        multiply(&mut self.k, |i, j| column[i] * column[j] * (length / force));
        multiply(&mut self.a, |i, _| column[i]);
        self.f.iter_mut().for_each(|f| *f /= force);
        self.x_0.iter_mut().for_each(|x| *x /= length);
        self.compliance.iter_mut().for_each(|c| *c *= force / length);
        (self, Units { column, force, length })
    }

    /// `K u`
    pub(super) fn strained(&self, u: &[f64]) -> Vec<f64> {
        let mut strained = vec![0.0; u.len()];
        for (j, u) in u.iter().enumerate() {
            column_of(&self.k, j).for_each(|(i, v)| strained[i] += v * u);
        }
        strained
    }

    /// `A^T u`
    pub(super) fn opened(&self, u: &[f64]) -> Vec<f64> {
        let by = |j: usize| column_of(&self.a, j).map(|(i, v)| v * u[i]).sum();
        (0..self.x_0.len()).map(by).collect()
    }

    /// Adds `A t`.
    pub(super) fn add_forces(&self, t: &[f64], out: &mut [f64]) {
        for (j, t) in t.iter().enumerate() {
            column_of(&self.a, j).for_each(|(i, v)| out[i] += v * t);
        }
    }
}

/// Multiplies all entries by factors of their own.
fn multiply(matrix: &mut SparseColMat<usize, f64>, factor: impl Fn(usize, usize) -> f64) {
    let (pattern, values) = matrix.parts_mut();
    for j in 0..pattern.ncols() {
        let range = pattern.col_range(j);
        let rows = pattern.row_idx_of_col_raw(j);
        values[range].iter_mut().zip(rows).for_each(|(v, &i)| *v *= factor(i, j));
    }
}
