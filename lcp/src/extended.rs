//! Numbers of twice the digits.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// The unevaluated sum of two numbers, the second at most half a unit in the last place of the first: about
/// 31 decimal digits, in the range of `f64`.
///
/// Sums are exact up to the last digits by Knuth's two-sum, products by a fused multiplication (Dekker 1971).
/// Errors of an operation are a few times `2^-104`, relative to the result, or to the terms if these cancel.
///
/// ```
/// use lcp::refine::Extended;
/// let third = Extended::from(1.0) / Extended::from(3.0);
/// let one = third * Extended::from(3.0);
/// assert!((one - Extended::from(1.0)).rounded().abs() < 1e-31);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Extended {
    high: f64,
    low: f64,
}

impl Extended {
    /// Zero.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// The nearest `f64`.
    pub fn rounded(self) -> f64 {
        self.high
    }

    /// The digits that rounding leaves out.
    pub fn rest(self) -> f64 {
        self.low
    }

    /// The exact product, unless it underflows.
    pub fn product(a: f64, b: f64) -> Self {
        let product = a * b;
        Self { high: product, low: a.mul_add(b, -product) }
    }

    /// The magnitude.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The product with a number whose product is exact, such as a power of two.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { high: self.high * factor, low: self.low * factor }
    }

    /// `high + low` for a `high` that is not the smaller one.
    fn normal(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }

    /// The exact sum.
    fn sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let part = sum - a;
        Self { high: sum, low: (a - (sum - part)) + (b - part) }
    }
}

impl From<f64> for Extended {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl From<Extended> for f64 {
    /// The nearest `f64`.
    fn from(v: Extended) -> Self {
        v.high
    }
}

impl Add for Extended {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let carried = Self::normal(high.high, high.low + low.high);
        Self::normal(carried.high, carried.low + low.low)
    }
}

impl AddAssign for Extended {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Neg for Extended {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Extended {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Extended {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let Self { high, low } = Self::product(self.high, other.high);
        Self::normal(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Mul<f64> for Extended {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        let Self { high, low } = Self::product(self.high, factor);
        Self::normal(high, low + self.low * factor)
    }
}

impl std::ops::Div for Extended {
    type Output = Self;

    /// Three steps of long division.
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        Self::normal(first, second) + Self::from(rest.high / other.high)
    }
}

/// The same numbers with twice the digits.
pub(crate) fn extended(v: &[f64]) -> Vec<Extended> {
    v.iter().copied().map(Extended::from).collect()
}
