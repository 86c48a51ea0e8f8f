//! Cholesky's method for sparse symmetric positive definite matrices, again and again for other values.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::degree::minimum_degree;

/// Pivots below this multiple of the diagonal are rounding errors. Rounding: some eps.
const VANISHING: f64 = 1e-15;
/// What takes their place, so that their variable is zero, which iterative refinement of the caller has to make good.
const HELD: f64 = 1e60;

/// The factors `L D L^T` of matrices with one pattern. (Where a pivot is replaced, faer's `L L^T` keeps a wrong diagonal.)
pub(super) struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    /// Of the pivots.
    signs: Vec<i8>,
    memory: MemBuffer,
}

impl Cholesky {
    /// For the pattern of the lower triangle.
    pub(super) fn new(lower: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let (order, place) = minimum_degree(lower)?;
        let ordering = SymmetricOrdering::Custom(PermRef::new_checked(&order, &place, order.len()));
        // Simplicial factors take three times as long on walls of 1000 bricks, and the same time on smaller ones.
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(lower, Side::Lower, ordering, params)?;
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, <_>::default());
        let memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
        let values = vec![0.0; symbolic.len_val()];
        let signs = vec![1; symbolic.nrows()];
        Ok(Self { symbolic, values, signs, memory })
    }

    /// Factorises a matrix of finite numbers whose diagonal is of order one.
    pub(super) fn factorise(&mut self, lower: SparseColMatRef<'_, usize, f64>) {
        let held = LdltRegularization {
            dynamic_regularization_signs: Some(&self.signs),
            dynamic_regularization_delta: HELD,
            dynamic_regularization_epsilon: VANISHING,
        };
        let outcome = self.symbolic.factorize_numeric_ldlt(
            &mut self.values,
            lower,
            Side::Lower,
            held,
            Par::Seq,
            MemStack::new(&mut self.memory),
            <_>::default(),
        );
        outcome.unwrap_or_else(|_| unreachable!("vanishing pivots are replaced"));
    }

    /// Overwrites right-hand sides with the solutions.
    pub(super) fn solve(&self, right: MatMut<'_, f64>) {
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(right.ncols(), Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            right,
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }

    /// How many numbers the factors have.
    pub(super) fn stored(&self) -> usize {
        self.values.len()
    }
}

#[cfg(test)]
mod tests {
    use faer::sparse::{SparseColMat, Triplet};

    use super::*;

    /// Every variable is there twice, so half of the pivots vanish: the others solve the equations.
    #[test]
    fn variables_with_vanishing_pivots_are_zero() {
        const HALF: usize = 20;
        let entry = |i: usize, j: usize| if i == j { 1.0 } else { 0.5 / (1.0 + (i + j) as f64) };
        let twice = |i: usize, j: usize| entry(i % HALF, j % HALF);
        let n = 2 * HALF;
        let lower: Vec<_> =
            (0..n).flat_map(|j| (j..n).map(move |i| Triplet::new(i, j, twice(i, j)))).collect();
        let lower = SparseColMat::try_new_from_triplets(n, n, &lower).expect("inside");
        let mut factors = Cholesky::new(lower.symbolic()).expect("memory");
        factors.factorise(lower.as_ref());
        let exact = |j: usize| (j % 7) as f64 - 3.0;
        let right = |i: usize| (0..HALF).map(|j| twice(i, j) * exact(j)).sum::<f64>();
        let mut x = faer::Mat::from_fn(n, 1, |i, _| right(i));
        factors.solve(x.as_mut());
        let error = |j: usize| (x[(j, 0)] + x[(j + HALF, 0)] - exact(j)).abs();
        assert!((0..HALF).all(|j| error(j) < 1e-9), "{x:?}");
        let least = |j: usize| x[(j, 0)].abs().min(x[(j + HALF, 0)].abs());
        assert!((0..HALF).all(|j| least(j) < 1e-9), "{x:?}");
    }
}
