//! The numbers that the active set method goes by, each with where it comes from.
//! What is "chosen" is so by judgement: no measurement is kept.

/// Steps without fewer negative variables than ever before, after which fewer pairs are exchanged. Chosen.
pub(super) const PATIENCE: usize = 10;
/// The same once fewer than all are exchanged. Chosen.
pub(super) const REDUCED_PATIENCE: usize = 4;
/// Largest residual, relative to the terms of its row, of a system that counts as solved. Chosen.
pub(super) const USABLE: f64 = 1e-6;
/// Residuals that a step of refinement would not decrease. Rounding: a few eps.
pub(super) const REFINED: f64 = 8.0 * f64::EPSILON;
