//! The start of a sparse problem.

use super::{Equilibrated, Start, StartData};
use crate::lemke::constants::LARGEST_GROWTH;
use crate::lemke::sparse::SparseStart;
use crate::linear::inverse_norm;
use crate::sparse::{Columns, SparseLu};
use crate::vector::max_abs;
use crate::{Basis, Side};

impl Equilibrated<'_> {
    pub(super) fn sparse_start(&self, basis: &Basis) -> Option<Start> {
        let n = self.order();
        let side = |j: usize| basis.sides()[j];
        let picked: Vec<_> = (0..n).map(|j| (j, side(j))).collect();
        let lu = self.sparse_lu(&picked)?;
        let mut work = Vec::new();
        let norm = inverse_norm(n, |x, is_transposed| {
            if is_transposed { lu.solve_transpose(x, &mut work) } else { lu.solve(x, &mut work) }
        });
        if norm.is_nan() || norm > LARGEST_GROWTH {
            return None;
        }
        let mut right = self.right_hand_side();
        let mut q = right.clone();
        lu.solve(&mut q, &mut work);
        let size = max_abs(&q);
        if !size.is_finite() {
            return None;
        }
        if size > 0.0 {
            right.iter_mut().chain(&mut q).for_each(|v| *v /= size);
        }
        let others = (0..n).map(|j| (j, side(j).complement()));
        let columns = self.sparse_columns(picked.iter().copied().chain(others));
        let ones = vec![1.0; n];
        let (row_factor, col_factor) = self.factors(basis, &ones, &ones);
        Some(Start {
            basis: basis.clone(),
            free: self.free(),
            row_factor,
            col_factor,
            size: if size > 0.0 { size } else { 1.0 },
            q,
            data: StartData::Sparse(Box::new(SparseStart { columns, right, lu })),
        })
    }

    /// Equilibrated columns, without zeros.
    pub(crate) fn sparse_columns(&self, picked: impl Iterator<Item = (usize, Side)>) -> Columns {
        let mut columns = Columns::default();
        picked.for_each(|(pair, side)| self.push_column(pair, side, &mut columns));
        columns
    }

    /// The same; none is the right-hand side.
    pub(crate) fn sparse_columns_or_right(&self, picked: &[Option<(usize, Side)>]) -> Columns {
        let mut columns = Columns::default();
        for column in picked {
            if let Some((pair, side)) = *column {
                self.push_column(pair, side, &mut columns);
            } else {
                let right = self.right_hand_side().into_iter().enumerate();
                right.filter(|(_, v)| *v != 0.0).for_each(|(i, v)| columns.push(i, v));
                columns.close();
            }
        }
        columns
    }

    fn push_column(&self, pair: usize, side: Side, columns: &mut Columns) {
        let factor = self.factor(pair, side);
        self.problem.column(pair, side).for_each(|i, v| {
            if v != 0.0 {
                columns.push(i, factor * (v * self.row[i]));
            }
        });
        columns.close();
    }

    /// The factorised matrix of some columns, as many as there are rows; `None` when it is singular to
    /// working precision.
    pub(crate) fn sparse_lu(&self, picked: &[(usize, Side)]) -> Option<SparseLu> {
        let (lu, replaced) = SparseLu::new(&self.sparse_columns(picked.iter().copied()));
        replaced.is_empty().then_some(lu)
    }
}
