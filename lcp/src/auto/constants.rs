//! The sizes on which the choice of methods is based, each with its origin. A number that is "chosen" is set by
//! judgement: no measurement is kept.

/// Up to this order, or this number of contact points, pivots on a sparse matrix are as fast as factorisations and give
/// more information. Chosen.
pub(super) const FEW: usize = 500;
/// Factorisations of active sets if convergence is not guaranteed. Chosen.
pub(super) const TRIAL: usize = 100;

/// Attempts of pivots before enumeration. Measured on planted indefinite problems: the attempts solve all those of 20
/// pairs, and take 2 ms for 18.
pub(super) const FEW_ATTEMPTS: usize = 40;
/// Largest number of pairs in a block of dependent variables for which enumeration follows directly after pivots.
/// Measured on random problems: the tree takes 0.02 s on average for 18 pairs, and 0.3 s at most.
pub(super) const FEW_PAIRS: usize = 18;
/// Exchanges of columns times the square of the order, which is the work of an exchange, over the whole tree. Measured:
/// this number takes 1.5 s; triangular problems of 60 pairs take a tenth of it, those of 100 a quarter.
pub(super) const WORK: usize = 100_000_000;
/// The reciprocal of the share of the time left that is kept for the methods that follow. Chosen: the first method is
/// the most likely to answer.
pub(super) const KEPT: u32 = 4;
/// More independent parts than this number are small, and the whole problem is solved in the time of some small ones:
/// the parts are taken one by one only if that fails. Chosen.
pub(super) const MANY_PARTS: usize = 256;
