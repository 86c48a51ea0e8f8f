//! Matrices of problems: dense or sparse, by columns.

mod column;

use std::ops::Index;

use faer::Mat;
use faer::sparse::{SparseColMat, Triplet};

pub(crate) use column::{Column, add_image, column_of, diagonal};

use crate::Error;

/// Relative error up to which entries, and products with a computed vector, count as exact. Chosen: the rounding errors
/// in computed data.
pub(crate) const DATA_ROUNDING: f64 = 1e-12;

/// A matrix of a problem, dense or sparse.
///
/// Problems take anything that converts into a matrix: an array of rows, a `Mat` or a `SparseColMat` of `faer`, and,
/// with the feature `nalgebra`, a matrix of `nalgebra` of fixed or variable size. Constructors for lists report mistakes:
/// [`from_triplets`](Self::from_triplets) and [`from_rows`](Self::from_rows).
///
/// ```
/// use faer::mat;
/// use lcp::{Lcp, Matrix};
/// let m = Matrix::from([[2.0, 0.0], [1.0, 3.0]]);
/// assert_eq!(m[(1, 0)], 1.0);
/// assert_eq!(m.column(1).collect::<Vec<_>>(), [(0, 0.0), (1, 3.0)]);
/// let sparse = Matrix::from_triplets(2, 2, &[(0, 0, 2.0), (1, 0, 1.0), (1, 1, 3.0)])?;
/// assert_eq!(sparse.column(1).collect::<Vec<_>>(), [(1, 3.0)]);
/// // The same problem four times
/// let q = || vec![-1.0, -1.0];
/// Lcp::new([[2.0, 0.0], [1.0, 3.0]], q())?;
/// Lcp::new(mat![[2.0, 0.0], [1.0, 3.0]], q())?;
/// Lcp::new(Matrix::from_rows(&[vec![2.0, 0.0], vec![1.0, 3.0]])?, q())?;
/// Lcp::new(sparse, q())?;
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Matrix(Storage);

/// The entries of a matrix.
#[derive(Debug, Clone)]
pub(crate) enum Storage {
    /// All entries.
    Dense(Mat<f64>),
    /// The nonzero entries, by columns.
    Sparse(SparseColMat<usize, f64>),
}

impl Matrix {
    /// The identity of order `n`, sparse.
    pub fn identity(n: usize) -> Self {
        Self::from_entries(n, n, (0..n).map(|i| (i, i, 1.0)))
    }

    /// A sparse matrix from triplets `(row, column, value)`, with indices from 0. Values at the same place are added.
    ///
    /// ```
    /// use lcp::{Error, Matrix};
    /// let m = Matrix::from_triplets(2, 2, &[(0, 1, 1.0), (0, 1, 2.0)])?;
    /// assert_eq!((m[(0, 1)], m.stored()), (3.0, 1));
    /// let error = Matrix::from_triplets(2, 2, &[(0, 2, 1.0)]).unwrap_err();
    /// assert_eq!(error, Error::Outside { row: 0, col: 2, rows: 2, cols: 2 });
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Outside`] for an index beyond the sizes.
    pub fn from_triplets(
        rows: usize,
        cols: usize,
        triplets: &[(usize, usize, f64)],
    ) -> Result<Self, Error> {
        match triplets.iter().find(|(row, col, _)| *row >= rows || *col >= cols) {
            Some(&(row, col, _)) => Err(Error::Outside { row, col, rows, cols }),
            None => Ok(Self::from_entries(rows, cols, triplets.iter().copied())),
        }
    }

    /// A dense matrix from its rows: slices, vectors or arrays.
    ///
    /// ```
    /// use lcp::Matrix;
    /// let m = Matrix::from_rows(&[vec![1.0, 2.0], vec![3.0, 4.0]])?;
    /// assert_eq!(m[(1, 0)], 3.0);
    /// assert!(Matrix::from_rows(&[&[1.0, 2.0][..], &[3.0]]).is_err());
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::RowLength`] for rows of different lengths.
    pub fn from_rows(rows: &[impl AsRef<[f64]>]) -> Result<Self, Error> {
        let expected = rows.first().map_or(0, |row| row.as_ref().len());
        let lengths = rows.iter().map(|row| row.as_ref().len()).enumerate();
        for (row, len) in lengths {
            if len != expected {
                return Err(Error::RowLength { row, len, expected });
            }
        }
        Ok(Mat::from_fn(rows.len(), expected, |i, j| rows[i].as_ref()[j]).into())
    }

    /// A square matrix from entries `(row, column, value)`; entries at the same place are added.
    pub(crate) fn assembled(
        n: usize,
        is_sparse: bool,
        entries: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Self {
        if is_sparse {
            return Self::from_entries(n, n, entries);
        }
        let mut dense = Mat::zeros(n, n);
        entries.for_each(|(i, j, v)| dense[(i, j)] += v);
        dense.into()
    }

    /// A sparse matrix from entries `(row, column, value)`; entries at the same place are added.
    pub(crate) fn from_entries(
        rows: usize,
        cols: usize,
        entries: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Self {
        let triplets: Vec<_> = entries.map(|(i, j, v)| Triplet::new(i, j, v)).collect();
        let built = SparseColMat::try_new_from_triplets(rows, cols, &triplets);
        built.unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}")).into()
    }

    /// Number of rows.
    pub fn nrows(&self) -> usize {
        match &self.0 {
            Storage::Dense(m) => m.nrows(),
            Storage::Sparse(m) => m.nrows(),
        }
    }

    /// Number of columns.
    pub fn ncols(&self) -> usize {
        match &self.0 {
            Storage::Dense(m) => m.ncols(),
            Storage::Sparse(m) => m.ncols(),
        }
    }

    /// Whether only nonzero entries are stored.
    pub fn is_sparse(&self) -> bool {
        matches!(self.0, Storage::Sparse(_))
    }

    /// Number of stored entries.
    pub fn stored(&self) -> usize {
        match &self.0 {
            Storage::Dense(m) => m.nrows() * m.ncols(),
            Storage::Sparse(m) => m.compute_nnz(),
        }
    }

    /// The stored entries `(row, value)` of column `j`, rows in ascending order.
    ///
    /// # Panics
    /// If the matrix has no column `j`.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.slice(j).entries()
    }

    /// The same matrix with all entries stored.
    pub fn to_dense(&self) -> Mat<f64> {
        match &self.0 {
            Storage::Dense(m) => m.clone(),
            Storage::Sparse(m) => m.to_dense(),
        }
    }

    /// The same matrix with only its nonzero entries stored.
    pub fn to_sparse(&self) -> SparseColMat<usize, f64> {
        self.clone().into_sparse()
    }

    pub(crate) fn into_sparse(self) -> SparseColMat<usize, f64> {
        let m = match self.0 {
            Storage::Dense(m) => m,
            Storage::Sparse(m) => return m,
        };
        let entries = (0..m.ncols()).flat_map(|j| (0..m.nrows()).map(move |i| (i, j)));
        let entries = entries.filter(|place| m[*place] != 0.0);
        let entries = entries.map(|(i, j)| (i, j, m[(i, j)]));
        Self::from_entries(m.nrows(), m.ncols(), entries).into_sparse()
    }

    /// Checks that a square matrix is symmetric up to rounding, relative to the roots of its diagonal entries, as is
    /// suitable for a positive semidefinite matrix.
    pub(crate) fn check_symmetric(&self, what: &'static str) -> Result<(), Error> {
        match self.asymmetry(|_, _| 1.0) {
            None => Ok(()),
            Some((row, col)) => {
                let (value, mirrored) = (self[(row, col)], self[(col, row)]);
                Err(Error::NotSymmetric { what, row, col, value, mirrored })
            }
        }
    }

    /// The first entry of a square matrix that differs from its mirror image, up to rounding and with a sign by row and
    /// column.
    pub(crate) fn asymmetry(&self, sign: impl Fn(usize, usize) -> f64) -> Option<(usize, usize)> {
        let size: Vec<f64> = (0..self.ncols()).map(|i| self[(i, i)].abs().sqrt()).collect();
        (0..self.ncols()).find_map(|j| {
            let is_unlike = |&(i, v): &(usize, f64)| {
                !are_alike(v, sign(i, j) * self[(j, i)], size[i] * size[j])
            };
            self.column(j).find(is_unlike).map(|(i, _)| (i, j))
        })
    }

    /// Whether an entry `v` of a square matrix equals its mirror image, and whether it equals the opposite of its
    /// mirror image, up to rounding; an entry of the size of rounding errors equals both.
    pub(crate) fn likeness(&self, i: usize, j: usize, v: f64) -> [bool; 2] {
        let size = self[(i, i)].abs().sqrt() * self[(j, j)].abs().sqrt();
        [1.0, -1.0].map(|sign| are_alike(v, sign * self[(j, i)], size))
    }

    pub(crate) fn storage(&self) -> &Storage {
        &self.0
    }

    pub(crate) fn slice(&self, j: usize) -> Column<'_> {
        match &self.0 {
            Storage::Dense(m) => Column::Dense(m.col_as_slice(j)),
            Storage::Sparse(m) => {
                let m = m.as_ref();
                Column::Sparse { rows: m.row_idx_of_col_raw(j), values: m.val_of_col(j) }
            }
        }
    }

    #[must_use]
    pub(crate) fn negated(self) -> Self {
        match self.0 {
            Storage::Dense(m) => (-m).into(),
            Storage::Sparse(m) => (-m).into(),
        }
    }

    /// Checks that the matrix is `rows` by `cols` and has finite entries, which add up to finite sums.
    pub(crate) fn check(&self, what: &'static str, rows: usize, cols: usize) -> Result<(), Error> {
        if self.nrows() != rows || self.ncols() != cols {
            return Err(Error::Shape {
                what,
                rows: self.nrows(),
                cols: self.ncols(),
                expected_rows: rows,
                expected_cols: cols,
            });
        }
        let mut sums = vec![0.0; rows];
        for col in 0..cols {
            if let Some((row, value)) = self.column(col).find(|(_, v)| !v.is_finite()) {
                return Err(Error::NotFinite { what, row, col, value });
            }
            self.slice(col).for_each(|row, v| sums[row] += v.abs());
        }
        check_sums(what, &sums)
    }
}

/// Checks that sums of sizes, row by row, are within the range of numbers.
pub(crate) fn check_sums(what: &'static str, sums: &[f64]) -> Result<(), Error> {
    match sums.iter().position(|sum| !sum.is_finite()) {
        Some(row) => Err(Error::Overflow { what, row }),
        None => Ok(()),
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        match &self.0 {
            Storage::Dense(m) => &m[(i, j)],
            Storage::Sparse(m) => {
                assert!(i < m.nrows(), "row {i} of a matrix of {} rows", m.nrows());
                m.get(i, j).unwrap_or(&0.0)
            }
        }
    }
}

impl From<Mat<f64>> for Matrix {
    fn from(m: Mat<f64>) -> Self {
        Self(Storage::Dense(m))
    }
}

impl From<SparseColMat<usize, f64>> for Matrix {
    fn from(m: SparseColMat<usize, f64>) -> Self {
        Self(Storage::Sparse(m))
    }
}

impl<const ROWS: usize, const COLS: usize> From<[[f64; COLS]; ROWS]> for Matrix {
    fn from(rows: [[f64; COLS]; ROWS]) -> Self {
        Self::from(&rows)
    }
}

impl<const ROWS: usize, const COLS: usize> From<&[[f64; COLS]; ROWS]> for Matrix {
    fn from(rows: &[[f64; COLS]; ROWS]) -> Self {
        Mat::from_fn(ROWS, COLS, |i, j| rows[i][j]).into()
    }
}

#[cfg(feature = "nalgebra")]
impl<R, C, S> From<nalgebra::Matrix<f64, R, C, S>> for Matrix
where
    R: nalgebra::Dim,
    C: nalgebra::Dim,
    S: nalgebra::RawStorage<f64, R, C>,
{
    fn from(m: nalgebra::Matrix<f64, R, C, S>) -> Self {
        Self::from(&m)
    }
}

#[cfg(feature = "nalgebra")]
impl<R, C, S> From<&nalgebra::Matrix<f64, R, C, S>> for Matrix
where
    R: nalgebra::Dim,
    C: nalgebra::Dim,
    S: nalgebra::RawStorage<f64, R, C>,
{
    fn from(m: &nalgebra::Matrix<f64, R, C, S>) -> Self {
        Mat::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)]).into()
    }
}

/// Whether entries on both sides of the diagonal differ by rounding errors of their own size, or of the size of the
/// diagonal.
fn are_alike(v: f64, mirrored: f64, size: f64) -> bool {
    (v - mirrored).abs() <= DATA_ROUNDING * v.abs().max(mirrored.abs()).max(size)
}
