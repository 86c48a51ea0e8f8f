//! A [limit load](crate::analysis::limit) as text, JSON and pictures, and the ranges of reactions.

mod json;
mod table;

use std::io;
use std::path::{Path, PathBuf};

use nalgebra::Vector2;

pub use json::{json, json_both, range_json, thickness_json};
pub use table::{range_table, table, table_both, thickness_table};

use super::{OutputError, svg, write_files};
use crate::analysis::limit::{Limit, Thickness};
use crate::model::Model;
use crate::state::ContactState;

/// Writes `forces.svg` and `mechanism.svg`, where there are forces and a mechanism, the same of the path with its curve, and
/// `limit.json`, which lists them, into `dir`, which is created.
///
/// # Errors
/// [`OutputError`] for a directory that cannot be made, and for files that cannot be written.
pub fn write(limit: &Limit, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let mut list = Pictures::new();
    if let Some(found) = &limit.associative {
        let both = (found.forces.as_deref(), found.mechanism.as_deref());
        list = pictures(&limit.title, &limit.model, both);
    }
    if let Some(path) = &limit.path {
        let title = format!("{}, path", limit.title);
        let forces = path.contacts.as_deref().map(|it| svg::forces(&title, &path.model, it));
        let rates = path.mechanism.as_deref().map(|it| svg::mechanism(&title, &path.model, it));
        list.extend(forces.map(|picture| ("path_forces.svg", picture)));
        list.extend(rates.map(|picture| ("path_mechanism.svg", picture)));
        let curve = svg::path(&limit.title, &limit.group, path);
        list.extend(curve.map(|picture| ("path.svg", picture)));
    }
    write_with(dir, list, |names| json(limit, names))
}

/// The same of the least thickness of an arch: the forces at the thickness that stands, and the mechanism of the one that
/// falls.
///
/// # Errors
/// As [`write()`].
pub fn write_thickness(thickness: &Thickness, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let both = (thickness.forces.as_deref(), thickness.mechanism.as_deref());
    let pictures = pictures(&thickness.title, &thickness.model, both);
    write_with(dir, pictures, |names| thickness_json(thickness, names))
}

/// Rates of the corners of one block.
type Rates = Vec<Vector2<f64>>;
/// Pictures by name.
type Pictures = Vec<(&'static str, String)>;

fn pictures(
    title: &str,
    model: &Model,
    (forces, rates): (Option<&[ContactState]>, Option<&[Rates]>),
) -> Pictures {
    let forces = forces.map(|forces| ("forces.svg", svg::forces(title, model, forces)));
    let mechanism = rates.map(|rates| ("mechanism.svg", svg::mechanism(title, model, rates)));
    forces.into_iter().chain(mechanism).collect()
}

fn write_with(
    dir: &Path,
    pictures: Pictures,
    json: impl FnOnce(&[String]) -> Result<String, serde_json::Error>,
) -> Result<Vec<PathBuf>, OutputError> {
    let names = pictures.iter().map(|(name, _)| *name).chain(["limit.json"]);
    let names: Vec<String> = names.map(str::to_owned).collect();
    let mut files: Vec<_> = pictures.into_iter().map(|(name, text)| (name, Ok(text))).collect();
    files.push(("limit.json", json(&names).map_err(io::Error::from)));
    write_files(dir, files)
}
