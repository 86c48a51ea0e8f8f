//! A [limit load](crate::analysis::limit) as text, JSON and pictures, and the ranges of reactions.

mod json;
mod table;

use std::path::{Path, PathBuf};

pub use json::{json, json_both, range_json, thickness_json};
pub use table::{range_table, table, table_both, thickness_table};

use super::{OutputError, svg, write_files};
use crate::analysis::limit::{Limit, Thickness};

/// Writes `forces.svg` and `mechanism.svg`, where there are forces and a mechanism, the same of the path with its curve, and
/// `limit.json`, which lists them, into `dir`, which is created.
///
/// # Errors
/// [`OutputError`] for a directory that cannot be made, and for files that cannot be written.
pub fn write(limit: &Limit, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let mut list = Pictures::new();
    let title = &limit.title;
    if let Some(found) = &limit.associative {
        let (forces, rates) = (found.forces.as_ref(), found.mechanism.as_ref());
        list.push(("forces.svg", forces.map(|it| svg::forces(title, &limit.model, it))));
        list.push(("mechanism.svg", rates.map(|it| svg::mechanism(title, &limit.model, it))));
    }
    if let Some(path) = &limit.path {
        let (forces, rates) = (path.contacts.as_ref(), path.mechanism.as_ref());
        let of_path = format!("{title}, path");
        let forces = forces.map(|it| svg::forces(&of_path, &path.model, it));
        let rates = rates.map(|it| svg::mechanism(&of_path, &path.model, it));
        let curve = svg::path(title, &limit.group, path);
        list.extend([
            ("path_forces.svg", forces),
            ("path_mechanism.svg", rates),
            ("path.svg", curve),
        ]);
    }
    write_files(dir, bytes(list), Some("limit.json"), |names| json(limit, names))
}

/// The same of the least thickness of an arch: the forces at the thickness that stands, and the mechanism of the one that
/// falls.
///
/// # Errors
/// As [`write()`].
pub fn write_thickness(thickness: &Thickness, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let Thickness { title, model, forces, mechanism, .. } = thickness;
    let forces = forces.as_ref().map(|it| svg::forces(title, model, it));
    let rates = mechanism.as_ref().map(|it| svg::mechanism(title, model, it));
    let list = bytes(vec![("forces.svg", forces), ("mechanism.svg", rates)]);
    write_files(dir, list, Some("limit.json"), |names| thickness_json(thickness, names))
}

/// Pictures by name, if they exist.
type Pictures = Vec<(&'static str, Option<String>)>;

fn bytes(list: Pictures) -> Vec<(&'static str, Vec<u8>)> {
    list.into_iter().filter_map(|(name, text)| Some((name, text?.into_bytes()))).collect()
}
