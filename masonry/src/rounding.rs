//! What of a number is a rounding error: to who sees no more than the equations it is a coupling or a load.

/// Sums and products of the data are wrong by this part of their largest term.
const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64;

/// The value, or zero where it is a rounding error beside numbers of this size.
pub(crate) fn cleared(value: f64, size: f64) -> f64 {
    if value.abs() <= ROUNDING * size { 0.0 } else { value }
}

/// The largest size of some numbers.
pub(crate) fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, v| largest.max(v.abs()))
}

/// A number to six digits: messages tell sizes of mistakes, not their rounding errors.
pub(crate) fn rounded(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}
