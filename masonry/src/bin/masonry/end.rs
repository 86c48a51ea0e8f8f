//! What every command ends with: its exit code, and what it prints.

use std::io::Write;
use std::path::{Path, PathBuf};

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

/// Refuses a file that would take the place of the scene.
pub(super) fn keep_scene(scene: &Path, file: &Path, option: &str) -> Result<(), Failure> {
    // A file that does not exist yet is no scene.
    let is_scene =
        file.canonicalize().is_ok_and(|file| scene.canonicalize().is_ok_and(|scene| scene == file));
    if is_scene {
        return Err(format!("{} is the scene: choose another {option}", file.display()).into());
    }
    Ok(())
}

/// A closed pipe is the reader's choice, not a failure of ours.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
