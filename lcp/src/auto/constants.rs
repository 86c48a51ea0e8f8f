//! The sizes that the choice of methods goes by, each with where it comes from.
//! A number that is "chosen" is so by judgement: no measurement is kept.

/// Up to this order, or so many contact points, pivots on a sparse matrix are as fast as factorisations, and say more.
/// Chosen.
pub(super) const FEW: usize = 500;
/// Factorisations of active sets if convergence is not guaranteed. Chosen.
pub(super) const TRIAL: usize = 100;

/// Attempts of pivots before choices of sides have their turn. Measured on planted indefinite problems: they find the
/// solution of all of 20 pairs, and take 2 ms at 18.
pub(super) const FEW_ATTEMPTS: usize = 40;
/// Pairs that depend on each other whose tree of choices comes right behind pivots. Measured on random problems: the tree
/// takes 0.02 s on average at 18, and 0.3 s at most.
pub(super) const FEW_PAIRS: usize = 18;
/// Exchanges of columns times the square of the order, which is the work of an exchange, over the whole tree. Measured: this
/// takes 1.5 s; triangular problems of 60 pairs take a tenth of it, those of 100 a quarter.
pub(super) const WORK: usize = 100_000_000;
/// One part in so many of the time left is kept for the methods that follow. Chosen: the first one is the most likely to
/// answer.
pub(super) const KEPT: u32 = 4;
/// More independent parts than these are small, and all of them together are one problem that is solved in the time of
/// some small ones: they are taken one by one only where that fails. Chosen.
pub(super) const MANY_PARTS: usize = 256;
