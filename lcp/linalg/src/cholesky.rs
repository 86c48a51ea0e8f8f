//! Factors `L D L^T` of sparse symmetric matrices.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use crate::VANISHING;

/// Number of operations for each stored number, relative to faer's choice, from which columns are eliminated together.
///
/// Measured on matrices of walls: a factorisation at 1000 bricks, far below that choice, takes a quarter of the time of
/// one by single columns; at 100 bricks as much; in arches, which are chains, a third more.
const TOGETHER: SupernodalThreshold = SupernodalThreshold(0.3);

/// Factors of matrices with one pattern, again and again for other values, in an order of approximate minimum degree.
pub struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
}

impl Cholesky {
    /// Plans factors for the pattern of the lower triangle.
    ///
    /// # Errors
    /// If memory does not suffice.
    pub fn new(lower: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: TOGETHER,
            ..Default::default()
        };
        let order = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(lower, Side::Lower, order, params)?;
        let values = vec![0.0; symbolic.len_val()];
        Ok(Self { symbolic, values })
    }

    /// Factorises a symmetric matrix without exchanges; `None` if a pivot is zero, or numbers overflow.
    pub fn factorise(&mut self, lower: SparseColMatRef<'_, usize, f64>) -> Option<()> {
        self.numeric(lower, LdltRegularization::default())
    }

    /// Factorises a positive semidefinite matrix with a diagonal of order one. Variables of pivots that vanish become
    /// zero, which the caller has to correct by iterative refinement.
    pub(super) fn factorise_semidefinite(&mut self, lower: SparseColMatRef<'_, usize, f64>) {
        let signs = vec![1; lower.ncols()];
        let held = LdltRegularization {
            dynamic_regularization_signs: Some(&signs),
            // So large that everything else vanishes beside it.
            dynamic_regularization_delta: f64::MAX.sqrt(),
            dynamic_regularization_epsilon: VANISHING,
        };
        if self.numeric(lower, held).is_none() {
            // Numbers that overflow leave none in the solutions.
            self.values.fill(f64::NAN);
        }
    }

    fn numeric(
        &mut self,
        lower: SparseColMatRef<'_, usize, f64>,
        regularization: LdltRegularization<'_, f64>,
    ) -> Option<()> {
        let (par, spec) = (Par::Seq, Spec::default());
        let scratch = self.symbolic.factorize_numeric_ldlt_scratch::<f64>(par, spec);
        let mut memory = MemBuffer::try_new(scratch).ok()?;
        let outcome = self.symbolic.factorize_numeric_ldlt(
            &mut self.values,
            lower,
            Side::Lower,
            regularization,
            par,
            MemStack::new(&mut memory),
            spec,
        );
        outcome.ok().map(|_| ())
    }

    /// The pivot of every variable.
    pub fn pivots(&self) -> Vec<f64> {
        let n = self.symbolic.nrows();
        let mut ordered = Vec::with_capacity(n);
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(raw) => {
                ordered.extend(raw.col_ptr()[..n].iter().map(|&start| self.values[start]));
            }
            SymbolicCholeskyRaw::Supernodal(raw) => {
                let factors = SupernodalLdltRef::new(raw, &self.values);
                for s in 0..raw.n_supernodes() {
                    let block = factors.supernode(s).val();
                    ordered.extend((0..block.ncols()).map(|k| block[(k, k)]));
                }
            }
        }
        let mut pivots = ordered.clone();
        if let Some(order) = self.symbolic.perm() {
            ordered.iter().zip(order.arrays().0).for_each(|(pivot, &i)| pivots[i] = *pivot);
        }
        pivots
    }

    /// Overwrites right-hand sides, one after the other, with the solutions.
    pub fn solve(&self, x: &mut [f64]) {
        let order = self.symbolic.nrows();
        let count = x.len() / order.max(1);
        let scratch: StackReq = self.symbolic.solve_in_place_scratch::<f64>(count, Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        let x = MatMut::from_column_major_slice_mut(x, order, count);
        let factors = LdltRef::new(&self.symbolic, &self.values);
        factors.solve_in_place_with_conj(Conj::No, x, Par::Seq, MemStack::new(&mut memory));
    }
}
