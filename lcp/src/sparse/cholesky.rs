//! Cholesky's method for sparse symmetric positive definite matrices, again and again for other values.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::degree::minimum_degree;

/// Pivots below this multiple of the diagonal are rounding errors. Rounding: some eps.
const VANISHING: f64 = 1e-15;
/// What takes their place, so that their variable is zero, which iterative refinement of the caller has to make good.
const HELD: f64 = 1e60;

/// The factors of matrices with one pattern.
pub(super) struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl Cholesky {
    /// For the pattern of the lower triangle.
    pub(super) fn new(lower: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let (order, place) = minimum_degree(lower)?;
        let ordering = SymmetricOrdering::Custom(PermRef::new_checked(&order, &place, order.len()));
        let params = CholeskySymbolicParams::default();
        let symbolic = factorize_symbolic_cholesky(lower, Side::Lower, ordering, params)?;
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, <_>::default());
        let memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
        let values = vec![0.0; symbolic.len_val()];
        Ok(Self { symbolic, values, memory })
    }

    /// Factorises a matrix whose diagonal is of order one.
    pub(super) fn factorise(&mut self, lower: SparseColMatRef<'_, usize, f64>) {
        let held = LltRegularization {
            dynamic_regularization_delta: HELD,
            dynamic_regularization_epsilon: VANISHING,
        };
        let outcome = self.symbolic.factorize_numeric_llt(
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
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
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
