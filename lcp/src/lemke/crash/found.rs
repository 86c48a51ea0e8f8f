//! What a search for a start basis finds, dense or sparse.

use crate::{Basis, Matrix, Side};

/// As many independent columns as there are, at most one of every pair.
pub(crate) enum Crash {
    /// One of every pair.
    Complete(Basis),
    /// Pairs without a column, as many as there are columns that complete the chosen ones: an
    /// orthonormal basis of what these leave out, or unit columns.
    Partial { chosen: Vec<Option<Side>>, complement: Matrix },
    /// The time was over first.
    Late,
}
