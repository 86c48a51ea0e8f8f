//! Sparse symmetric matrices of free sets.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::forest::{NONE, postordered};
use super::kernel::{Kernel, Outcome, is_vanishing};
use crate::Matrix;
use crate::matrix::Storage;

/// Cholesky's method in an order of the whole matrix, by supernodes where these are large.
pub(super) struct SparseCholesky<'a> {
    m: &'a Matrix,
    /// By approximate minimum degree (Amestoy, Davis and Duff 1996).
    order: Vec<usize>,
    /// The free pairs in the order in which they are eliminated.
    free: Vec<usize>,
    place: Vec<usize>,
    symbolic: Option<SymbolicCholesky<usize>>,
    values: Vec<f64>,
}

impl<'a> SparseCholesky<'a> {
    pub(super) fn new(m: &'a Matrix) -> Self {
        let place = vec![NONE; m.ncols()];
        let order = minimum_degree(m).unwrap_or_else(|| (0..m.ncols()).collect());
        Self { m, order, free: Vec::new(), place, symbolic: None, values: Vec::new() }
    }

    /// `None` where the matrix is not positive definite, or memory does not suffice.
    fn factorised(&mut self, is_free: &[bool]) -> Option<SymbolicCholesky<usize>> {
        let order = self.order.iter().copied().filter(|&j| is_free[j]);
        self.free = postordered(self.m, order, &mut self.place);
        let upper = Upper::new(self.m, &self.free, &self.place);
        let matrix = upper.as_ref();
        let (ordering, params) = (SymmetricOrdering::Identity, CholeskySymbolicParams::default());
        let symbolic =
            factorize_symbolic_cholesky(matrix.symbolic(), Side::Upper, ordering, params).ok()?;
        // Not cleared: it is overwritten.
        self.values.resize(symbolic.len_val(), 0.0);
        let requirement = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, <_>::default());
        let mut memory = MemBuffer::try_new(requirement).ok()?;
        symbolic
            .factorize_numeric_llt(
                &mut self.values,
                matrix,
                Side::Upper,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                <_>::default(),
            )
            .ok()?;
        Some(symbolic)
    }

    fn is_singular(&self, symbolic: &SymbolicCholesky<usize>) -> bool {
        let is_vanishing = |k: usize, l: f64| {
            let j = self.free[k];
            is_vanishing(l, self.m[(j, j)])
        };
        match symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                let starts = symbolic.col_ptr().iter().take(self.free.len());
                starts.enumerate().any(|(k, &start)| is_vanishing(k, self.values[start]))
            }
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                let factor = SupernodalLltRef::new(symbolic, &self.values);
                (0..symbolic.n_supernodes()).any(|s| {
                    let node = factor.supernode(s);
                    let l = node.val();
                    (0..l.ncols()).any(|k| is_vanishing(node.start() + k, l[(k, k)]))
                })
            }
        }
    }
}

impl Kernel for SparseCholesky<'_> {
    fn factorise(&mut self, is_free: &[bool]) -> Outcome {
        self.symbolic = None;
        let Some(symbolic) = self.factorised(is_free) else { return Outcome::Unsuited };
        let is_singular = self.is_singular(&symbolic);
        self.symbolic = Some(symbolic);
        if is_singular { Outcome::Singular } else { Outcome::Regular }
    }

    fn solve(&mut self, x: &mut [f64]) {
        let Some(symbolic) = &self.symbolic else { return };
        let mut packed: Vec<f64> = self.free.iter().map(|&i| x[i]).collect();
        let order = packed.len();
        let requirement: StackReq = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::new(requirement);
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut packed, order, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        self.free.iter().zip(packed).for_each(|(&i, v)| x[i] = v);
    }
}

/// The upper triangle of the matrix of the free pairs, in their order.
struct Upper {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl Upper {
    fn new(m: &Matrix, free: &[usize], place: &[usize]) -> Self {
        let mut upper = Self { starts: vec![0], rows: Vec::new(), values: Vec::new() };
        let mut column = Vec::new();
        for (k, &j) in free.iter().enumerate() {
            column.clear();
            m.slice(j).for_each(|i, v| {
                // False for pairs that are not free.
                if place[i] <= k {
                    column.push((place[i], v));
                }
            });
            column.sort_unstable_by_key(|(row, _)| *row);
            upper.rows.extend(column.iter().map(|(row, _)| *row));
            upper.values.extend(column.iter().map(|(_, v)| *v));
            upper.starts.push(upper.rows.len());
        }
        upper
    }

    fn as_ref(&self) -> SparseColMatRef<'_, usize, f64> {
        let n = self.starts.len() - 1;
        let pattern = SymbolicSparseColMatRef::new_checked(n, n, &self.starts, None, &self.rows);
        SparseColMatRef::new(pattern, &self.values)
    }
}

fn minimum_degree(m: &Matrix) -> Option<Vec<usize>> {
    let Storage::Sparse(m) = m.storage() else { return None };
    let (n, stored) = (m.ncols(), m.compute_nnz());
    let (mut order, mut inverse) = (vec![0_usize; n], vec![0_usize; n]);
    let mut memory = MemBuffer::try_new(amd::order_scratch::<usize>(n, stored)).ok()?;
    let control = amd::Control::default();
    amd::order(&mut order, &mut inverse, m.symbolic(), control, MemStack::new(&mut memory)).ok()?;
    Some(order)
}
