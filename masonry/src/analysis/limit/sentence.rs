//! Limit loads in sentences for engineers.

use super::{Answer, Associative, Path};
use crate::rounding::{BoundSide, outwards};

/// Writes the sentence with the limit load by both laws of friction, or by one.
pub(super) fn of(group: &str, associative: Option<&Associative>, path: Option<&Path>) -> String {
    match (associative, path) {
        (Some(associative), None) => of_associative(group, associative),
        (None, Some(path)) => of_path(group, path),
        (Some(associative), Some(path)) => of_both(group, associative, path),
        (None, None) => String::new(),
    }
}

/// Writes the sentence with the bounds of the limit load if the search was interrupted.
pub(super) fn of_interrupted(
    group: &str,
    associative: Option<&Associative>,
    path: Option<&Path>,
) -> String {
    let carried = associative.and_then(|it| it.load_factor);
    let bound = associative.and_then(|it| it.bound);
    let stands = match (path.and_then(|it| it.load_factor), carried) {
        (Some(stands), _) => Some(format!("stands up to {} (path)", at_least(stands))),
        (None, Some(carried)) => {
            Some(format!("forces within friction carry {} times it", at_least(carried)))
        }
        (None, None) => None,
    };
    let flows = path.and_then(|it| it.falls).filter(|falls| Some(*falls) != bound);
    let falls = match (flows, bound) {
        (Some(flows), _) => Some(format!("falls at {}", at_most(flows))),
        (None, Some(bound)) => Some(format!("cannot stand above {} (proved)", at_most(bound))),
        (None, None) => None,
    };
    let known: Vec<String> = stands.into_iter().chain(falls).collect();
    if known.is_empty() {
        return format!("Interrupted before anything was known of \"{group}\".");
    }
    format!("Interrupted. Known so far of \"{group}\": {}.", known.join(", "))
}

fn of_both(group: &str, associative: &Associative, path: &Path) -> String {
    match (associative.answer, associative.bound, path.load_factor) {
        _ if associative.carries_nothing() => of_associative(group, associative),
        (Answer::Fails, Some(bound), Some(stands)) if path.decided => {
            let falls = path.falls.filter(|falls| *falls < bound);
            let falls = falls.map_or_else(String::new, |it| format!(", falls at {}", at_most(it)));
            format!(
                "\"{group}\": stands up to {}{falls} (path), cannot stand above {} (proved).",
                at_least(stands),
                at_most(bound)
            )
        }
        (Answer::Unlimited, _, Some(stands)) if path.falls.is_none() => format!(
            "\"{group}\": stands at every factor that was tried, up to {} (path); forces within friction carry any \
             factor (proved).",
            at_least(stands)
        ),
        (Answer::Falls, ..) => of_associative(group, associative),
        _ => format!("{} {}", of_path(group, path), of_associative(group, associative)),
    }
}

fn of_path(group: &str, path: &Path) -> String {
    match (path.load_factor, path.falls) {
        (Some(stands), Some(falls)) if path.decided => format!(
            "\"{group}\": stands up to {} (path), falls at {}.",
            at_least(stands),
            at_most(falls)
        ),
        (Some(stands), None) => format!(
            "\"{group}\": stands at every factor that was tried, up to {} (path).",
            at_least(stands)
        ),
        (Some(stands), Some(_)) => format!(
            "\"{group}\": stands up to {} (path); above, no state at rest was found, and no motion either.",
            at_least(stands)
        ),
        (None, _) if path.decided => {
            format!("The structure falls without \"{group}\" (path).")
        }
        (None, _) => format!("Undecided: no state at rest was found without \"{group}\" (path)."),
    }
}

fn of_associative(group: &str, found: &Associative) -> String {
    let carried = found.load_factor.map_or_else(String::new, at_least);
    let bound = found.bound.map_or_else(String::new, at_most);
    match found.answer {
        _ if found.carries_nothing() => {
            format!("Forces within friction carry no part of \"{group}\" (proved).")
        }
        Answer::Fails => format!(
            "Forces within friction carry up to {carried} times \"{group}\"; the structure cannot stand above {bound} \
             (proved)."
        ),
        Answer::Unlimited => {
            format!("Forces within friction carry any factor of \"{group}\" (proved).")
        }
        Answer::Falls => format!(
            "The structure cannot stand without \"{group}\": no forces within friction balance the other loads (proved)."
        ),
        Answer::Undecided => match (found.load_factor, found.bound) {
            (Some(_), Some(_)) => format!(
                "Undecided: forces within friction carry {carried} times \"{group}\", and it is proved only that the \
                 structure cannot stand above {bound}."
            ),
            (Some(_), None) => format!(
                "Undecided: forces within friction carry {carried} times \"{group}\", and no proof was found that they \
                 do not carry more."
            ),
            _ => format!("Undecided: no largest factor of \"{group}\" was found."),
        },
    }
}

/// Writes a load factor that is carried, rounded down.
fn at_least(it: f64) -> String {
    outwards(it, BoundSide::Below, factor)
}

/// Writes a load factor that is not carried, rounded up.
fn at_most(it: f64) -> String {
    outwards(it, BoundSide::Above, factor)
}

/// Writes a load factor with four decimals, if four are enough.
fn factor(it: f64) -> String {
    match it.abs() {
        0.0 => "0".to_owned(),
        0.01..1000.0 => format!("{it:.4}"),
        1000.0..1e6 => format!("{it:.1}"),
        _ => format!("{it:.4e}"),
    }
}
