//! The files that the page may read and write: the scene of the command, and the new files that the page has created in
//! the same directory.

use std::ffi::OsStr;
use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use masonry::files::write_atomically;
use serde::Serialize;
use thiserror::Error;

use crate::engine::LONGEST_TEXT;

/// A directory, and the scene files in it that the page edits.
#[derive(Debug)]
pub struct Desk {
    directory: PathBuf,
    /// Names of the page's own files, the newest last. The lock also keeps a second save from starting between the
    /// comparison and the writing of a first.
    own: Mutex<Vec<String>>,
}

/// The name and the text of a scene file.
#[derive(Debug, Serialize)]
pub(super) struct Sheet {
    name: Option<String>,
    text: Option<String>,
}

/// The reason for which a file cannot be read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DeskError {
    /// The last part of the path is not a file name in UTF-8.
    #[error("{} is not a name of a scene file: give one such as wall.toml", path.display())]
    NoName {
        /// The path without a usable file name.
        path: PathBuf,
    },
    /// The name contains directories, or does not have the ending of a scene file.
    #[error("\"{name}\" is not a plain name that ends in .toml: give one such as wall.toml")]
    NotPlain {
        /// The name that was refused.
        name: String,
    },
    /// The file exists, but is not one of the page's own files.
    #[error("{} is not a file of this page: save under the name of a new file", path.display())]
    Foreign {
        /// The path of the existing file.
        path: PathBuf,
    },
    /// The text of the file is too long.
    #[error("{} has {bytes} bytes, and the page treats at most {LONGEST_TEXT}: solve it with `masonry solve`", path.display())]
    TooLong {
        /// The path of the file with the long text.
        path: PathBuf,
        /// The size of the text \[bytes\].
        bytes: u64,
    },
    /// Another program has changed the file since the page read it.
    #[error("{} has changed on the disk: load it, or keep the text of the page and save again", path.display())]
    Changed {
        /// The path of the changed file.
        path: PathBuf,
    },
    /// The operating system refuses to read or write the file.
    #[error("cannot read or write {}: {source}; give another file", path.display())]
    System {
        /// The path of the file that cannot be read or written.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
}

impl Desk {
    /// Creates a desk with one scene file, which must exist.
    ///
    /// # Errors
    /// [`DeskError`] if the file cannot be read.
    pub fn with_scene(path: &Path) -> Result<Self, DeskError> {
        let name = path.file_name().and_then(OsStr::to_str);
        let name = name.ok_or_else(|| DeskError::NoName { path: path.to_owned() })?.to_owned();
        let directory = path.parent().unwrap_or(Path::new("")).to_owned();
        let desk = Self { directory, own: Mutex::new(vec![name]) };
        desk.load(None)?;
        Ok(desk)
    }

    /// Creates a desk for a directory, without a scene file yet.
    pub fn empty(directory: &Path) -> Self {
        Self { directory: directory.to_owned(), own: Mutex::default() }
    }

    pub(super) fn directory(&self) -> &Path {
        &self.directory
    }

    /// Reads one of the page's own files; the newest if `name` is `None`. Line ends are converted to those of a text
    /// area.
    pub(super) fn load(&self, name: Option<&str>) -> Result<Sheet, DeskError> {
        let own = self.own();
        let Some(name) = name.or(own.last().map(String::as_str)) else {
            return Ok(Sheet { name: None, text: None });
        };
        let path = self.directory.join(name);
        if !own.iter().any(|it| it == name) {
            return Err(DeskError::Foreign { path });
        }
        let text = read(&path)?.replace("\r\n", "\n");
        Ok(Sheet { name: Some(name.to_owned()), text: Some(text) })
    }

    /// Writes a text into a new file, or over one of the page's own files if that file still has the text `was`.
    pub(super) fn save(&self, name: &str, text: &str, was: Option<&str>) -> Result<(), DeskError> {
        let mut own = self.own();
        let is_own = own.iter().any(|it| it == name);
        if !is_own && !is_plain(name) {
            return Err(DeskError::NotPlain { name: name.to_owned() });
        }
        let path = self.directory.join(name);
        let system = |source| DeskError::System { path: path.clone(), source };
        match was {
            Some(_) if !is_own => Err(DeskError::Foreign { path }),
            Some(was) => {
                let old = read(&path)?;
                if old.replace("\r\n", "\n") != was {
                    return Err(DeskError::Changed { path });
                }
                let text =
                    if old.contains("\r\n") { text.replace('\n', "\r\n") } else { text.to_owned() };
                // If the path is a link, the target of the link is written, so that the link stays.
                let target = fs::canonicalize(&path).map_err(system)?;
                write_atomically(&target, text.as_bytes()).map_err(system)
            }
            None => {
                let file = OpenOptions::new().write(true).create_new(true).open(&path);
                file.and_then(|mut file| file.write_all(text.as_bytes())).map_err(system)?;
                own.push(name.to_owned());
                Ok(())
            }
        }
    }

    /// Locks the list of the names of the page's own files. The list is always consistent, so a lock that a panic has
    /// poisoned is used all the same.
    fn own(&self) -> MutexGuard<'_, Vec<String>> {
        self.own.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether a name is that of a scene file, without directories in the notation of any operating system.
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
