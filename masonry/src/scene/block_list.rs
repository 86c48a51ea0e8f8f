//! A JSON file with single blocks, such as other programs write: their corners and material.

use serde::Deserialize;

use super::source::{List, Place};
use super::strict;

/// A block as the list has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Listed {
    #[serde(default)]
    name: Option<String>,
    pub(super) material: String,
    #[serde(deserialize_with = "strict::corners")]
    pub(super) corners: Vec<[f64; 2]>,
    #[serde(default, deserialize_with = "strict::some_pair")]
    pub(super) mesh: Option<[u32; 2]>,
}

/// The blocks of a list with their names. Those without one are called by the name of the file and their number in the list.
///
/// # Errors
/// What does not fit the format, and where.
pub(super) fn blocks(list: &List) -> Result<Vec<(String, Listed)>, (String, Option<Place>)> {
    let listed: Vec<Listed> = serde_json::from_str(&list.text).map_err(|error| {
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(&*message, |(what, _)| what);
        (message.to_owned(), Place::at(&list.text, error.line(), error.column()))
    })?;
    let stem = list.path.file_stem().map_or("blocks".into(), |stem| stem.to_string_lossy());
    let named = |(number, listed): (usize, Listed)| {
        (listed.name.clone().unwrap_or_else(|| format!("{stem}/{number}")), listed)
    };
    Ok((1..).zip(listed).map(named).collect())
}
