//! Limit loads in the words of an engineer.

use super::{Answer, Associative};

/// The sentence of an answer.
pub(super) fn of(group: &str, found: &Associative) -> String {
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
