//! The errors of reading a file.

use std::fmt::Display;
use std::path::PathBuf;

use super::format::ProblemFormat;

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
}

impl Display for Position {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// An error of reading a file: the place, the datum expected there, and the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// Something else stands in the place of a datum that the format expects.
    #[error("{at}: expected {expected}, found {found}; {remedy}")]
    Unexpected {
        /// The place.
        at: Position,
        /// The datum that the format expects.
        expected: String,
        /// The text in the file.
        found: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// A header announces more data than the file holds.
    #[error(
        "{at}: {what} needs {needed} more numbers, but at most {left} are left in the file; \
         correct the sizes, or complete the file"
    )]
    TooShort {
        /// The place at which the data begin.
        at: Position,
        /// The datum.
        what: &'static str,
        /// Numbers that the datum needs (`usize::MAX` if there are too many to count).
        needed: usize,
        /// Words that the file still has.
        left: usize,
    },
    /// The file does not have the JSON form described in [`crate::io`].
    #[error(
        "{at}: {message}; the fields of every kind are listed in the documentation of lcp_problems::io"
    )]
    Json {
        /// The place.
        at: Position,
        /// The mistake.
        message: String,
    },
    /// The data were read, but do not form a problem.
    #[error("{at}: {source}")]
    Refused {
        /// The place at which the data begin.
        at: Position,
        /// The mistake in them.
        source: lcp::Error,
    },
    /// No format fits; `format` came furthest.
    #[error(
        "{source} (none of the known formats fits: {}; {format} fits the longest part: name another format if that is wrong)",
        known()
    )]
    Unrecognised {
        /// The format.
        format: ProblemFormat,
        /// The reason for which it does not fit.
        source: Box<ReadError>,
    },
    /// A name that no format has.
    #[error("there is no format `{name}`: take one of {}", known())]
    UnknownFormat {
        /// The name.
        name: String,
    },
    /// A Matrix Market file, which holds one matrix, instead of a problem.
    #[error(
        "a Matrix Market file holds one matrix, not a whole problem: name the file of every part, as in \
         --m M.mtx --q q.mtx or --a A.mtx --b B.mtx --c c.mtx"
    )]
    OneMatrix,
    /// More than one format fits.
    #[error("the file can be read as {}; name the format", list(.formats))]
    Ambiguous {
        /// The formats that fit.
        formats: Vec<ProblemFormat>,
    },
    /// The file could not be opened or read.
    #[error("cannot read {}: {reason}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The message of the system.
        reason: String,
    },
}

impl ReadError {
    pub(super) fn unexpected(
        at: Position,
        expected: impl Display,
        found: impl Display,
        remedy: &'static str,
    ) -> Self {
        Self::Unexpected { at, expected: expected.to_string(), found: found.to_string(), remedy }
    }

    /// The progress of a reader, compared first by whether it reached the end of the text, including numbers that do
    /// not form a problem and files that are nearly complete, then by the place.
    pub(super) fn reach(&self) -> (bool, Option<Position>) {
        let is_to_the_end = match self {
            Self::TooShort { needed, left, .. } => *left >= needed / 2 && *needed > 0,
            _ => matches!(self, Self::Refused { .. }),
        };
        (is_to_the_end, self.position())
    }

    /// The place in the file, if the error has one.
    pub fn position(&self) -> Option<Position> {
        match self {
            Self::Unexpected { at, .. }
            | Self::TooShort { at, .. }
            | Self::Json { at, .. }
            | Self::Refused { at, .. } => Some(*at),
            Self::Unrecognised { source, .. } => source.position(),
            _ => None,
        }
    }
}

/// The names of all formats.
fn known() -> String {
    ProblemFormat::ALL.map(ProblemFormat::name).join(", ")
}

fn list(formats: &[ProblemFormat]) -> String {
    let names: Vec<String> = formats.iter().map(ToString::to_string).collect();
    names.join(" or as ")
}

/// Parses a format from its name.
impl std::str::FromStr for ProblemFormat {
    type Err = ReadError;

    fn from_str(name: &str) -> Result<Self, ReadError> {
        let found = Self::ALL.into_iter().find(|format| format.name() == name);
        found.ok_or_else(|| ReadError::UnknownFormat { name: name.to_owned() })
    }
}
