//! What can be wrong with the file of a drawing, and where.

use std::fmt;

use super::Place;
use super::place::harmless;

/// Something is wrong with the file of a drawing: what, where, and how to mend it.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingError {
    place: Option<Place>,
    kind: Box<DrawingErrorKind>,
}

impl DrawingError {
    /// What is wrong.
    pub fn kind(&self) -> &DrawingErrorKind {
        &self.kind
    }

    /// The entity, and the line of the file; `None` of the whole file.
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

/// What can be wrong with the file of a drawing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingErrorKind {
    /// The file is larger than any drawing.
    #[error("the file is larger than {limit} MB: save only the layers with the blocks")]
    LargeFile {
        /// The limit \[MB\].
        limit: usize,
    },
    /// The file is no text.
    #[error("the file is binary: save it as text (DXF: \"ASCII\")")]
    Binary,
    /// Nothing in the file bounds a block.
    #[error("nothing in the file bounds a block{left_out}: draw blocks as closed polylines")]
    Empty {
        /// The first entity that was left out, and why.
        left_out: String,
    },
    /// The file ends before it should.
    #[error("the file ends in the middle: save it again")]
    Truncated,
    /// The text does not fit the format.
    #[error("{message}")]
    Syntax {
        /// What is wrong.
        message: String,
    },
    /// A text stands in place of a number.
    #[error("\"{text}\" is no number")]
    Number {
        /// The text.
        text: String,
    },
    /// A coordinate is not finite, or so large that it can be no place.
    #[error("a coordinate is no finite number below 1e60: correct it or delete the entity")]
    NotFinite,
    /// There is more than a drawing has.
    #[error("there are more than {limit} {what}: save only the layers with the blocks")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many there may be.
        limit: usize,
    },
    /// Blocks are inserted in each other without an end, or nearly so.
    #[error("blocks are inserted in each other {depth} times: explode them")]
    Nested {
        /// How deep they may be.
        depth: usize,
    },
    /// A block is inserted that the file does not have.
    #[error(
        "it inserts the block \"{name}\", which the file does not have: bind external references"
    )]
    UnknownBlock {
        /// The name.
        name: String,
    },
    /// A face has a corner that the file does not have.
    #[error("there is no corner {corner}: save the file again")]
    UnknownCorner {
        /// The number or key of the corner.
        corner: String,
    },
    /// A body is no prism across the plane of the others.
    #[error(
        "it is no prism across one plane with the others: the model is plane; cut it with a plane and draw the section"
    )]
    NotPlane,
    /// Bodies lie behind each other.
    #[error(
        "it reaches from {from} to {to} across the plane and others do not: the model is plane; export one layer of blocks"
    )]
    NotOneLayer {
        /// The near end.
        from: f64,
        /// The far end.
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

/// The beginning of a text of the file, without what a terminal obeys.
pub(super) fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    text.chars().take(LONGEST).map(harmless).collect()
}
