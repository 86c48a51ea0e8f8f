//! What factorisations of the matrices of free sets have in common.

use super::constants::VANISHING;
use crate::Matrix;
use crate::scaling::equilibrate;

/// What came of a factorisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Systems can be solved.
    Regular,
    /// The matrix is singular to working precision.
    Singular,
    /// This is not a matrix for this kind of factorisation.
    Unsuited,
}

/// A factorisation of `M_FF`.
pub(super) trait Kernel {
    /// Factorises the matrix of some pairs, at least one.
    fn factorise(&mut self, is_free: &[bool]) -> Outcome;

    /// Overwrites a right-hand side, zero for pairs that are not free, with the solution.
    fn solve(&mut self, x: &mut [f64]);
}

/// Whether a pivot, the square of a diagonal entry of `L`, is a rounding error against the diagonal entry of
/// the matrix from which it comes.
pub(super) fn is_vanishing(l: f64, diagonal: f64) -> bool {
    let root = (VANISHING * diagonal).sqrt();
    l.is_nan() || l <= root
}

/// Factors of rows and columns, powers of two, that bring the entries of a matrix near one.
pub(super) fn scales(m: &Matrix) -> (Vec<f64>, Vec<f64>) {
    let columns: Vec<_> = (0..m.ncols()).map(|j| m.slice(j)).collect();
    equilibrate(m.nrows(), &columns)
}
