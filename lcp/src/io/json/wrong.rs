//! What is wrong with a document, and where.

use std::collections::BTreeMap;

use serde_json::from_str;
use serde_json::value::RawValue;

use crate::Error;
use crate::io::{Position, ReadError};

/// What is wrong, before its place is looked up.
pub(super) enum Wrong {
    /// A text that is not of the kind.
    Syntax(serde_json::Error),
    /// Fields that do not fit together.
    Misfit { path: Vec<Step>, message: String },
    /// Data that do not make a problem.
    Refused(Error),
}

/// A step on the way to a part of a document.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    Field(&'static str),
    Item(usize),
}

impl From<serde_json::Error> for Wrong {
    fn from(error: serde_json::Error) -> Self {
        Self::Syntax(error)
    }
}

impl From<Error> for Wrong {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}

impl Wrong {
    pub(super) fn at(path: &[Step], message: String) -> Self {
        Self::Misfit { path: path.to_vec(), message }
    }

    pub(super) fn in_text(self, text: &str) -> ReadError {
        match self {
            Self::Syntax(error) => {
                let (line, column) = (error.line(), error.column());
                // Its message ends with the place where it has one.
                let message = error.to_string();
                let place = format!(" at line {line} column {column}");
                let message = message.strip_suffix(&place).unwrap_or(&message).to_owned();
                let at = Position { line: line.max(1), column: column.max(1) };
                ReadError::Json { at, message }
            }
            Self::Misfit { path, message } => ReadError::Json { at: place(text, &path), message },
            Self::Refused(source) => {
                let path = field_of(&source).map(Step::Field);
                ReadError::Refused { at: place(text, path.as_slice()), source }
            }
        }
    }
}

/// The fields that the data of errors are.
const FIELDS: [&str; 13] =
    ["k", "m", "p", "q", "mu", "x_0", "s_0", "free", "u", "l", "lower", "upper", "compliance"];

/// The field that an error is about.
fn field_of(error: &Error) -> Option<&'static str> {
    let datum = match error {
        Error::NotFinite { what, .. } | Error::NotSymmetric { what, .. } => what,
        Error::Setting { name, .. } | Error::Length { name, .. } => name,
        Error::Between { what: "row", .. } => "l",
        Error::Bounds { .. } | Error::Between { .. } => "lower",
        Error::Indefinite { .. } => "k",
        Error::NotConvex { .. } => "p",
        _ => return None,
    };
    FIELDS.into_iter().find(|field| field.eq_ignore_ascii_case(datum))
}

/// Where a part of a document begins, or the last one on the way to it that is there.
fn place(text: &str, path: &[Step]) -> Position {
    let mut part = text.trim_start();
    for step in path {
        let next: Option<&RawValue> = match *step {
            Step::Field(name) => from_str(part)
                .ok()
                .and_then(|fields: BTreeMap<String, &RawValue>| fields.get(name).copied()),
            Step::Item(k) => {
                from_str(part).ok().and_then(|items: Vec<&RawValue>| items.get(k).copied())
            }
        };
        let Some(next) = next else { break };
        part = next.get();
    }
    let before = &text[..part.as_ptr().addr() - text.as_ptr().addr()];
    let line_begin = before.rfind('\n').map_or(0, |end| end + 1);
    Position { line: before.matches('\n').count() + 1, column: before.len() - line_begin + 1 }
}
