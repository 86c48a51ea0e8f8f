//! Sparse matrices of free sets that are not symmetric positive definite.

use super::constants::VANISHING;
use super::kernel::{Kernel, Outcome, scales};
use crate::Matrix;
use crate::sparse::{Columns, Growing, SparseLu, Turn, elimination_order, row_counts};

const NONE: usize = usize::MAX;

/// Sparse LU, after equilibration, in an order of the whole matrix. It finds out by itself about
/// dependent columns.
pub(super) struct RestrictedLu {
    /// Equilibrated.
    columns: Columns,
    scales: (Vec<f64>, Vec<f64>),
    order: Vec<Turn>,
    /// Number of every free pair.
    number: Vec<usize>,
    factor: Option<SparseLu>,
    work: Vec<f64>,
}

impl RestrictedLu {
    pub(super) fn new(m: &Matrix) -> Self {
        let n = m.ncols();
        let (rows, cols) = scales(m);
        let mut columns = Columns::default();
        for j in 0..n {
            m.slice(j).for_each(|i, v| {
                if v != 0.0 {
                    columns.push(i, rows[i] * v * cols[j]);
                }
            });
            columns.close();
        }
        let order = elimination_order(n, &columns);
        let scales = (rows, cols);
        Self { columns, scales, order, number: vec![NONE; n], factor: None, work: Vec::new() }
    }

    /// The matrix of the free pairs in the order of their numbers.
    fn block(&mut self, is_free: &[bool]) -> Columns {
        let mut count = 0;
        for (number, is_free) in self.number.iter_mut().zip(is_free) {
            *number = if *is_free { count } else { NONE };
            count += usize::from(*is_free);
        }
        let mut block = Columns::default();
        for j in (0..is_free.len()).filter(|&j| is_free[j]) {
            let entries = self.columns.entries(j).filter(|(i, _)| is_free[*i]);
            entries.for_each(|(i, v)| block.push(self.number[i], v));
            block.close();
        }
        block
    }
}

impl Kernel for RestrictedLu {
    fn factorise(&mut self, is_free: &[bool]) -> Outcome {
        let block = self.block(is_free);
        let count = block.len();
        let mut growing = Growing::new(row_counts(count, &block));
        let turns = self.order.iter().filter(|turn| is_free[turn.column]);
        let is_regular = turns.into_iter().all(|turn| {
            let column = self.number[turn.column];
            let row = turn.row.filter(|&row| is_free[row]).map(|row| self.number[row]);
            growing.offer(column, &block, Turn { column, row }, VANISHING)
        });
        self.factor = is_regular.then(|| growing.finish().0);
        if is_regular { Outcome::Regular } else { Outcome::Singular }
    }

    fn solve(&mut self, x: &mut [f64]) {
        if let Some(factor) = &self.factor {
            let (rows, cols) = &self.scales;
            let is_free = |i: &usize| self.number[*i] != NONE;
            let mut packed: Vec<f64> =
                (0..x.len()).filter(is_free).map(|i| rows[i] * x[i]).collect();
            factor.solve(&mut packed, &mut self.work);
            (0..x.len()).filter(is_free).zip(packed).for_each(|(i, v)| x[i] = cols[i] * v);
        }
    }
}
