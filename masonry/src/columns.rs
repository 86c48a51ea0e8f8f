//! Sparse matrices that are built column by column.

use faer::sparse::{SparseColMat, SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

/// A sparse matrix that is built column by column.
pub(crate) struct ColumnMatrix {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl Default for ColumnMatrix {
    fn default() -> Self {
        Self { starts: vec![0], rows: Vec::new(), values: Vec::new() }
    }
}

impl ColumnMatrix {
    /// Adds a column, whose entries `(row, value)` come with increasing rows.
    pub(crate) fn push(&mut self, entries: impl IntoIterator<Item = (usize, f64)>) {
        for (row, value) in entries {
            self.rows.push(row);
            self.values.push(value);
        }
        self.starts.push(self.rows.len());
    }

    /// Returns the matrix, with the given number of rows.
    ///
    /// # Panics
    /// If a row is not below `rows`, or the rows of a column do not increase.
    pub(crate) fn assembled(self, rows: usize) -> SparseColMat<usize, f64> {
        let columns = self.starts.len() - 1;
        let pattern =
            SymbolicSparseColMat::new_checked(rows, columns, self.starts, None, self.rows);
        SparseColMat::new(pattern, self.values)
    }
}

/// Returns the entries `(row, value)` of column `k`.
pub(crate) fn column(
    matrix: SparseColMatRef<'_, usize, f64>,
    k: usize,
) -> impl Iterator<Item = (usize, f64)> {
    matrix.row_idx_of_col_raw(k).iter().copied().zip(matrix.val_of_col(k).iter().copied())
}

/// Returns the first `count` columns of a matrix.
pub(crate) fn first_columns(
    matrix: &SparseColMat<usize, f64>,
    count: usize,
) -> SparseColMatRef<'_, usize, f64> {
    let starts = &matrix.col_ptr()[..=count];
    let entries = ..starts[count];
    let rows = &matrix.row_idx()[entries];
    let pattern = SymbolicSparseColMatRef::new_checked(matrix.nrows(), count, starts, None, rows);
    SparseColMatRef::new(pattern, &matrix.val()[entries])
}
