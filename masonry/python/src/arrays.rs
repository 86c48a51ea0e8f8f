//! Matrices and vectors of numpy and scipy.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Mat, MatRef};
use lcp::Matrix;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Indices of a sparse matrix, in the widths that scipy has.
#[derive(FromPyObject)]
pub(crate) enum Indices<'py> {
    Short(PyReadonlyArray1<'py, i32>),
    Long(PyReadonlyArray1<'py, i64>),
}

impl Indices<'_> {
    /// The indices, each of which has to be at most `largest`.
    fn checked(&self, what: &str, largest: usize) -> PyResult<Vec<usize>> {
        let wrong = |value: i64| {
            PyValueError::new_err(format!(
                "{what} of the sparse matrix has {value}: it must be from 0 to {largest}"
            ))
        };
        let checked = |value: i64| {
            let index = usize::try_from(value).map_err(|_| wrong(value))?;
            if index <= largest { Ok(index) } else { Err(wrong(value)) }
        };
        match self {
            Self::Short(array) => array.as_array().iter().map(|v| checked(i64::from(*v))).collect(),
            Self::Long(array) => array.as_array().iter().map(|v| checked(*v)).collect(),
        }
    }
}

/// A matrix as Python gives it.
#[derive(FromPyObject)]
pub(crate) enum GivenMatrix<'py> {
    Dense(PyReadonlyArray2<'py, f64>),
    /// Compressed columns.
    Sparse {
        #[pyo3(item)]
        shape: [usize; 2],
        #[pyo3(item)]
        starts: Indices<'py>,
        #[pyo3(item)]
        rows: Indices<'py>,
        #[pyo3(item)]
        values: PyReadonlyArray1<'py, f64>,
    },
}

impl GivenMatrix<'_> {
    /// The matrix, copied once.
    pub(crate) fn matrix(&self) -> PyResult<Matrix> {
        match self {
            Self::Dense(array) => Ok(dense(array).into()),
            Self::Sparse { shape: [rows, columns], starts, rows: indices, values } => {
                let values = values.as_array().to_vec();
                let starts = starts.checked("indptr", values.len())?;
                let indices = indices.checked("indices", rows.saturating_sub(1))?;
                let is_whole = starts.len() == columns + 1
                    && starts.first() == Some(&0)
                    && starts.last() == Some(&values.len())
                    && indices.len() == values.len();
                let is_sorted = |ends: &[usize]| {
                    ends[0] <= ends[1] && indices[ends[0]..ends[1]].is_sorted_by(|a, b| a < b)
                };
                if !is_whole || !starts.windows(2).all(is_sorted) {
                    return Err(PyValueError::new_err(
                        "the sparse matrix is not one of compressed columns with sorted rows: call tocsc() and \
                         sum_duplicates()",
                    ));
                }
                let pattern =
                    SymbolicSparseColMat::new_checked(*rows, *columns, starts, None, indices);
                Ok(SparseColMat::new(pattern, values).into())
            }
        }
    }
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

/// The matrix of a row-major slice, copied tile by tile.
fn from_rows(values: &[f64], rows: usize, columns: usize) -> Mat<f64> {
    let mut matrix = Mat::zeros(rows, columns);
    for first in (0..rows).step_by(TILE) {
        let last = rows.min(first + TILE);
        for left in (0..columns).step_by(TILE) {
            for j in left..columns.min(left + TILE) {
                let column = &mut matrix.col_as_slice_mut(j)[first..last];
                let entries = values[first * columns + j..].iter().step_by(columns);
                column.iter_mut().zip(entries).for_each(|(to, from)| *to = *from);
            }
        }
    }
    matrix
}

/// Rows and columns of a tile. Theory: the lines of the cache that a tile touches fit into its first level.
const TILE: usize = 32;

/// A vector of numpy, copied.
pub(crate) fn vector(array: &PyReadonlyArray1<'_, f64>) -> Vec<f64> {
    array.as_array().to_vec()
}
