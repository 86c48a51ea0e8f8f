//! The existing names that a message lists if a name does not exist, and the name that was probably meant.

use std::fmt;

/// The names of one kind in a scene, and the name that was probably meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Known {
    /// All names of this kind.
    pub names: Vec<String>,
    /// The name that was probably meant; `None` if no name is similar enough.
    pub nearest: Option<String>,
}

impl Known {
    /// Makes the list of known names, and finds the one nearest to `given`.
    pub(crate) fn near(given: &str, names: Vec<String>) -> Self {
        let nearest = nearest(given, names.iter().map(String::as_str)).map(str::to_owned);
        Self { names, nearest }
    }
}

impl fmt::Display for Known {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.names.is_empty() {
            return f.write_str("none is given");
        }
        if let Some(nearest) = &self.nearest {
            write!(f, "did you mean \"{nearest}\"? ")?;
        }
        let (first, more) = self.names.split_at(self.names.len().min(MOST_NAMES));
        let names: Vec<String> = first.iter().map(|name| format!("\"{name}\"")).collect();
        write!(f, "there is {}", names.join(", "))?;
        if more.is_empty() { Ok(()) } else { write!(f, " and {} more", more.len()) }
    }
}

/// The largest number of names that a message lists.
const MOST_NAMES: usize = 12;
/// The least similarity \[-\] at which a given name may stand for an existing one.
const SIMILAR: f64 = 0.7;

/// Returns the known name most similar to the given one; `None` if no name is similar enough.
fn nearest<'a>(given: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = |name: &str| strsim::normalized_damerau_levenshtein(given, name);
    let like =
        names.map(|name| (likeness(name), name)).filter(|(likeness, _)| *likeness >= SIMILAR);
    like.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}

/// Adds the key that was probably meant to the message of the TOML reader.
pub(super) fn with_nearest(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let hint = message.starts_with("unknown ").then_some(&quoted[..]);
    match hint.and_then(<[&str]>::split_first) {
        Some((given, known)) => match nearest(given, known.iter().copied()) {
            // The suggestion comes before the list of all keys, since the list may be long.
            Some(name) => message.replacen(", ", &format!("; did you mean `{name}`? "), 1),
            None => message.to_owned(),
        },
        None => message.to_owned(),
    }
}
