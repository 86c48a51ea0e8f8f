//! A [study](crate::analysis::study) as text, tables and pictures.

mod csv;
mod json;
mod summary;
mod table;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use csv::{csv, refinement_csv, springs_csv};
pub use json::json;
pub use summary::{in_short, summary};
pub use table::table;

use super::{OutputError, svg};
use crate::analysis::study::Study;
use crate::files::write_atomically;

/// Writes `study.csv`, `refinement.csv`, `springs.csv`, the pictures `accuracy.svg`, `mesh.svg`, `digits.svg` and
/// `springs.svg` as far as there is something in them, and `study.json`, which lists them all, into `dir`, which is created.
///
/// # Errors
/// [`OutputError`] for a directory that cannot be made, and for files that cannot be written.
pub fn write(study: &Study, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    fs::create_dir_all(dir)
        .map_err(|source| OutputError::Directory { path: dir.to_owned(), source })?;
    let mut files = vec![("study.csv", Ok(csv(study)))];
    files.extend(refinement_csv(study).map(|text| ("refinement.csv", Ok(text))));
    files.extend(springs_csv(study).map(|text| ("springs.csv", Ok(text))));
    let pictures = [
        ("accuracy.svg", svg::accuracy(study)),
        ("mesh.svg", svg::mesh(study)),
        ("digits.svg", svg::digits(study)),
        ("springs.svg", svg::springs(study)),
    ];
    files.extend(pictures.into_iter().filter_map(|(name, text)| Some((name, Ok(text?)))));
    let mut names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    names.push("study.json");
    files.push(("study.json", json(study, &names).map_err(io::Error::from)));
    let (mut written, mut failed) = (Vec::new(), Vec::new());
    for (name, text) in files {
        let path = dir.join(name);
        match text.and_then(|text| write_atomically(&path, text.as_bytes())) {
            Ok(()) => written.push(path),
            Err(error) => failed.push((path, error)),
        }
    }
    if failed.is_empty() { Ok(written) } else { Err(OutputError::Files { written, failed }) }
}
