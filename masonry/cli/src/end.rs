//! The end of every command: its output and its exit code.

use std::io::Write;
use std::path::{Path, PathBuf};

use masonry::files::read_bounded;
use masonry::scene::Scene;
use masonry_drawing::LARGEST_FILE;

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

/// Refuses an output file that would replace the scene or its list of blocks.
pub(super) fn keep_scene(scene: &Scene, file: &Path, option: &str) -> Result<(), Failure> {
    if scene.files().any(|of_scene| is_same(of_scene, file)) {
        let file = file.display();
        return Err(format!("{file} is read for the scene: choose another {option}").into());
    }
    Ok(())
}

/// The words that mark a file as written by this program.
pub(super) const MARK: &str = "written by masonry";

/// Refuses an output file that would replace a file which this program has not written, or from which a user has
/// removed the mark since.
pub(super) fn keep_foreign(file: &Path, option: &str) -> Result<(), Failure> {
    let is_own = |bytes: Vec<u8>| {
        bytes.is_empty() || bytes.windows(MARK.len()).any(|it| it == MARK.as_bytes())
    };
    if !file.exists() || read_bounded(file, LARGEST_FILE).is_ok_and(is_own) {
        return Ok(());
    }
    let file = file.display();
    Err(format!("{file} would be overwritten, and masonry has not written it: move it away, or choose another {option}").into())
}

/// Whether two paths lead to the same existing file or directory.
pub(super) fn is_same(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// Returns a message without characters that control a terminal; paths and names in a message may contain such
/// characters.
pub(super) fn without_controls(message: &str) -> String {
    let shown = |it: char| -> String {
        if it.is_control() && it != '\n' { it.escape_default().collect() } else { it.into() }
    };
    message.chars().map(shown).collect()
}

/// Prints a text. A closed pipe does not count as an error, since the reader has closed it on purpose.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
