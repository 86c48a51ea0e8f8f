//! `--report`: the report as a page of HTML.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::end::{Failure, is_same, keep_scene};
use crate::out_dir::RECORD;
use masonry::files::write_atomically;
use masonry::scene::Scene;
use masonry_report as report;

/// Checks before the work whether the page of a scene can be written to `path`, and does not replace a file that the
/// run writes into `out`.
pub(super) fn check(path: Option<&Path>, scene: &Scene, out: Option<&Path>) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    keep_scene(scene, path, "--report")?;
    let directory = match path.parent() {
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
        None => path,
    };
    let of_run = |name: &OsStr| name == RECORD || report::FILES.iter().any(|file| name == *file);
    let is_in_out = out.is_some_and(|out| is_same(out, directory));
    let why = if is_in_out && path.file_name().is_some_and(of_run) {
        "the run writes a file of this name into --out"
    } else if path.is_dir() {
        "it is a directory"
    } else if !directory.is_dir() {
        "its directory does not exist"
    } else {
        return Ok(());
    };
    Err(format!("cannot write the page {}: {why}; choose another --report", path.display()).into())
}

/// Writes the page if `--report` is given, and adds its path to the written files.
pub(super) fn write(
    path: Option<&Path>,
    page: impl FnOnce() -> String,
    files: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    write_atomically(path, page().as_bytes()).map_err(|error| {
        format!("cannot write the page {}: {error}; choose another --report", path.display())
    })?;
    files.push(path.to_owned());
    Ok(())
}
