//! What every command ends with: its exit code, and what it prints.

use std::io::Write;
use std::path::PathBuf;

pub(super) type Failure = Box<dyn std::error::Error>;

pub(super) const SOLVED: u8 = 0;
pub(super) const NOT_SOLVED: u8 = 1;
pub(super) const BAD_INPUT: u8 = 2;

pub(super) fn names(files: &[PathBuf]) -> Vec<String> {
    let name = |path: &PathBuf| path.file_name().map(|name| name.to_string_lossy().into_owned());
    files.iter().filter_map(name).collect()
}

pub(super) fn listing(files: &[PathBuf]) -> String {
    let lines: Vec<String> = files.iter().map(|path| format!("wrote {}", path.display())).collect();
    lines.join("\n") + "\n"
}

/// A closed pipe is the reader's choice, not a failure of ours.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
