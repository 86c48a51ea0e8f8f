//! Removal of rounding errors, which would otherwise act as couplings or loads in the equations, and rounding of
//! numbers in messages.

use std::borrow::Borrow;

/// Relative rounding error of sums and products of the data, relative to their largest term \[-\].
const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64;

/// Returns the value, or zero if the value is only a rounding error compared with numbers of this size.
pub fn cleared(value: f64, size: f64) -> f64 {
    if value.abs() <= ROUNDING * size { 0.0 } else { value }
}

/// Returns the largest absolute value of some numbers.
pub fn largest(values: impl IntoIterator<Item = impl Borrow<f64>>) -> f64 {
    values.into_iter().fold(0.0, |largest, v| largest.max(v.borrow().abs()))
}

/// The side of a number to which its text is rounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundSide {
    Below,
    Above,
}

/// Returns the text of a bound, rounded to the given side: the nearest text that is not on the other side of the
/// bound.
pub fn outwards(bound: f64, side: BoundSide, text: impl Fn(f64) -> String) -> String {
    let is_outside = |text: &str| {
        text.parse().is_ok_and(|read: f64| match side {
            BoundSide::Below => read <= bound,
            BoundSide::Above => read >= bound,
        })
    };
    let mut step = 0.0;
    loop {
        let shifted = if side == BoundSide::Below { bound - step } else { bound + step };
        let candidate = text(shifted);
        if is_outside(&candidate) || !shifted.is_finite() {
            return candidate;
        }
        step = (2.0 * step).max(f64::EPSILON * bound.abs());
    }
}

/// Rounds a number to six digits: messages show sizes of mistakes, not their rounding errors.
pub fn rounded(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_of_a_bound_is_a_bound() {
        let text = |it: f64| format!("{it:.4}");
        for (bound, below, above) in [
            (0.640_349_99, "0.6403", "0.6404"),
            (0.640_250_01, "0.6402", "0.6403"),
            (0.25, "0.2500", "0.2500"),
            (-1.000_01, "-1.0001", "-1.0000"),
            (0.0, "0.0000", "0.0000"),
            (9.999_99, "9.9999", "10.0000"),
        ] {
            assert_eq!(outwards(bound, BoundSide::Below, text), below);
            assert_eq!(outwards(bound, BoundSide::Above, text), above);
        }
        for bound in [f64::NAN, f64::INFINITY] {
            assert_eq!(outwards(bound, BoundSide::Above, text), text(bound));
        }
    }
}
