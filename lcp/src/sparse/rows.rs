//! Sparse matrices by rows.

use faer::sparse::SparseColMat;

use crate::problem::column_of;

/// The rows of a sparse matrix, one after the other.
pub(crate) struct ByRows {
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl ByRows {
    pub(crate) fn of(matrix: &SparseColMat<usize, f64>) -> Self {
        let columns = 0..matrix.ncols();
        let entries = columns.flat_map(|j| column_of(matrix, j).map(move |(i, v)| (i, j, v)));
        Self::new(matrix.nrows(), entries)
    }

    /// From entries `(row, column, value)`; those of a row stay in their order.
    pub(crate) fn new(rows: usize, all: impl Iterator<Item = (usize, usize, f64)> + Clone) -> Self {
        let mut starts = vec![0; rows + 1];
        all.clone().for_each(|(i, _, _)| starts[i + 1] += 1);
        for i in 0..rows {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0.0); starts[rows]];
        for (i, j, v) in all {
            entries[next[i]] = (j, v);
            next[i] += 1;
        }
        Self { starts, entries }
    }

    /// Columns and values of a row.
    pub(crate) fn row(&self, i: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[i]..self.starts[i + 1]]
    }
}
