//! Numbers of twice the digits, so that what a check finds is in the answer and not in the check.
//!
//! Sums after Knuth, products by a fused multiplication (Dekker 1971): relative errors of about 1e-31.

use std::ops::{Add, Mul, Neg, Sub};

/// The unevaluated sum of two numbers, the second below the last digit of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// Rounded to the usual digits.
    pub fn rounded(self) -> f64 {
        self.high + self.low
    }

    /// `high + low`, where `low` may overlap the last digits of `high`.
    fn normal(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }
}

/// `value 2^exponent`, without a rounding error unless it leaves the range of numbers.
pub fn shifted(value: f64, exponent: i32) -> f64 {
    // One factor of this kind may itself be outside of the range.
    let part = exponent / 3;
    [part, part, exponent - 2 * part]
        .into_iter()
        .fold(value, |value, part| value * 2_f64.powi(part))
}

impl From<f64> for Double {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let part = sum - self.high;
        let error = (self.high - (sum - part)) + (other.high - part);
        Self::normal(sum, error + self.low + other.low)
    }
}

impl Neg for Double {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Double {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = self.high * other.high;
        let error = self.high.mul_add(other.high, -product);
        Self::normal(product, error + (self.high * other.low + self.low * other.high))
    }
}

/// What rounding loses is kept.
#[test]
fn digits_are_kept() {
    let [one, tiny] = [1.0, 2_f64.powi(-80)].map(Double::from);
    assert_eq!((one + tiny - one).rounded().to_bits(), 2_f64.powi(-80).to_bits());
    let near = Double::from(1.0 + 2_f64.powi(-40));
    let square = near * near - one - Double::from(2_f64.powi(-39));
    assert_eq!(square.rounded().to_bits(), 2_f64.powi(-80).to_bits());
}

/// Powers of two are exact beyond what one factor could be.
#[test]
fn shifts_are_exact() {
    let least = f64::from_bits(1);
    assert_eq!(shifted(least, 2000).to_bits(), 2_f64.powi(926).to_bits());
    assert_eq!(
        shifted(3.0 * 2_f64.powi(1000), -2000).to_bits(),
        (3.0 * 2_f64.powi(-1000)).to_bits()
    );
}
