//! Errors of scenes, with their places in the text.

mod contact;
mod kind;
mod known;

use std::fmt;
use std::path::Path;

pub use contact::ContactError;
pub use kind::SceneErrorKind;
pub use known::Known;
use known::with_nearest;

use super::source::{Excerpt, Located};
use super::{KeyPath, Scene};

/// A mistake in a scene, with its place and its remedy.
///
/// If the scene was read from text, the message shows the line with carets below the mistake.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError(Box<Details>);

#[derive(Debug, Clone, PartialEq)]
struct Details {
    kind: SceneErrorKind,
    key: KeyPath,
    located: Located,
}

impl SceneError {
    /// Returns the kind of the mistake.
    pub fn kind(&self) -> &SceneErrorKind {
        &self.0.kind
    }

    /// Returns the key of the wrong value, such as `walls[0].brick.length`; empty if the text is not TOML or does not
    /// fit the format.
    pub fn key(&self) -> String {
        self.0.key.to_string()
    }

    /// Returns the line of the mistake, from 1; `None` if the scene was built or changed in Rust.
    pub fn line(&self) -> Option<usize> {
        self.0.located.place.as_ref().map(|place| place.line)
    }

    /// Returns the column of the mistake in characters, from 1; `None` if the scene was built or changed in Rust.
    pub fn column(&self) -> Option<usize> {
        self.0.located.place.as_ref().map(|place| place.column)
    }

    /// Returns the path of the file from which the scene was read; `None` if there is no file.
    pub fn file(&self) -> Option<&Path> {
        self.0.located.file.as_deref()
    }

    /// Makes the error of a text that does not fit the format.
    pub(super) fn syntax(message: &str, place: Option<Excerpt>, file: Option<&Path>) -> Self {
        let kind = SceneErrorKind::Syntax(with_nearest(message));
        let file = file.map(Path::to_owned);
        Self::new(kind, KeyPath::default(), Located { file, place, entity: None })
    }

    pub(super) fn unreadable(path: &Path, message: String) -> Self {
        let located = Located { file: Some(path.to_owned()), ..Located::default() };
        Self::new(SceneErrorKind::Read(message), KeyPath::default(), located)
    }

    pub(super) fn unwritable(message: String) -> Self {
        Self::new(SceneErrorKind::Write(message), KeyPath::default(), Located::default())
    }

    fn new(kind: SceneErrorKind, key: KeyPath, located: Located) -> Self {
        Self(Box::new(Details { kind, key, located }))
    }
}

impl std::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Details { kind, key, located: Located { file, place, entity } } = &*self.0;
        if let Some(file) = file {
            write!(f, "{}", file.display())?;
            f.write_str(if place.is_some() || entity.is_some() { ", " } else { ": " })?;
        }
        if let Some(entity) = entity {
            write!(f, "{entity}: ")?;
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

/// A mistake and the key at which it occurs, before its place in the text is known.
#[derive(Debug)]
pub(crate) struct Fault {
    key: KeyPath,
    kind: Box<SceneErrorKind>,
}

impl Fault {
    pub(crate) fn new(key: KeyPath, kind: impl Into<SceneErrorKind>) -> Self {
        Self { key, kind: Box::new(kind.into()) }
    }

    /// Makes the error of a name that is already used by the value at `first`; `what` is the kind of both values.
    pub(crate) fn duplicate(at: KeyPath, what: &'static str, name: &str, first: &KeyPath) -> Self {
        let (name, first) = (name.to_owned(), first.to_string());
        Self::new(at, SceneErrorKind::Duplicate { what, name, first })
    }

    /// Returns the error with its place in the text, if the scene still equals the text from which it was read.
    pub(crate) fn locate(self, scene: &Scene) -> SceneError {
        let source = &scene.source;
        let unchanged = Scene::of(source).is_ok_and(|read| {
            // NaN differs from itself: the written forms are compared, not the values.
            format!("{read:?}") == format!("{:?}", scene.without_source())
        });
        let located = if unchanged { source.locate(&self.key) } else { Located::default() };
        SceneError::new(*self.kind, self.key, located)
    }
}
