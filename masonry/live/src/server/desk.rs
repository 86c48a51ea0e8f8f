//! The file of the scene: the only one that is read, and with new files beside it the only one that is written.

use std::ffi::OsStr;
use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Component, Path, PathBuf};

use masonry::files::write_atomically;
use serde::Serialize;
use thiserror::Error;

use crate::engine::LONGEST_TEXT;

/// A directory and the scene in it that is worked on, if there is one.
#[derive(Debug)]
pub struct Desk {
    directory: PathBuf,
    name: Option<String>,
}

/// The scene as its file has it.
#[derive(Debug, Serialize)]
pub(super) struct Sheet {
    name: Option<String>,
    text: Option<String>,
}

/// Why a file cannot be read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DeskError {
    /// The path has no name of a file that is text.
    #[error("{} is no name of a scene file: give one such as wall.toml", path.display())]
    NoName {
        /// The path.
        path: PathBuf,
    },
    /// The name has directories, or another ending.
    #[error("\"{name}\" is no plain name that ends in .toml: give one such as wall.toml")]
    NotPlain {
        /// The name.
        name: String,
    },
    /// The text is too long.
    #[error("{} has {bytes} bytes, and the page treats at most {LONGEST_TEXT}: solve it with `masonry solve`", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// Another program has changed the file.
    #[error("{} has changed on the disk: load it, or save under another name", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// The system refuses.
    #[error("cannot read or write {}: {source}; give another file", path.display())]
    System {
        /// The file.
        path: PathBuf,
        /// The error.
        source: io::Error,
    },
}

impl Desk {
    /// A desk with a scene file, which must exist.
    ///
    /// # Errors
    /// [`DeskError`] if it cannot be read.
    pub fn with_scene(path: &Path) -> Result<Self, DeskError> {
        let name = path.file_name().and_then(OsStr::to_str);
        let name = name.ok_or_else(|| DeskError::NoName { path: path.to_owned() })?.to_owned();
        let directory = path.parent().unwrap_or(Path::new("")).to_owned();
        let desk = Self { directory, name: Some(name) };
        desk.load()?;
        Ok(desk)
    }

    /// A desk without a scene yet, in a directory.
    pub fn empty(directory: &Path) -> Self {
        Self { directory: directory.to_owned(), name: None }
    }

    pub(super) fn load(&self) -> Result<Sheet, DeskError> {
        let Some(name) = &self.name else { return Ok(Sheet { name: None, text: None }) };
        let text = read(&self.directory.join(name))?;
        Ok(Sheet { name: Some(name.clone()), text: Some(text) })
    }

    /// Writes a text into a file of the directory: over one that has still the text that it `was`, or a new one.
    pub(super) fn save(&self, name: &str, text: &str, was: Option<&str>) -> Result<(), DeskError> {
        if self.name.as_deref() != Some(name) && !is_plain(name) {
            return Err(DeskError::NotPlain { name: name.to_owned() });
        }
        let path = self.directory.join(name);
        let system = |source| DeskError::System { path: path.clone(), source };
        match was {
            Some(was) if read(&path)? == was => {
                write_atomically(&path, text.as_bytes()).map_err(system)
            }
            Some(_) => Err(DeskError::Changed { path }),
            None => {
                let file = OpenOptions::new().write(true).create_new(true).open(&path);
                file.and_then(|mut file| file.write_all(text.as_bytes())).map_err(system)
            }
        }
    }
}

/// Whether a name is that of a scene file, without directories in the manner of any system.
fn is_plain(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None))
        && Path::new(name).extension() == Some(OsStr::new("toml"))
        && !name.contains(['/', '\\', ':'])
}

fn read(path: &Path) -> Result<String, DeskError> {
    let system = |source| DeskError::System { path: path.to_owned(), source };
    let bytes = fs::metadata(path).map_err(system)?.len();
    if bytes > LONGEST_TEXT as u64 {
        return Err(DeskError::TooLong { path: path.to_owned(), bytes });
    }
    fs::read_to_string(path).map_err(system)
}
