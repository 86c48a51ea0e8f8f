//! Problems: the general (horizontal) form, and the forms that convert into it.

mod bound;
mod boxed;
mod contact;
mod disguised;
mod friction;
mod horizontal;
mod mixed;
mod standard;

pub use bound::{ErrorBound, Monotonicity};
pub use boxed::BoxedLcp;
pub use contact::{
    Bedding, Contact2d, Contact2dBuilder, ContactPoint, ContactState, ContactStatus,
};
pub(crate) use contact::{
    check_epsilon, column_factors, column_of, diagonal, median, power_of_two,
};
pub use disguised::StandardForm;
pub use friction::{ContactForces, Friction2d};
pub use horizontal::HorizontalLcp;
pub use mixed::MixedLcp;
pub use standard::Lcp;

use crate::Error;

pub(crate) fn max_abs(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, x| max.max(x.abs()))
}

pub(crate) fn check_vector(what: &'static str, v: &[f64]) -> Result<(), Error> {
    match v.iter().position(|x| !x.is_finite()) {
        Some(row) => Err(Error::NotFinite { what, row, col: 0, value: v[row] }),
        None => Ok(()),
    }
}

pub(crate) fn check_length(name: &'static str, len: usize, expected: usize) -> Result<(), Error> {
    if len == expected { Ok(()) } else { Err(Error::Length { name, len, expected }) }
}
