//! What can be wrong with a scene, and where.

mod contact;
mod kind;
mod known;

use std::fmt;
use std::path::{Path, PathBuf};

pub use contact::ContactError;
pub use kind::SceneErrorKind;
pub use known::Known;
use known::with_nearest;

use super::source::{Excerpt, Source};
use super::{KeyPath, Scene};

/// Something is wrong with a scene: what, where, and how to mend it.
///
/// The message of a scene that was read from text shows the line with carets below the mistake.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError(Box<Details>);

#[derive(Debug, Clone, PartialEq)]
struct Details {
    kind: SceneErrorKind,
    key: KeyPath,
    place: Option<Excerpt>,
    file: Option<PathBuf>,
}

impl SceneError {
    /// What is wrong.
    pub fn kind(&self) -> &SceneErrorKind {
        &self.0.kind
    }

    /// The key of the value that is wrong, such as `walls[0].brick.length`; empty when the text is
    /// no TOML or does not fit the format.
    pub fn key(&self) -> String {
        self.0.key.to_string()
    }

    /// The line of the mistake, from 1; `None` when the scene was built or changed in Rust.
    pub fn line(&self) -> Option<usize> {
        self.0.place.as_ref().map(|place| place.line)
    }

    /// The column of the mistake in characters, from 1; `None` as [`SceneError::line`].
    pub fn column(&self) -> Option<usize> {
        self.0.place.as_ref().map(|place| place.column)
    }

    /// The file that the scene was read from.
    pub fn file(&self) -> Option<&Path> {
        self.0.file.as_deref()
    }

    pub(super) fn syntax(source: &Source, error: &toml::de::Error) -> Self {
        // An error without a place, such as a missing key of the whole scene, is shown at the top.
        let place = source.place(error.span().unwrap_or(0..0));
        let kind = SceneErrorKind::Syntax { message: with_nearest(error.message()) };
        Self::new(kind, KeyPath::default(), place, source.path().map(Path::to_owned))
    }

    pub(super) fn list(path: &Path, message: &str, place: Option<Excerpt>) -> Self {
        let kind = SceneErrorKind::Syntax { message: with_nearest(message) };
        Self::new(kind, KeyPath::default(), place, Some(path.to_owned()))
    }

    pub(super) fn unreadable(path: &Path, message: &str) -> Self {
        let kind = SceneErrorKind::Read { message: message.to_owned() };
        Self::new(kind, KeyPath::default(), None, Some(path.to_owned()))
    }

    pub(super) fn unwritable(message: &str) -> Self {
        let kind = SceneErrorKind::Write { message: message.to_owned() };
        Self::new(kind, KeyPath::default(), None, None)
    }

    fn new(
        kind: SceneErrorKind,
        key: KeyPath,
        place: Option<Excerpt>,
        file: Option<PathBuf>,
    ) -> Self {
        Self(Box::new(Details { kind, key, place, file }))
    }
}

impl std::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Details { kind, key, place, file } = &*self.0;
        if let Some(file) = file {
            write!(f, "{}", file.display())?;
            f.write_str(if place.is_some() { ", " } else { ": " })?;
        }
        if let Some(place) = place {
            writeln!(f, "line {}, column {}\n{}", place.line, place.column, place.snippet())?;
        }
        if *key != KeyPath::default() {
            write!(f, "{key}: ")?;
        }
        write!(f, "{kind}")
    }
}

/// A mistake and the key at which it is, before its place in the text is known.
#[derive(Debug)]
pub(crate) struct Fault {
    key: KeyPath,
    kind: Box<SceneErrorKind>,
}

impl Fault {
    pub(crate) fn new(key: KeyPath, kind: SceneErrorKind) -> Self {
        Self { key, kind: Box::new(kind) }
    }

    /// The error with its place in the text, if the scene still says what the text says.
    pub(crate) fn locate(self, scene: &Scene) -> SceneError {
        let source = &scene.source;
        let unchanged = Scene::of(source).is_ok_and(|read| {
            // NaN differs from itself: what was written is compared, not what it is worth.
            format!("{read:?}") == format!("{:?}", scene.without_source())
        });
        if unchanged {
            let (file, place) = source.locate(&self.key);
            SceneError::new(*self.kind, self.key, place, file.map(Path::to_owned))
        } else {
            SceneError::new(*self.kind, self.key, None, None)
        }
    }
}
