//! Limit loads in the words of an engineer.

use super::{Answer, Associative, Path};

/// The sentence of the answers of both laws, or of one.
pub(super) fn of(group: &str, associative: Option<&Associative>, path: Option<&Path>) -> String {
    match (associative, path) {
        (Some(associative), None) => of_associative(group, associative),
        (None, Some(path)) => of_path(group, path),
        (Some(associative), Some(path)) => of_both(group, associative, path),
        (None, None) => String::new(),
    }
}

fn of_both(group: &str, associative: &Associative, path: &Path) -> String {
    match (associative.answer, associative.bound, path.load_factor) {
        (Answer::Fails, Some(bound), Some(stands)) if path.decided => format!(
            "\"{group}\": stands up to {stands:.4} (path), cannot stand above {bound:.4} (proved)."
        ),
        (Answer::Falls, ..) => of_associative(group, associative),
        _ => format!("{} {}", of_path(group, path), of_associative(group, associative)),
    }
}

fn of_path(group: &str, path: &Path) -> String {
    match (path.load_factor, path.falls) {
        (Some(stands), Some(falls)) if path.decided => {
            format!("\"{group}\": stands up to {stands:.4} (path), falls at {falls:.4}.")
        }
        (Some(stands), None) => {
            format!("\"{group}\": stands at every factor that was tried, up to {stands:.4} (path).")
        }
        (Some(stands), Some(_)) => format!(
            "\"{group}\": stands up to {stands:.4} (path); above, no state at rest was found, and no motion either."
        ),
        (None, _) if path.decided => {
            format!("The structure falls without \"{group}\" (path).")
        }
        (None, _) => format!("Undecided: no state at rest was found without \"{group}\" (path)."),
    }
}

fn of_associative(group: &str, found: &Associative) -> String {
    let number = |factor: Option<f64>| format!("{:.6}", factor.unwrap_or(f64::NAN));
    let (carried, bound) = (number(found.load_factor), number(found.bound));
    match found.answer {
        Answer::Fails => format!(
            "Forces within friction carry up to {carried} times \"{group}\"; the structure cannot stand above {bound} \
             (proved)."
        ),
        Answer::Unlimited => format!(
            "The structure does not fail under \"{group}\": forces within friction carry any factor of it (proved)."
        ),
        Answer::Falls => format!(
            "The structure cannot stand even without \"{group}\": no forces within friction balance the other loads (proved)."
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
