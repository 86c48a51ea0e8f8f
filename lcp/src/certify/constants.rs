//! The numbers that the judge goes by, each with where it comes from.
//! What is "chosen" is so by judgement: no measurement is kept.

/// The rounding error of a row whose variables are rounded, relative to its terms. Rounding: errors of short sums.
pub(crate) const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// More than this of the loads is not a rounding error, however large the terms are. Chosen.
pub(super) const LARGEST_ROUNDING: f64 = 1e-6;
/// Residuals above this may be due to rows that do not matter, or need twice the digits. Rounding: some hundred eps.
pub(super) const SMALL: f64 = 1e-13;
/// What is left of the loads below this part of the other residuals says that these do not matter. Chosen.
pub(super) const MINOR: f64 = 1e-2;

/// Couplings below this part of the strongest ones of their row, once rows and columns are equilibrated, are weak.
/// Chosen.
pub(super) const STRONG: f64 = 1.0 / (1 << 10) as f64;
/// Rounds in which loads are passed on through weak couplings. Chosen.
pub(super) const ROUNDS: usize = 4;
/// By what numbers are multiplied if sums of their products leave the range of numbers. Chosen: more than any number of terms.
pub(super) const INTO_RANGE: f64 = 1.0 / (1_u64 << 60) as f64;
/// A load of this part of those around it counts in full. Chosen.
pub(super) const FULL: f64 = 1.0 / (1 << 20) as f64;
/// A row that is worth this counts in full. Chosen: chains are not the only way to the loads.
pub(super) const IN_FULL: f64 = 1.0 / 32.0;
/// Every variable with more than this of the largest term of a row speaks for the row. Chosen.
pub(super) const SPEAKS: f64 = 1.0 / 1024.0;

/// Rounding of a sum of a proof, for each of its terms, relative to their sizes. Rounding: of a product and of a sum.
pub(super) const SUM_ROUNDING: f64 = 2.0 * f64::EPSILON;
/// Products with columns above this part of their terms are no rounding errors of a vector that was computed. Chosen.
pub(super) const LARGEST_OF_VECTOR: f64 = 1e-12;
/// How many times the largest of these the value that must be positive has to be. Chosen.
pub(super) const CLEAR: f64 = 1024.0;
/// What the rows of a ray may miss, relative to their terms. Chosen: the root of eps; it proves nothing.
pub(super) const RAY_ROUNDING: f64 = 1e-8;
