//! Rows of matrices.

use faer::Mat;

use super::Rows;
use crate::Matrix;
use crate::sparse::Columns;

/// The rows of a square [`Matrix`], stored by rows.
///
/// ```
/// use faer::mat;
/// use lcp::pgs::{MatrixRows, Rows};
/// let rows = MatrixRows::new(&mat![[2.0, -1.0], [1.0, 3.0]].into());
/// assert_eq!(rows.product(0, &[1.0, 4.0]), -2.0);
/// assert_eq!(rows.size(0, &[1.0, 4.0]), 6.0);
/// ```
#[derive(Debug, Clone)]
pub struct MatrixRows(Stored);

/// Transposed: the columns are the rows.
#[derive(Debug, Clone)]
enum Stored {
    Dense(Mat<f64>),
    Sparse(Columns),
}

impl MatrixRows {
    /// The rows of a matrix.
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn new(matrix: &Matrix) -> Self {
        assert_eq!(matrix.nrows(), matrix.ncols(), "a square matrix");
        Self(match matrix {
            Matrix::Dense(m) => Stored::Dense(m.transpose().to_owned()),
            Matrix::Sparse(_) => {
                let mut columns = Columns::default();
                for j in 0..matrix.ncols() {
                    matrix
                        .column(j)
                        .filter(|(_, v)| *v != 0.0)
                        .for_each(|(i, v)| columns.push(i, v));
                    columns.close();
                }
                Stored::Sparse(columns.transposed(matrix.nrows()))
            }
        })
    }
}

impl Rows for MatrixRows {
    fn order(&self) -> usize {
        match &self.0 {
            Stored::Dense(m) => m.ncols(),
            Stored::Sparse(m) => m.len(),
        }
    }

    fn product(&self, i: usize, z: &[f64]) -> f64 {
        match &self.0 {
            Stored::Dense(m) => sum(m.col_as_slice(i), z, |v, z| v * z),
            Stored::Sparse(m) => m.dot(i, z),
        }
    }

    fn size(&self, i: usize, z: &[f64]) -> f64 {
        match &self.0 {
            Stored::Dense(m) => sum(m.col_as_slice(i), z, |v, z| (v * z).abs()),
            Stored::Sparse(m) => m.entries(i).map(|(j, v)| (v * z[j]).abs()).sum(),
        }
    }

    fn neighbours(&self, i: usize) -> Option<Vec<usize>> {
        Some(match &self.0 {
            Stored::Dense(m) => {
                let row = m.col_as_slice(i);
                (0..row.len()).filter(|&j| row[j] != 0.0).collect()
            }
            Stored::Sparse(m) => m.entries(i).map(|(j, _)| j).collect(),
        })
    }
}

/// The sum of `term` over all entries, in lanes, so that it does not wait for its own additions.
fn sum(row: &[f64], z: &[f64], term: impl Fn(f64, f64) -> f64) -> f64 {
    const LANES: usize = 8;
    let mut lanes = [0.0; LANES];
    let (rows, zs) = (row.chunks_exact(LANES), z.chunks_exact(LANES));
    let rest = rows.remainder().iter().zip(zs.remainder());
    let rest: f64 = rest.map(|(v, z)| term(*v, *z)).sum();
    for (row, z) in rows.zip(zs) {
        for ((lane, v), z) in lanes.iter_mut().zip(row).zip(z) {
            *lane += term(*v, *z);
        }
    }
    lanes.into_iter().sum::<f64>() + rest
}
