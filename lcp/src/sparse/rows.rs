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
        let mut starts = vec![0; matrix.nrows() + 1];
        for j in 0..matrix.ncols() {
            column_of(matrix, j).for_each(|(i, _)| starts[i + 1] += 1);
        }
        for i in 0..matrix.nrows() {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0.0); starts[matrix.nrows()]];
        for j in 0..matrix.ncols() {
            for (i, v) in column_of(matrix, j) {
                entries[next[i]] = (j, v);
                next[i] += 1;
            }
        }
        Self { starts, entries }
    }

    /// The same with one more entry, behind the others, in the rows that have one.
    pub(crate) fn with(
        matrix: &SparseColMat<usize, f64>,
        other: impl Fn(usize) -> Option<(usize, f64)>,
    ) -> Self {
        let all = Self::of(matrix);
        let (mut starts, mut entries) = (vec![0], Vec::with_capacity(all.entries.len()));
        for i in 0..matrix.nrows() {
            entries.extend_from_slice(all.row(i));
            entries.extend(other(i));
            starts.push(entries.len());
        }
        Self { starts, entries }
    }

    /// Columns and values of a row.
    pub(crate) fn row(&self, i: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[i]..self.starts[i + 1]]
    }
}
