//! Mistakes in the file of a drawing, with their places.

use std::fmt;

use super::Place;
use super::place::harmless;

/// A mistake in the file of a drawing, with its place and a remedy.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingError {
    place: Option<Place>,
    kind: Box<DrawingErrorKind>,
}

impl DrawingError {
    /// Returns the kind of the mistake.
    pub fn kind(&self) -> &DrawingErrorKind {
        &self.kind
    }

    /// Returns the entity and the line of the mistake; `None` if the mistake concerns the whole file.
    pub fn place(&self) -> Option<&Place> {
        self.place.as_ref()
    }
}

impl std::error::Error for DrawingError {}

impl fmt::Display for DrawingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.place.as_ref().map_or(Ok(()), |place| write!(f, "{place}: "))?;
        write!(f, "{}", self.kind)
    }
}

/// A mistake in the file of a drawing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingErrorKind {
    /// The file is larger than any drawing should be.
    #[error("the file is larger than {limit} MB: save only the layers with the blocks")]
    LargeFile {
        /// The largest allowed size of a file \[MB\].
        limit: usize,
    },
    /// The file is not text.
    #[error("the file is binary: save it as text (DXF: \"ASCII\")")]
    Binary,
    /// The file has no entity that can bound a block.
    #[error("nothing in the file bounds a block{left_out}: draw blocks as closed polylines")]
    Empty {
        /// The first entity that was left out, with the reason.
        left_out: String,
    },
    /// The file ends too early.
    #[error("the file ends in the middle: save it again")]
    Truncated,
    /// The text does not fit the format.
    #[error("{message}")]
    Syntax {
        /// The message about the mistake.
        message: String,
    },
    /// A number was expected, and the file has another text.
    #[error("\"{text}\" is not a number")]
    Number {
        /// The text in place of the number.
        text: String,
    },
    /// A coordinate is not finite, or too large.
    #[error("a coordinate is not a finite number below 1e60: correct it or delete the entity")]
    NotFinite,
    /// The file has more items of a kind than a drawing may have.
    #[error("there are more than {limit} {what}: save only the layers with the blocks")]
    TooMany {
        /// The name of the items.
        what: &'static str,
        /// The largest allowed number of these items.
        limit: usize,
    },
    /// References of blocks are nested without end, or too deeply.
    #[error("block references are nested more than {depth} deep: explode them")]
    Nested {
        /// The largest allowed depth of nested insertions.
        depth: usize,
    },
    /// A block is inserted that is not in the file.
    #[error(
        "it inserts the block \"{name}\", which the file does not have: bind external references"
    )]
    UnknownBlock {
        /// The name of the block.
        name: String,
    },
    /// A face or line has a corner that is not in the file.
    #[error("there is no corner {corner}: save the file again")]
    UnknownCorner {
        /// The number or key of the corner.
        corner: String,
    },
    /// A body is not a prism perpendicular to the plane that the other bodies have.
    #[error(
        "it is not a prism across the plane of the others: the model is plane; cut it with a plane and draw the section"
    )]
    NotPlane,
    /// Bodies lie behind each other, seen perpendicular to the plane.
    #[error(
        "it reaches from {from} to {to} across the plane and others do not: the model is plane; export one layer of blocks"
    )]
    NotOneLayer {
        /// The coordinate of the near end of the body, perpendicular to the plane.
        from: f64,
        /// The coordinate of the far end of the body, perpendicular to the plane.
        to: f64,
    },
}

impl DrawingErrorKind {
    pub(super) fn at(self, place: &Place) -> DrawingError {
        DrawingError { place: Some(place.clone()), kind: Box::new(self) }
    }

    pub(super) fn nowhere(self) -> DrawingError {
        DrawingError { place: None, kind: Box::new(self) }
    }
}

/// Returns the beginning of a text of the file, without characters that control a terminal.
pub(super) fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    text.chars().take(LONGEST).map(harmless).collect()
}
