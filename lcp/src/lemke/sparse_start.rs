//! What the start of a sparse problem is made of: its columns, and the factorised basis.

use crate::sparse::{Columns, SparseLu};

/// `W w + Z z = right` in the equilibrated rows of the problem, with the start basis `W`.
#[derive(Debug, Clone)]
pub(super) struct SparseStart {
    /// `[W Z]`.
    pub(super) columns: Columns,
    pub(super) right: Vec<f64>,
    /// Of `W`.
    pub(super) lu: SparseLu,
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
