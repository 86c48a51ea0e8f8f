//! Factors `L D L^T` of sparse symmetric positive definite matrices.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::cholesky::{
    LdltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::VANISHING;

/// What takes the place of a pivot that vanishes: its variable becomes zero.
const HELD: f64 = 1e60;

/// Factors of matrices with one pattern, again and again for other values, in an order of approximate minimum degree.
pub(super) struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
}

impl Cholesky {
    /// For the pattern of the lower triangle.
    pub(super) fn new(lower: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let order = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(lower, Side::Lower, order, <_>::default())?;
        let values = vec![0.0; symbolic.len_val()];
        Ok(Self { symbolic, values })
    }

    /// Factorises a matrix of finite numbers whose diagonal is of order one. The variables of pivots that vanish will be
    /// zero, which iterative refinement of the caller has to make good.
    pub(super) fn factorise(&mut self, lower: SparseColMatRef<'_, usize, f64>) {
        let signs = vec![1; lower.ncols()];
        let regularization = LdltRegularization {
            dynamic_regularization_signs: Some(&signs),
            dynamic_regularization_delta: HELD,
            dynamic_regularization_epsilon: VANISHING,
        };
        let (par, spec) = (Par::Seq, Spec::default());
        let scratch = self.symbolic.factorize_numeric_ldlt_scratch::<f64>(par, spec);
        let (mut memory, values) = (MemBuffer::new(scratch), &mut self.values);
        let stack = MemStack::new(&mut memory);
        let side = Side::Lower;
        let outcome = self.symbolic.factorize_numeric_ldlt(
            values,
            lower,
            side,
            regularization,
            par,
            stack,
            spec,
        );
        let outcome = outcome.map(|_| ());
        if outcome.is_err() {
            // Numbers that overflow leave none in the solutions.
            self.values.fill(f64::NAN);
        }
    }

    /// Overwrites right-hand sides, one after the other, with the solutions.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let order = self.symbolic.nrows();
        let count = x.len() / order.max(1);
        let scratch: StackReq = self.symbolic.solve_in_place_scratch::<f64>(count, Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        let x = MatMut::from_column_major_slice_mut(x, order, count);
        let factors = LdltRef::new(&self.symbolic, &self.values);
        factors.solve_in_place_with_conj(Conj::No, x, Par::Seq, MemStack::new(&mut memory));
    }
}
