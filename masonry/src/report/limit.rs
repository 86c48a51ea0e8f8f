//! A [limit load](crate::analysis::limit) as text, JSON and pictures, and the ranges of reactions.

mod json;
mod table;

use std::io;
use std::path::{Path, PathBuf};

pub use json::{json, range_json};
pub use table::{range_table, table};

use super::{OutputError, svg, write_files};
use crate::analysis::limit::Limit;

/// Writes `forces.svg` and `mechanism.svg`, where there are forces and a mechanism, and `limit.json`, which lists them, into
/// `dir`, which is created.
///
/// # Errors
/// [`OutputError`] for a directory that cannot be made, and for files that cannot be written.
pub fn write(limit: &Limit, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let (title, model, found) = (&limit.title, &limit.model, &limit.associative);
    let forces = found.forces.as_ref().map(|forces| svg::forces(title, model, forces));
    let rates = found.mechanism.as_ref();
    let mechanism = rates.map(|rates| svg::mechanism(title, model, rates));
    let mut files = Vec::new();
    files.extend(forces.map(|text| ("forces.svg", Ok(text))));
    files.extend(mechanism.map(|text| ("mechanism.svg", Ok(text))));
    let names = files.iter().map(|(name, _)| *name).chain(["limit.json"]);
    let names: Vec<String> = names.map(str::to_owned).collect();
    files.push(("limit.json", json(limit, &names).map_err(io::Error::from)));
    write_files(dir, files)
}
