//! Vectors: how large they are, and whether they can be taken as data.

use crate::Error;

/// A sum below this, relative to its terms, is a rounding error. Rounding: errors of short sums.
pub(crate) const ROUNDING: f64 = 64.0 * f64::EPSILON;

pub(crate) fn max_abs(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, x| max.max(x.abs()))
}

pub(crate) fn check_vector(what: &'static str, v: &[f64]) -> Result<(), Error> {
    match v.iter().position(|x| !x.is_finite()) {
        Some(row) => Err(Error::NotFinite { what, row, col: 0, value: v[row] }),
        None => Ok(()),
    }
}

/// That a value of every contact point is at least zero and finite.
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
