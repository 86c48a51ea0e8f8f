//! What a matrix shows without a factorisation.

use crate::Matrix;
use crate::matrix::DATA_ROUNDING;

/// How far a matrix is symmetric.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Symmetry {
    /// Not at all.
    None,
    /// Nothing more is known.
    Symmetric,
    /// And with a diagonal of ones dominated by it: so it is positive semidefinite.
    Dominant,
}

/// What a matrix shows at one glance at each of its entries.
///
/// None of it depends on the units of single variables: multiplying row `i` by `d_i > 0` and column `i`
/// too changes nothing, and signs bear any positive factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Facts {
    pub(super) order: usize,
    pub(super) nonzeros: usize,
    pub(super) is_sparse: bool,
    pub(super) symmetry: Symmetry,
    pub(super) has_positive_diagonal: bool,
    /// No entry off the diagonal is positive.
    pub(super) is_z_matrix: bool,
}

impl Facts {
    pub(super) fn of(m: &Matrix) -> Self {
        let order = m.ncols();
        let diagonal: Vec<f64> = (0..order).map(|i| m[(i, i)]).collect();
        let has_positive_diagonal = diagonal.iter().all(|d| *d > 0.0);
        let symmetry = match m.check_symmetric("M") {
            Err(_) => Symmetry::None,
            Ok(()) if has_positive_diagonal && is_dominant(m, &diagonal) => Symmetry::Dominant,
            Ok(()) => Symmetry::Symmetric,
        };
        let nonzeros = |j| m.column(j).filter(|(_, v)| *v != 0.0).count();
        let nonzeros = if m.is_sparse() { (0..order).map(nonzeros).sum() } else { order * order };
        Self {
            order,
            nonzeros,
            is_sparse: m.is_sparse(),
            symmetry,
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

    /// The size, and the symmetry.
    pub(super) fn describe(&self) -> String {
        let kind = match self.symmetry {
            Symmetry::Dominant => "symmetric and diagonally dominant",
            Symmetry::Symmetric => "symmetric",
            Symmetry::None => "not symmetric",
        };
        format!("{}, {kind}", self.size())
    }
}

pub(super) fn is_z_matrix(m: &Matrix) -> bool {
    (0..m.ncols()).all(|j| m.column(j).all(|(i, v)| i == j || v <= 0.0))
}

/// `sum_j |M_ij| / sqrt(M_ii M_jj) <= 1` for every `i`, up to rounding.
fn is_dominant(m: &Matrix, diagonal: &[f64]) -> bool {
    let roots: Vec<f64> = diagonal.iter().map(|d| d.sqrt()).collect();
    let off_diagonal = |j: usize| {
        let terms = m.column(j).filter(|(i, _)| *i != j);
        terms.map(|(i, v)| v.abs() / roots[i] / roots[j]).sum::<f64>()
    };
    (0..m.ncols()).all(|j| off_diagonal(j) <= 1.0 + DATA_ROUNDING)
}
