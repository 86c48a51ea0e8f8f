//! The number of pairs that are exchanged at once.

use std::collections::HashSet;

/// Steps without a new minimum of the number of negative variables, after which fewer pairs are exchanged; half of this
/// number once fewer than all pairs are exchanged. Chosen.
pub(crate) const PATIENCE: usize = 10;

/// The next exchange of negative variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// Exchange this number of pairs.
    Exchange(usize),
    /// Exchange this number of pairs, fewer than before, for lack of progress.
    Fewer(usize),
    /// Single exchanges led back to a free set.
    Cycle,
}

/// Exchanges of all pairs as long as there is progress, else of half as many, and so on down to single ones.
#[derive(Debug)]
pub(super) struct Exchanges {
    /// Whether exchanging all pairs converges although the number of negative variables may grow.
    is_monotone: bool,
    fewest: usize,
    most: usize,
    rounds: usize,
    /// Hashes of the free sets since `most` changed.
    seen: HashSet<u64>,
}

impl Exchanges {
    pub(super) fn new(is_monotone: bool) -> Self {
        let (fewest, most) = (usize::MAX, usize::MAX);
        Self { is_monotone, fewest, most, rounds: PATIENCE, seen: HashSet::new() }
    }

    /// The next exchange, after a free set with this hash and this number of negative variables.
    pub(super) fn next(&mut self, hash: u64, negative: usize) -> Next {
        let is_new = self.seen.insert(hash);
        if negative < self.fewest {
            self.fewest = negative;
            self.set(usize::MAX, PATIENCE, hash);
            return Next::Exchange(negative);
        }
        let is_single = self.most == 1;
        if !is_new && is_single {
            return Next::Cycle;
        }
        self.rounds = self.rounds.saturating_sub(1);
        let is_out_of_patience = self.rounds == 0 && !self.is_monotone && !is_single;
        if is_new && !is_out_of_patience {
            return Next::Exchange(self.most.min(negative));
        }
        self.set((self.most.min(negative) / 2).max(1), PATIENCE / 2, hash);
        Next::Fewer(self.most)
    }

    fn set(&mut self, most: usize, rounds: usize, hash: u64) {
        (self.most, self.rounds) = (most, rounds);
        self.seen.clear();
        self.seen.insert(hash);
    }
}
