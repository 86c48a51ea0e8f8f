//! Errors of scenes, with their places.

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

/// A mistake in a scene, its place and its remedy.
///
/// The message of a scene that was read from text shows the line with carets below the mistake.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError(Box<Details>);

#[derive(Debug, Clone, PartialEq)]
struct Details {
    kind: SceneErrorKind,
    key: KeyPath,
    located: Located,
}

impl SceneError {
    /// The kind of the mistake.
    pub fn kind(&self) -> &SceneErrorKind {
        &self.0.kind
    }

    /// The key of the wrong value, such as `walls[0].brick.length`; empty if the text is not TOML
    /// or does not fit the format.
    pub fn key(&self) -> String {
        self.0.key.to_string()
    }

    /// The line of the mistake, from 1; `None` when the scene was built or changed in Rust.
    pub fn line(&self) -> Option<usize> {
        self.0.located.place.as_ref().map(|place| place.line)
    }

    /// The column of the mistake in characters, from 1; `None` as [`SceneError::line`].
    pub fn column(&self) -> Option<usize> {
        self.0.located.place.as_ref().map(|place| place.column)
    }

    /// The file from which the scene was read.
    pub fn file(&self) -> Option<&Path> {
        self.0.located.file.as_deref()
    }

    /// A text that does not fit the format.
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

/// A mistake and the key at which it is, before its place in the text is known.
#[derive(Debug)]
pub(crate) struct Fault {
    key: KeyPath,
    kind: Box<SceneErrorKind>,
}

impl Fault {
    pub(crate) fn new(key: KeyPath, kind: impl Into<SceneErrorKind>) -> Self {
        Self { key, kind: Box::new(kind.into()) }
    }

    /// The error of a name that is already used by the value at `first`; `what` is the kind of
    /// both.
    pub(crate) fn duplicate(at: KeyPath, what: &'static str, name: &str, first: &KeyPath) -> Self {
        let (name, first) = (name.to_owned(), first.to_string());
        Self::new(at, SceneErrorKind::Duplicate { what, name, first })
    }

    /// The error with its place in the text, if the scene still equals its text.
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
