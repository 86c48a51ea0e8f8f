//! Reports of a scene that was solved, or could not be solved: text, pictures, tables and meshes.
//!
//! Every result is in the units of the scene, which titles, columns and legends name. The functions of the modules
//! return the contents of files; [`write_all`] writes the files.

pub mod cases;
pub mod csv;
pub mod dxf;
mod figures;
mod format;
pub mod hinges;
pub mod joints;
pub mod json;
pub mod limit;
mod moving;
pub mod page;
#[cfg(feature = "study")]
pub mod study;
pub mod summary;
pub mod svg;
pub mod table;
mod text;
pub mod vtu;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use masonry::analysis::outcome::Outcome;
use masonry::files::write_atomically;
use svg::ReferenceLines;
use svg::pictures::{Pictures, Shown, of_outcome};

/// A kind of output file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum OutputFormat {
    /// Pictures: `scene.svg` always; `principal_stresses.svg` if stresses were recovered; `deformed.svg` and
    /// `forces.svg` if solved, with `cracks.svg` if joints have opened or slid; `mechanism.svg` if a mechanism is
    /// known; `history.svg` if there is a load history.
    Svg,
    /// The mesh `panel.vtu`.
    Vtu,
    /// Tables: `contacts.csv`, if solved; `history.csv`, if there is a load history.
    Csv,
    /// The report `report.txt`.
    Text,
    /// The JSON object `result.json`.
    Json,
}

impl OutputFormat {
    /// All formats of files.
    pub const ALL: [Self; 5] = [Self::Svg, Self::Vtu, Self::Csv, Self::Text, Self::Json];
}

/// The choice of files that [`write_all`] writes; all by default.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportOptions {
    /// The formats of the files.
    pub formats: Vec<OutputFormat>,
    /// Lines with which the picture of principal stresses is compared; `None` draws no lines.
    pub reference: Option<ReferenceLines>,
}

impl Default for ReportOptions {
    fn default() -> Self {
        Self { formats: OutputFormat::ALL.to_vec(), reference: None }
    }
}

/// Names of all files that reports and runs write into a directory.
pub const FILES: [&str; 21] = [
    "accuracy.svg",
    "checkpoint.json",
    "contacts.csv",
    "cracks.svg",
    "deformed.svg",
    "forces.svg",
    "history.csv",
    "history.svg",
    "limit.json",
    "mechanism.svg",
    "panel.vtu",
    "path.svg",
    "path_forces.svg",
    "path_mechanism.svg",
    "principal_stresses.svg",
    "report.txt",
    "result.json",
    "scene.svg",
    "study.csv",
    "study.json",
    "train.svg",
];

/// The reason for which files could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The directory could not be created.
    #[error("cannot create the directory {}: {source}; choose another one", path.display())]
    Directory {
        /// The directory that could not be created.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// Some files could not be written; all other files were written.
    #[error("cannot write {}; the other {} files were written", listed(failed), written.len())]
    Files {
        /// The files that were written.
        written: Vec<PathBuf>,
        /// The files that were not written, with the errors of the operating system.
        failed: Vec<(PathBuf, io::Error)>,
    },
}

/// Writes the files of `options` into `dir`, and returns their paths. The directory is created if it does not exist.
///
/// Each file appears whole or not at all: it is written under a temporary name and renamed. A file that fails does not
/// keep the others from being written. `result.json` comes last and lists the files of this call; files of earlier
/// calls stay.
///
/// # Errors
/// [`OutputError::Directory`] if the directory cannot be created, [`OutputError::Files`] if at least one file could not
/// be written.
pub fn write_all(
    outcome: &Outcome,
    dir: &Path,
    options: &ReportOptions,
) -> Result<Vec<PathBuf>, OutputError> {
    let listing = options.formats.contains(&OutputFormat::Json).then_some("result.json");
    write_files(dir, contents(outcome, options), listing, |names| json::result(outcome, names))
}

/// Returns names and contents of all files except `result.json`.
fn contents(outcome: &Outcome, options: &ReportOptions) -> Vec<(&'static str, Vec<u8>)> {
    let (model, state) = (&outcome.model, outcome.state.as_ref());
    let title = &titled(outcome);
    let mut files = Vec::new();
    if options.formats.contains(&OutputFormat::Svg) {
        let shown: Vec<Shown<'_>> =
            state.into_iter().map(|state| Shown { title, model, state }).collect();
        let reference = options.reference.as_ref();
        files.extend(self::files(of_outcome(outcome, title, &shown, reference, false)));
    }
    if options.formats.contains(&OutputFormat::Vtu) {
        files.push(("panel.vtu", vtu::vtu(model, state)));
    }
    if let (true, Some(state)) = (options.formats.contains(&OutputFormat::Csv), state) {
        files.push(("contacts.csv", csv::contacts(model, state).into_bytes()));
    }
    if let (true, Some(history)) = (options.formats.contains(&OutputFormat::Csv), &outcome.history)
    {
        files.push(("history.csv", csv::history(model, history).into_bytes()));
    }
    if options.formats.contains(&OutputFormat::Text) {
        files.push(("report.txt", table::report(outcome).into_bytes()));
    }
    files
}

/// Returns each picture with the name of its file.
fn files(pictures: Vec<Pictures>) -> impl Iterator<Item = (&'static str, Vec<u8>)> {
    let of_kind = |Pictures { file, pictures }| {
        pictures.into_iter().map(move |text: String| (file, text.into_bytes()))
    };
    pictures.into_iter().flat_map(of_kind)
}

/// Returns the title of the pictures: the verdict, and the title of the scene.
fn titled(outcome: &Outcome) -> String {
    let verdict = outcome.judgement.verdict;
    if outcome.title.is_empty() {
        verdict.to_string()
    } else {
        format!("{verdict}: {}", outcome.title)
    }
}

/// Writes files into a directory, which is created if it does not exist. Each file is written whole or not at all, even
/// if other files fail. The last file lists all written files, including itself.
fn write_files(
    dir: &Path,
    files: Vec<(&str, Vec<u8>)>,
    listing: Option<&str>,
    list: impl FnOnce(&[String]) -> Result<String, serde_json::Error>,
) -> Result<Vec<PathBuf>, OutputError> {
    fs::create_dir_all(dir)
        .map_err(|source| OutputError::Directory { path: dir.to_owned(), source })?;
    let (mut names, mut written, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    let mut write = |name: &str, bytes: io::Result<Vec<u8>>| {
        let path = dir.join(name);
        let end = bytes.and_then(|bytes| write_atomically(&path, &bytes));
        let is_written = end.is_ok();
        match end {
            Ok(()) => written.push(path),
            Err(error) => failed.push((path, error)),
        }
        is_written
    };
    for (name, bytes) in files {
        if write(name, Ok(bytes)) {
            names.push(name.to_owned());
        }
    }
    if let Some(name) = listing {
        names.push(name.to_owned());
        write(name, list(&names).map(String::into_bytes).map_err(io::Error::from));
    }
    if failed.is_empty() { Ok(written) } else { Err(OutputError::Files { written, failed }) }
}

fn listed(failed: &[(PathBuf, io::Error)]) -> String {
    let texts: Vec<String> =
        failed.iter().map(|(path, error)| format!("{} ({error})", path.display())).collect();
    texts.join(", ")
}
