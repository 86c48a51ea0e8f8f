//! What a matrix shows without a factorisation.

use crate::Matrix;

/// What a matrix shows at one glance at each of its entries.
///
/// None of it depends on the units of single variables: multiplying row `i` by `d_i > 0` and column `i`
/// too changes nothing, and signs bear any positive factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Facts {
    pub(super) order: usize,
    pub(super) nonzeros: usize,
    pub(super) is_sparse: bool,
    pub(super) has_positive_diagonal: bool,
    /// No entry off the diagonal is positive.
    pub(super) is_z_matrix: bool,
}

impl Facts {
    pub(super) fn of(m: &Matrix) -> Self {
        let order = m.ncols();
        let has_positive_diagonal = (0..order).all(|i| m[(i, i)] > 0.0);
        let nonzeros = |j| m.column(j).filter(|(_, v)| *v != 0.0).count();
        let nonzeros = if m.is_sparse() { (0..order).map(nonzeros).sum() } else { order * order };
        Self {
            order,
            nonzeros,
            is_sparse: m.is_sparse(),
            has_positive_diagonal,
            is_z_matrix: is_z_matrix(m),
        }
    }

    /// For the reason of a choice: the size, and how the matrix is stored.
    pub(super) fn size(&self) -> String {
        let Self { order, nonzeros, .. } = self;
        if self.is_sparse {
            format!("order {order}, sparse with {nonzeros} nonzeros")
        } else {
            format!("order {order}, dense")
        }
    }
}

pub(super) fn is_z_matrix(m: &Matrix) -> bool {
    (0..m.ncols()).all(|j| m.column(j).all(|(i, v)| i == j || v <= 0.0))
}
