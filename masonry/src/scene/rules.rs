//! Rules for single values of a scene: missing keys, unwanted keys, and the ranges of numbers.

use std::collections::BTreeMap;

use super::{Fault, KeyPath, Known, SceneErrorKind};

pub(super) type Check = Result<(), Fault>;

/// The allowed magnitudes of numbers: other values are not lengths, moduli or loads, and would overflow.
pub(super) const MAGNITUDES: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Checks every item of the list with the key `list`.
pub(super) fn each<T>(list: &str, items: &[T], check: impl Fn(&KeyPath, &T) -> Check) -> Check {
    items.iter().enumerate().try_for_each(|(k, item)| check(&KeyPath::of(list).item(k), item))
}

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

/// Checks that a text has no control characters, so that terminals, tables and pictures show it as it is.
pub(super) fn plain(at: KeyPath, text: &str) -> Check {
    match text.chars().find(|c| c.is_control()) {
        Some(character) => Err(Fault::new(at, SceneErrorKind::Control(character))),
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

/// Checks that a count is at least one.
pub(super) fn at_least_one(at: KeyPath, count: u32, wanted: &'static str) -> Check {
    value(at, f64::from(count), count > 0, wanted)
}

pub(super) fn at_most(at: KeyPath, what: &'static str, count: f64, limit: u32) -> Check {
    if count <= f64::from(limit) {
        return Ok(());
    }
    Err(Fault::new(at, SceneErrorKind::TooMany { what, count, limit }))
}

/// Returns the value of a key that other data require; fails if the key is missing.
pub(super) fn needed<T>(
    given: Option<T>,
    at: &KeyPath,
    key: &'static str,
    because: &'static str,
    remedy: &'static str,
) -> Result<T, Fault> {
    given.ok_or_else(|| Fault::new(at.clone(), SceneErrorKind::Missing { key, because, remedy }))
}

/// Refuses a key that has no meaning beside other data of the scene.
pub(super) fn unwanted(
    given: bool,
    at: &KeyPath,
    key: &'static str,
    because: &'static str,
    otherwise: &'static str,
) -> Check {
    let kind = SceneErrorKind::Unwanted { key, because, otherwise };
    if given { Err(Fault::new(at.key(key), kind)) } else { Ok(()) }
}

/// Finds the item with a name in one of the tables of the scene.
pub(super) fn named<'a, T>(
    at: KeyPath,
    name: &str,
    what: &'static str,
    table: &str,
    given: &'a BTreeMap<String, T>,
) -> Result<&'a T, Fault> {
    given.get(name).ok_or_else(|| {
        let missing = format!("[{table}.{name}]");
        unknown(at, what, name, given.keys().cloned().collect(), missing)
    })
}

/// Makes the error of a name that refers to nothing; `missing` is the table that would define it.
pub(crate) fn unknown(
    at: KeyPath,
    what: &'static str,
    name: &str,
    known: Vec<String>,
    missing: String,
) -> Fault {
    let known = Known::near(name, known);
    Fault::new(at, SceneErrorKind::Unknown { what, name: name.to_owned(), known, missing })
}
