//! Rules for single values of a scene: what is missing, what is too much, and the ranges of numbers.

use super::{Fault, KeyPath, SceneErrorKind};

pub(super) type Check = Result<(), Fault>;

/// Magnitudes beyond these are no lengths, moduli or loads of anything, and would overflow.
pub(super) const MAGNITUDES: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

pub(super) enum One<A, B> {
    First(A),
    Second(B),
}

pub(super) fn exactly_one<A, B>(
    at: &KeyPath,
    first: &'static str,
    a: Option<A>,
    second: &'static str,
    b: Option<B>,
) -> Result<One<A, B>, Fault> {
    match (a, b) {
        (Some(a), None) => Ok(One::First(a)),
        (None, Some(b)) => Ok(One::Second(b)),
        (Some(_), Some(_)) => {
            Err(Fault::new(at.key(second), SceneErrorKind::Both { first, second }))
        }
        (None, None) => Err(Fault::new(at.clone(), SceneErrorKind::Neither { first, second })),
    }
}

/// Text that terminals, tables and pictures show as it is.
pub(super) fn plain(at: KeyPath, text: &str) -> Check {
    match text.chars().find(|c| c.is_control()) {
        Some(character) => Err(Fault::new(at, SceneErrorKind::Control { character })),
        None => Ok(()),
    }
}

pub(super) fn point(at: &KeyPath, coordinates: [f64; 2]) -> Check {
    coordinates.into_iter().enumerate().try_for_each(|(k, x)| finite(at.item(k), x))
}

pub(super) fn finite(at: KeyPath, number: f64) -> Check {
    let allowed = number.abs() <= *MAGNITUDES.end();
    value(at, number, allowed, "give a finite number (of magnitude at most 1e100)")
}

pub(super) fn positive(at: KeyPath, number: f64) -> Check {
    let wanted = "give a finite number greater than zero (between 1e-100 and 1e100)";
    value(at, number, MAGNITUDES.contains(&number), wanted)
}

pub(super) fn not_negative(at: KeyPath, number: f64) -> Check {
    let allowed = (0.0..=*MAGNITUDES.end()).contains(&number);
    value(at, number, allowed, "give zero or a finite positive number (at most 1e100)")
}

pub(super) fn value(at: KeyPath, value: f64, allowed: bool, wanted: &'static str) -> Check {
    if allowed { Ok(()) } else { Err(Fault::new(at, SceneErrorKind::Value { value, wanted })) }
}

pub(super) fn missing(
    at: &KeyPath,
    key: &'static str,
    because: &'static str,
    remedy: &'static str,
) -> Fault {
    Fault::new(at.clone(), SceneErrorKind::Missing { key, because, remedy })
}

pub(super) fn unwanted(
    at: &KeyPath,
    key: &'static str,
    because: &'static str,
    otherwise: &'static str,
) -> Fault {
    Fault::new(at.key(key), SceneErrorKind::Unwanted { key, because, otherwise })
}

pub(super) fn too_many(at: KeyPath, what: &'static str, count: f64, limit: u32) -> Fault {
    Fault::new(at, SceneErrorKind::TooMany { what, count, limit })
}
