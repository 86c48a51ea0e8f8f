//! A [study](crate::analysis::study) as text, tables and a picture.

mod csv;
mod json;
mod picture;
mod summary;
mod table;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use csv::csv;
pub use json::json;
pub use picture::{accuracy, style};
pub use summary::{in_short, summary};
pub use table::table;

use super::OutputError;
use crate::analysis::study::Study;
use crate::files::write_atomically;

/// Writes `study.csv`, the picture `accuracy.svg` where there is something in it, and `study.json`, which lists them
/// all, into `dir`, which is created.
///
/// # Errors
/// [`OutputError`] for a directory that cannot be made, and for files that cannot be written.
pub fn write(study: &Study, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    fs::create_dir_all(dir)
        .map_err(|source| OutputError::Directory { path: dir.to_owned(), source })?;
    let mut files = vec![("study.csv", Ok(csv(study)))];
    files.extend(accuracy(study).map(|text| ("accuracy.svg", Ok(text))));
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
