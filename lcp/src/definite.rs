//! Tests whether a symmetric matrix is positive semidefinite.

use faer::Side;
use faer::sparse::SparseColMat;
use faer::sparse::linalg::LltError;

use crate::Matrix;
use crate::matrix::{column_of, diagonal};
use crate::vector::{HALF_DIGITS, max_abs};

/// Eigenvalues, of the matrix with a diagonal of ones, that are at least minus this number count as nonnegative.
/// Chosen.
const ROUNDING: f64 = 1e-10;
/// Largest order for which the least eigenvalue is computed from a dense matrix for the message. Chosen: the time is
/// negligible up to this order.
const DENSE: usize = 300;

/// The reason for which a symmetric matrix is not positive semidefinite; `None` if it is. The test is a Cholesky
/// factorisation of the matrix scaled to a diagonal of ones, so that units do not matter, plus a small multiple of the
/// identity. The factorisation succeeds for a semidefinite matrix, whatever its kernel, and fails for an eigenvalue
/// below `-1e-10`.
pub(crate) fn indefiniteness(what: &str, matrix: &SparseColMat<usize, f64>) -> Option<String> {
    let n = matrix.ncols();
    let diagonal = diagonal(matrix);
    if let Some(i) = diagonal.iter().position(|d| *d < 0.0) {
        return Some(format!(
            "{what} is not positive semidefinite: {what}[{i}, {i}] is {}",
            diagonal[i]
        ));
    }
    let scaled = unit_diagonal(matrix, &diagonal, ROUNDING);
    match scaled.sp_cholesky(Side::Lower) {
        // The result is unknown if memory does not suffice.
        Ok(_) | Err(LltError::Generic(_)) => None,
        Err(LltError::Numeric(_)) if n <= DENSE => {
            let least = least_eigenvalue(&scaled) - ROUNDING;
            Some(format!(
                "{what}, scaled to a diagonal of ones, has the eigenvalue {least:.3e}, so that it is \
                 not positive semidefinite"
            ))
        }
        Err(LltError::Numeric(_)) => Some(format!(
            "{what}, scaled to a diagonal of ones, has an eigenvalue below {:.0e}, so that it is not \
             positive semidefinite",
            -ROUNDING
        )),
    }
}

/// Whether a symmetric positive semidefinite matrix is safely nonsingular.
pub(crate) fn is_definite(matrix: &SparseColMat<usize, f64>) -> bool {
    let diagonal = diagonal(matrix);
    diagonal.iter().all(|d| *d > 0.0)
        && unit_diagonal(matrix, &diagonal, -HALF_DIGITS).sp_cholesky(Side::Lower).is_ok()
}

/// The matrix with rows and columns divided by the roots of its diagonal, plus `shift` on the diagonal. Diagonal
/// entries at the rounding level of the largest one do not serve as units.
fn unit_diagonal(
    matrix: &SparseColMat<usize, f64>,
    diagonal: &[f64],
    shift: f64,
) -> SparseColMat<usize, f64> {
    let n = matrix.ncols();
    let largest = max_abs(diagonal);
    let floor = if largest > 0.0 { 4.0 * f64::EPSILON * largest } else { 1.0 };
    let unit: Vec<f64> = diagonal.iter().map(|d| d.max(floor).sqrt()).collect();
    let entries = (0..n).flat_map(|j| {
        let unit = &unit;
        column_of(matrix, j).map(move |(i, v)| (i, j, v / unit[i] / unit[j]))
    });
    Matrix::from_entries(n, n, entries.chain((0..n).map(|i| (i, i, shift)))).into_sparse()
}

fn least_eigenvalue(matrix: &SparseColMat<usize, f64>) -> f64 {
    let values = matrix.to_dense().self_adjoint_eigenvalues(Side::Lower).unwrap_or_default();
    values.into_iter().fold(f64::INFINITY, f64::min)
}
