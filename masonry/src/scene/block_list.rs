//! Lists of single blocks with their corners and material, in JSON files that other programs write.

use serde::Deserialize;

use super::source::{Excerpt, List};
use super::{Block, SceneError, strict};

/// One item of the list: the data of a block.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Listed {
    #[serde(default)]
    name: Option<String>,
    material: String,
    #[serde(deserialize_with = "strict::read")]
    corners: Vec<[f64; 2]>,
    #[serde(default, deserialize_with = "strict::mesh")]
    mesh: Option<[u32; 2]>,
}

/// Returns the blocks of a list. Blocks without a name are named after the file and their number in the list.
///
/// # Errors
/// The first part of the file that does not fit the format, with its place.
pub(super) fn blocks(list: &List) -> Result<Vec<Block>, SceneError> {
    let listed: Vec<Listed> = serde_json::from_str(&list.text).map_err(|error| {
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(&*message, |(what, _)| what);
        let place = Excerpt::at(&list.text, error.line(), error.column());
        SceneError::syntax(message, place, Some(&list.path))
    })?;
    let stem = list.path.file_stem().map_or("blocks".into(), |stem| stem.to_string_lossy());
    let block = |(number, Listed { name, material, corners, mesh }): (usize, Listed)| {
        let name = name.unwrap_or_else(|| format!("{stem}/{number}"));
        Block { name, material, corners, mesh }
    };
    Ok((1..).zip(listed).map(block).collect())
}
