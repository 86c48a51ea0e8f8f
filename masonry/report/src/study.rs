//! A [study](masonry::analysis::study) as text, tables and a picture.

mod figures;
mod json;
mod picture;
mod summary;
mod table;

use std::path::{Path, PathBuf};

pub use json::json;
pub use picture::{accuracy, style};
pub use summary::{in_short, summary};
pub use table::table;

use super::{OutputError, csv, write_files};
use masonry::analysis::study::Study;

/// Writes the files of a study into `dir`, which is created if it does not exist: `study.csv`, the picture
/// `accuracy.svg` if an error is known, and `study.json`, which lists all files.
///
/// # Errors
/// [`OutputError`] if the directory cannot be created, or files cannot be written.
pub fn write(study: &Study, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let mut files = vec![("study.csv", csv(study).into_bytes())];
    files.extend(accuracy(study).map(|text| ("accuracy.svg", text.into_bytes())));
    write_files(dir, files, Some("study.json"), |names| {
        json(study, &names.iter().map(String::as_str).collect::<Vec<_>>())
    })
}

/// Returns the text of `study.csv`: one row for each combination of mesh, route and tolerance.
///
/// Columns: `mesh` (factor), `route`, `tolerance`, `status` (a status, `Refused` or `Skipped`), `residual`, `time_s`,
/// `overrun` (whether the time exceeds the limit), `iterations` (pivots by `lemke`), relative errors `error_force`,
/// `error_stress`, `error_energy`, and the `reason` for which the solve was refused or skipped. Unknown values are
/// empty. Numbers read back exactly, and lines end with CR LF.
pub fn csv(study: &Study) -> String {
    csv::text(&figures::records(study, study.records.iter()).without("asked took"))
}
