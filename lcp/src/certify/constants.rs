//! The numbers that the judge uses, each with its origin. A number that is "chosen" is set by judgement: no
//! measurement is kept.

use crate::vector::WEAK;

/// The rounding error of a row whose variables are rounded, relative to its terms. Rounding: errors of short sums.
pub(crate) const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// The smallest load beside others, and the largest rounding error beside loads, however large the terms are. Chosen.
pub(crate) const MILLIONTH: f64 = WEAK * WEAK;
/// The factor for points whose sums of products exceed the range of numbers: one over more than any number of terms.
pub(super) const INTO_RANGE: f64 = 1.0 / (1_u64 << 60) as f64;
