//! The start of a sparse problem: its columns, and the factorised basis.

use super::{Equilibrated, LARGEST_GROWTH, Start, StartData};
use crate::linear::inverse_norm;
use crate::sparse::{Columns, SparseLu};
use crate::vector::max_abs;
use crate::{Basis, Side};

/// `W w + Z z = right` in the equilibrated rows of the problem, with the start basis `W`.
#[derive(Debug, Clone)]
pub(crate) struct SparseStart {
    /// `[W Z]`.
    pub(crate) columns: Columns,
    pub(crate) right: Vec<f64>,
    /// Of `W`.
    pub(crate) lu: SparseLu,
}

impl SparseStart {
    /// Adds `W increase` to the right-hand side.
    pub(super) fn add_to_values(&mut self, increase: &[f64]) {
        for (k, &v) in increase.iter().enumerate().filter(|(_, v)| **v != 0.0) {
            self.columns.add_to(k, v, &mut self.right);
        }
    }

    /// Adds `W` times a diagonal matrix to `Z`.
    pub(super) fn add_to_diagonal(&mut self, diagonal: &[f64]) {
        let n = diagonal.len();
        let mut columns = Columns::default();
        let mut sum = Accumulator::new(n);
        for k in 0..n {
            sum.add(self.columns.entries(k));
            sum.flush(&mut columns);
        }
        for (k, &v) in diagonal.iter().enumerate() {
            sum.add(self.columns.entries(n + k));
            sum.add(self.columns.entries(k).map(|(i, w)| (i, v * w)));
            sum.flush(&mut columns);
        }
        self.columns = columns;
    }
}

impl Equilibrated<'_> {
    pub(super) fn sparse_start(&self, basis: &Basis) -> Option<Start> {
        let n = self.order();
        let side = |j: usize| basis.sides()[j];
        let picked: Vec<_> = (0..n).map(|j| (j, side(j))).collect();
        let lu = self.sparse_lu(&picked)?;
        let mut work = Vec::new();
        let norm = inverse_norm(n, |x, is_transposed| {
            if is_transposed { lu.solve_transpose(x, &mut work) } else { lu.solve(x, &mut work) }
        });
        if norm.is_nan() || norm > LARGEST_GROWTH {
            return None;
        }
        let mut right = self.right_hand_side();
        let mut q = right.clone();
        lu.solve(&mut q, &mut work);
        let size = max_abs(&q);
        if !size.is_finite() {
            return None;
        }
        if size > 0.0 {
            right.iter_mut().chain(&mut q).for_each(|v| *v /= size);
        }
        let others = (0..n).map(|j| (j, side(j).complement()));
        let columns = self.sparse_columns(picked.iter().copied().chain(others));
        let ones = vec![1.0; n];
        let (row_factor, col_factor) = self.factors(basis, &ones, &ones);
        Some(Start {
            basis: basis.clone(),
            free: self.free(),
            row_factor,
            col_factor,
            size: if size > 0.0 { size } else { 1.0 },
            q,
            data: StartData::Sparse(Box::new(SparseStart { columns, right, lu })),
        })
    }

    /// Equilibrated columns, without zeros.
    pub(crate) fn sparse_columns(&self, picked: impl Iterator<Item = (usize, Side)>) -> Columns {
        let mut columns = Columns::default();
        picked.for_each(|(pair, side)| self.push_column(pair, side, &mut columns));
        columns
    }

    /// The same; none is the right-hand side.
    pub(crate) fn sparse_columns_or_right(&self, picked: &[Option<(usize, Side)>]) -> Columns {
        let mut columns = Columns::default();
        for column in picked {
            if let Some((pair, side)) = *column {
                self.push_column(pair, side, &mut columns);
            } else {
                let right = self.right_hand_side().into_iter().enumerate();
                right.filter(|(_, v)| *v != 0.0).for_each(|(i, v)| columns.push(i, v));
                columns.close();
            }
        }
        columns
    }

    fn push_column(&self, pair: usize, side: Side, columns: &mut Columns) {
        let factor = self.factor(pair, side);
        self.problem.column(pair, side).for_each(|i, v| {
            if v != 0.0 {
                columns.push(i, factor * (v * self.row[i]));
            }
        });
        columns.close();
    }

    /// The factorised matrix of some columns, as many as there are rows; `None` when it is singular to
    /// working precision.
    pub(crate) fn sparse_lu(&self, picked: &[(usize, Side)]) -> Option<SparseLu> {
        let (lu, replaced) = SparseLu::new(&self.sparse_columns(picked.iter().copied()));
        replaced.is_empty().then_some(lu)
    }
}

/// The sum of sparse columns.
struct Accumulator {
    values: Vec<f64>,
    is_set: Vec<bool>,
    rows: Vec<usize>,
}

impl Accumulator {
    fn new(rows: usize) -> Self {
        Self { values: vec![0.0; rows], is_set: vec![false; rows], rows: Vec::new() }
    }

    fn add(&mut self, entries: impl Iterator<Item = (usize, f64)>) {
        for (i, v) in entries {
            if !std::mem::replace(&mut self.is_set[i], true) {
                self.rows.push(i);
            }
            self.values[i] += v;
        }
    }

    /// Writes the sum as a new column, and starts anew.
    fn flush(&mut self, columns: &mut Columns) {
        for i in self.rows.drain(..) {
            let value = std::mem::take(&mut self.values[i]);
            self.is_set[i] = false;
            if value != 0.0 {
                columns.push(i, value);
            }
        }
        columns.close();
    }
}
