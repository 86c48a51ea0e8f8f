//! The numbers that the sweeps go by, each with where it comes from.
//! What is "chosen" is so by judgement: no measurement is kept.

/// A row whose terms are all at the rounding level of the point is measured by this part of the largest term that it
/// could have. Chosen.
pub(super) const FLOOR: f64 = 1.0 / (1 << 10) as f64;
/// Least number of sweeps in which the residual has to fall, if the settings leave it open. Chosen.
pub(super) const LEAST_WINDOW: usize = 2000;
/// Most numbers of `K^-1 C^T` that are kept. Chosen: a quarter of a GB.
pub(super) const LARGEST: usize = 1 << 25;
