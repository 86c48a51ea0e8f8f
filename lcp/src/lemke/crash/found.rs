//! What a search for a start basis finds, dense or sparse, and what both searches go by.

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

/// A chosen column of a pair, and the place in the queue of the one that it takes the place of.
pub(super) type Exchange = (usize, Side, Option<usize>);

/// The chosen columns after all exchanges that led to a place of the queue.
pub(super) fn exchanged(
    chosen: &[Option<Side>],
    queue: &[Exchange],
    last: usize,
) -> Vec<Option<Side>> {
    let mut next = chosen.to_vec();
    let mut at = Some(last);
    while let Some(i) = at {
        let (pair, side, from) = queue[i];
        next[pair] = Some(side);
        at = from;
    }
    next
}

/// Both columns of pairs without one, with which chains begin.
pub(super) fn beginnings(pairs: impl Iterator<Item = usize>, preferred: &[Side]) -> Vec<Exchange> {
    pairs.flat_map(|k| [(k, preferred[k], None), (k, preferred[k].complement(), None)]).collect()
}
