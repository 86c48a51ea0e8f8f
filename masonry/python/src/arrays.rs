//! Conversion of matrices and vectors of numpy and scipy.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Mat, MatRef};
use lcp::Matrix;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Indices of a sparse matrix, in the two widths that scipy uses.
#[derive(FromPyObject)]
pub(crate) enum Indices<'py> {
    Short(PyReadonlyArray1<'py, i32>),
    Long(PyReadonlyArray1<'py, i64>),
}

impl Indices<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Short(array) => array.len(),
            Self::Long(array) => array.len(),
        }
    }

    fn iter(&self) -> Box<dyn Iterator<Item = i64> + '_> {
        match self {
            Self::Short(array) => Box::new(array.as_array().into_iter().map(|it| i64::from(*it))),
            Self::Long(array) => Box::new(array.as_array().into_iter().copied()),
        }
    }

    /// Returns the indices; an error if one of them is negative or larger than `largest`.
    fn checked(&self, what: &str, largest: usize) -> PyResult<Vec<usize>> {
        let mut all = Vec::with_capacity(self.len());
        for value in self.iter() {
            all.push(checked(what, value, largest)?);
        }
        Ok(all)
    }
}

/// Returns an index; an error if it is negative or larger than `largest`.
fn checked(what: &str, value: i64, largest: usize) -> PyResult<usize> {
    let index = usize::try_from(value).ok().filter(|index| *index <= largest);
    index.ok_or_else(|| {
        PyValueError::new_err(format!(
            "{what} of the sparse matrix has the entry {value}: every entry must be from 0 to {largest}"
        ))
    })
}

/// A matrix that Python passes.
#[derive(FromPyObject)]
pub(crate) enum GivenMatrix<'py> {
    Dense(PyReadonlyArray2<'py, f64>),
    Sparse(Compressed<'py>),
}

/// A sparse matrix of scipy in compressed rows or columns.
#[derive(FromPyObject)]
pub(crate) struct Compressed<'py> {
    #[pyo3(item)]
    shape: [usize; 2],
    #[pyo3(item)]
    by_rows: bool,
    #[pyo3(item)]
    starts: Indices<'py>,
    #[pyo3(item)]
    indices: Indices<'py>,
    #[pyo3(item)]
    values: PyReadonlyArray1<'py, f64>,
}

impl GivenMatrix<'_> {
    /// Returns a copy of the matrix.
    pub(crate) fn matrix(&self) -> PyResult<Matrix> {
        match self {
            Self::Dense(array) => Ok(dense(array).into()),
            Self::Sparse(given) => given.matrix(),
        }
    }
}

impl Compressed<'_> {
    fn matrix(&self) -> PyResult<Matrix> {
        let [rows, columns] = self.shape;
        let (count, length) = if self.by_rows { (rows, columns) } else { (columns, rows) };
        let starts = self.starts.checked("indptr", self.values.len())?;
        let has_all = self.indices.len() == self.values.len();
        let is_whole = has_all
            && starts.len() == count + 1
            && starts.first() == Some(&0)
            && starts.last() == Some(&self.values.len())
            && starts.is_sorted();
        if !is_whole {
            return Err(not_canonical());
        }
        let (starts, indices, values) = if self.by_rows {
            self.turned(&starts, length)?
        } else {
            let indices = self.indices.checked("indices", length.saturating_sub(1))?;
            (starts, indices, self.values.as_array().to_vec())
        };
        let is_sorted = |ends: &[usize]| indices[ends[0]..ends[1]].is_sorted_by(|a, b| a < b);
        if !starts.windows(2).all(is_sorted) {
            return Err(not_canonical());
        }
        let pattern = SymbolicSparseColMat::new_checked(rows, columns, starts, None, indices);
        Ok(SparseColMat::new(pattern, values).into())
    }

    /// Converts compressed rows into compressed columns; returns starts of columns, row indices and values.
    fn turned(
        &self,
        starts: &[usize],
        columns: usize,
    ) -> PyResult<(Vec<usize>, Vec<usize>, Vec<f64>)> {
        let largest = columns.saturating_sub(1);
        let mut ends = vec![0; columns + 1];
        for column in self.indices.iter() {
            ends[checked("indices", column, largest)? + 1] += 1;
        }
        for column in 0..columns {
            ends[column + 1] += ends[column];
        }
        let mut places = ends.clone();
        let (mut rows, mut values) = (vec![0; self.values.len()], vec![0.0; self.values.len()]);
        let mut entries = self.indices.iter().zip(self.values.as_array());
        for (row, bounds) in starts.windows(2).enumerate() {
            for (column, value) in entries.by_ref().take(bounds[1] - bounds[0]) {
                let place = &mut places[checked("indices", column, largest)?];
                (rows[*place], values[*place]) = (row, *value);
                *place += 1;
            }
        }
        Ok((ends, rows, values))
    }
}

fn not_canonical() -> PyErr {
    PyValueError::new_err(
        "the sparse matrix must be in CSC or CSR format, without duplicate entries: call tocsc() and sum_duplicates()",
    )
}

fn dense(array: &PyReadonlyArray2<'_, f64>) -> Mat<f64> {
    let (rows, columns) = (array.shape()[0], array.shape()[1]);
    match array.as_slice() {
        Ok(values) if array.is_fortran_contiguous() => {
            MatRef::from_column_major_slice(values, rows, columns).to_owned()
        }
        Ok(values) => from_rows(values, rows, columns),
        Err(_) => {
            let array = array.as_array();
            Mat::from_fn(rows, columns, |i, j| array[[i, j]])
        }
    }
}

/// Returns the matrix of a row-major slice. Bands of rows are copied one after the other, and each entry is written
/// once.
fn from_rows(values: &[f64], rows: usize, columns: usize) -> Mat<f64> {
    let mut matrix = Mat::with_capacity(rows, columns);
    for first in (0..rows).step_by(BAND) {
        matrix.resize_with(rows.min(first + BAND), columns, |i, j| values[i * columns + j]);
    }
    matrix
}

/// The number of rows of a band. Theory: sixteen rows at a time use whole cache lines for reading and for writing.
const BAND: usize = 16;

/// A vector that Python passes.
pub(crate) type GivenVector<'py> = PyReadonlyArray1<'py, f64>;

/// Returns a copy of a vector of numpy.
pub(crate) fn vector(array: &GivenVector<'_>) -> Vec<f64> {
    array.as_array().to_vec()
}
