//! `--report`: the page of HTML.

use std::path::{Path, PathBuf};

use super::end::Failure;
use crate::files::write_atomically;

/// Writes the page, if one is asked for, and adds it to the files that were written.
pub(super) fn write(
    path: Option<&Path>,
    page: impl FnOnce() -> String,
    files: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    write_atomically(path, page().as_bytes()).map_err(|error| {
        format!("cannot write the page {}: {error}; choose another file", path.display())
    })?;
    files.push(path.to_owned());
    Ok(())
}
