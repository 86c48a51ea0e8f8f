//! Mistakes in the text of a scene, with their places.

use std::path::Path;

use masonry::scene::SceneError;
use masonry::{LimitError, SolveError};
use serde::Serialize;

/// The name of the file that stands for the text of the page; mistakes in this file have places in the text.
pub(super) const SCENE: &str = "text of the page";

/// The reason for which a question has no answer.
#[derive(Debug, Serialize)]
pub(super) struct Fault {
    pub(super) message: String,
    /// The line of the mistake in the text of the scene, from 1; `None` if the mistake has no place in the text.
    pub(super) line: Option<usize>,
    pub(super) column: Option<usize>,
}

impl Fault {
    pub(super) fn new(message: &impl ToString) -> Self {
        Self { message: message.to_string(), line: None, column: None }
    }
}

impl From<SceneError> for Fault {
    fn from(error: SceneError) -> Self {
        let file = error.file().and_then(Path::file_name);
        if file.is_some_and(|it| it != SCENE) {
            // The mistake is in the file that lists the blocks of the scene.
            return Self::new(&error);
        }
        let (key, kind) = (error.key(), error.kind());
        let message = if key.is_empty() { kind.to_string() } else { format!("{key}: {kind}") };
        Self { message, line: error.line(), column: error.column() }
    }
}

impl From<SolveError> for Fault {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::Scene(error) => error.into(),
            other => Self::new(&other),
        }
    }
}

impl From<LimitError> for Fault {
    fn from(error: LimitError) -> Self {
        match error {
            LimitError::Scene(error) => error.into(),
            other => Self::new(&other),
        }
    }
}

impl From<serde_json::Error> for Fault {
    fn from(error: serde_json::Error) -> Self {
        Self::new(&error)
    }
}
