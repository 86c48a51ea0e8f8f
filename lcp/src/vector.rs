//! Vectors: their conversions, their sizes, and checks of data.

pub(crate) use lcp_linalg::{HALF_DIGITS, REFINEMENTS, max_abs};

use crate::Error;

/// A sum below this, relative to its terms, is a rounding error. Rounding: errors of short sums.
pub(crate) const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Residual of a solved system, and size of numbers that vanish at its solution: pivots of a singular matrix, gaps of
/// closed contacts, entries of a tableau. Rounding: some hundred eps.
pub(crate) const SMALL: f64 = 1e-13;
/// Numbers below this part of another number hardly count beside it: a coupling beside the strongest one of its row,
/// once rows and columns are equilibrated; a term beside the largest one of its row, or of the problem; the errors of a
/// proof beside the numbers that must remain positive. Chosen.
pub(crate) const WEAK: f64 = 1.0 / 1024.0;
/// A vector of a problem.
///
/// Problems take anything that converts into a vector: a `Vec`, a slice, an array, a `Col` of `faer`, and, with the
/// feature `nalgebra`, a column vector of `nalgebra` of fixed or variable size.
///
/// ```
/// use lcp::Lcp;
/// // The same problem three times
/// Lcp::new([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0])?;
/// Lcp::new([[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
/// Lcp::new([[2.0, 1.0], [1.0, 2.0]], faer::col![-5.0, -6.0])?;
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Vector(Vec<f64>);

impl Vector {
    pub(crate) fn into_entries(self) -> Vec<f64> {
        self.0
    }
}

impl From<Vec<f64>> for Vector {
    fn from(v: Vec<f64>) -> Self {
        Self(v)
    }
}

impl From<&Vec<f64>> for Vector {
    fn from(v: &Vec<f64>) -> Self {
        Self(v.clone())
    }
}

impl From<&[f64]> for Vector {
    fn from(v: &[f64]) -> Self {
        Self(v.to_vec())
    }
}

impl<const N: usize> From<[f64; N]> for Vector {
    fn from(v: [f64; N]) -> Self {
        Self(v.to_vec())
    }
}

impl<const N: usize> From<&[f64; N]> for Vector {
    fn from(v: &[f64; N]) -> Self {
        Self(v.to_vec())
    }
}

impl From<faer::Col<f64>> for Vector {
    fn from(v: faer::Col<f64>) -> Self {
        Self(v.iter().copied().collect())
    }
}

#[cfg(feature = "nalgebra")]
impl<R, S> From<nalgebra::Vector<f64, R, S>> for Vector
where
    R: nalgebra::Dim,
    S: nalgebra::RawStorage<f64, R>,
{
    fn from(v: nalgebra::Vector<f64, R, S>) -> Self {
        Self(v.iter().copied().collect())
    }
}

/// The Euclidean norm, without overflow.
pub(crate) fn norm(v: impl IntoIterator<Item = f64>) -> f64 {
    v.into_iter().fold(0.0, f64::hypot)
}

pub(crate) fn check_vector(what: &'static str, v: &[f64]) -> Result<(), Error> {
    match v.iter().position(|x| !x.is_finite()) {
        Some(row) => Err(Error::NotFinite { what, row, col: 0, value: v[row] }),
        None => Ok(()),
    }
}

/// Checks that every pair of bounds allows a number, and that finite bounds have a finite distance.
pub(crate) fn check_bounds(what: &'static str, lower: &[f64], upper: &[f64]) -> Result<(), Error> {
    let mut bounds = lower.iter().zip(upper).enumerate();
    bounds.try_for_each(|(index, (&lower, &upper))| check_interval(what, index, lower, upper))
}

/// Checks the bounds of one number.
pub(crate) fn check_interval(
    what: &'static str,
    index: usize,
    lower: f64,
    upper: f64,
) -> Result<(), Error> {
    let is_bounded = lower.is_finite() && upper.is_finite();
    let fits = lower <= upper
        && lower < f64::INFINITY
        && upper > f64::NEG_INFINITY
        && (!is_bounded || (upper - lower).is_finite());
    if fits { Ok(()) } else { Err(Error::Bounds { what, index, lower, upper }) }
}

/// The vector divided by its largest entry.
pub(crate) fn in_units_of_largest(v: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let v: Vec<f64> = v.into_iter().collect();
    let largest = max_abs(&v);
    v.into_iter().map(|v| v / largest).collect()
}

/// Checks that a value of every contact point is at least zero and finite.
pub(crate) fn check_sizes(
    name: &'static str,
    values: impl Iterator<Item = f64>,
) -> Result<(), Error> {
    check_points(name, values, "at least zero and finite", |v| v >= 0.0 && v.is_finite())
}

pub(crate) fn check_points(
    name: &'static str,
    values: impl Iterator<Item = f64>,
    range: &'static str,
    fits: impl Fn(f64) -> bool,
) -> Result<(), Error> {
    let wrong = values.enumerate().find(|(_, value)| !fits(*value));
    wrong.map_or(Ok(()), |(point, value)| Err(Error::PointValue { point, name, value, range }))
}

pub(crate) fn check_length(name: &'static str, len: usize, expected: usize) -> Result<(), Error> {
    if len == expected { Ok(()) } else { Err(Error::Length { name, len, expected }) }
}
