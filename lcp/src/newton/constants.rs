//! The numbers that the active set method goes by, each with where it comes from.
//! A number that is "chosen" is so by judgement: no measurement is kept.

/// Steps without fewer negative variables than ever before, after which fewer pairs are exchanged. Chosen.
pub(super) const PATIENCE: usize = 10;
/// The same once fewer than all are exchanged. Chosen.
pub(super) const REDUCED_PATIENCE: usize = 4;
