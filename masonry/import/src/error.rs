//! Reasons for which a drawing does not become a scene, with their places.

use std::fmt;

use masonry::scene::SceneError;
use masonry_drawing::{Place, Unit};

/// The reason for which a drawing does not become a scene, with its places in the drawing and a remedy.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportError {
    places: Vec<Place>,
    kind: Box<ImportErrorKind>,
}

impl ImportError {
    /// Returns the kind of the error.
    pub fn kind(&self) -> &ImportErrorKind {
        &self.kind
    }

    /// Returns the places of the error in the drawing: one place, or those of two blocks.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Returns the tolerance that did not suffice \[m\]; `None` for other errors.
    pub(crate) fn tolerance(&self) -> Option<f64> {
        match *self.kind {
            ImportErrorKind::Overlap { tolerance, .. }
            | ImportErrorKind::NotHealed { tolerance, .. } => Some(tolerance),
            _ => None,
        }
    }

    /// Returns the error with a sufficient tolerance as its remedy, if there is one.
    pub(crate) fn with_remedy(mut self, sufficient: Option<f64>) -> Self {
        if let ImportErrorKind::Overlap { remedy, .. } | ImportErrorKind::NotHealed { remedy, .. } =
            &mut *self.kind
        {
            *remedy = sufficient.map_or_else(
                || "no tolerance mends that: correct the drawing there".to_owned(),
                |it| format!("--tolerance {} would do", super::report::metres(it)),
            );
        }
        self
    }
}

impl std::error::Error for ImportError {}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let places: Vec<String> = self.places.iter().map(Place::to_string).collect();
        if !places.is_empty() {
            write!(f, "{}: ", places.join(" and "))?;
        }
        write!(f, "{}", self.kind)
    }
}

/// A reason for which a drawing does not become a scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImportErrorKind {
    /// A value of the options is out of range.
    #[error("{option} is {value}: give a positive number")]
    Option {
        /// The name of the option.
        option: &'static str,
        /// The value of the option.
        value: f64,
    },
    /// No outline bounds a block.
    #[error(
        "no outline bounds a block{dropped}: draw blocks as closed polylines, on other layers than \"support\" and \"joint\""
    )]
    NoBlocks {
        /// The last outline that was dropped, with the reason.
        dropped: String,
    },
    /// No support is drawn, and no block rests on a line below all blocks.
    #[error(
        "no support is drawn, and no block rests with an edge on a line below all others: draw supports on a layer \"support\""
    )]
    NoFloor,
    /// The drawing has more items of a kind than the import allows.
    #[error("there are more than {limit} {what}: import parts of the drawing")]
    TooMany {
        /// The name of the items.
        what: &'static str,
        /// The largest allowed number of these items.
        limit: usize,
    },
    /// Outlines lie over each other by the dozen at one place.
    #[error(
        "dozens of outlines lie over each other here: draw each block once, or leave their layer out by --ignore"
    )]
    Crowded,
    /// The unit of the file is unknown.
    #[error(
        "the unit {number} of $INSUNITS is not known: give --unit, or --unit m and the metres in one unit as --scale"
    )]
    UnknownUnit {
        /// The number of the unit in `$INSUNITS`.
        number: i64,
    },
    /// The blocks have a size that stones do not have, so that the unit is probably wrong.
    #[error(
        "half of all blocks are {compared} than {size} m, with {unit} as the unit ({from}): {remedy}"
    )]
    Size {
        /// The comparison with the size in the message: `larger` or `smaller`.
        compared: &'static str,
        /// The median size of the blocks \[m\].
        size: String,
        /// The unit in which the drawing was read.
        unit: Unit,
        /// The source of the unit, in words.
        from: &'static str,
        /// The remedy, in words of the message.
        remedy: String,
    },
    /// The tolerance is too large for an edge of a block.
    #[error(
        "its edge of {edge} m is shorter than four times the tolerance of {tolerance} m: give --tolerance {most} or less"
    )]
    ShortEdge {
        /// The length of the edge \[m\].
        edge: String,
        /// The tolerance that is too large \[m\].
        tolerance: String,
        /// The largest tolerance that this edge allows \[m\].
        most: String,
    },
    /// A block has no width at one of its corners.
    #[error("the block has no width at its corner at ({x}, {y}) m: leave the corner out")]
    NoWidth {
        /// The x coordinate of the corner \[m\].
        x: String,
        /// The y coordinate of the corner \[m\].
        y: String,
    },
    /// The edges of an outline cross or touch each other.
    #[error(
        "its edges cross or touch each other: draw it with the corners in the order in which they follow each other"
    )]
    Crossing,
    /// Joints are drawn open, and no option gives their meaning.
    #[error(
        "{count} joints are open, the first by {width} m: give --joints close if they are thin, --joints mortar if they are filled, or --joints open if they are gaps"
    )]
    OpenJoints {
        /// The number of open joints.
        count: usize,
        /// The width of the first open joint \[m\].
        width: String,
    },
    /// The width of a joint differs from that of the other joints, so that no thickness of mortar fits all joints.
    #[error(
        "the joint is {width} m wide and others are {usual} m: correct the drawing, or give --joints close"
    )]
    UnevenMortar {
        /// The width of this joint \[m\].
        width: String,
        /// The width of most other joints \[m\].
        usual: String,
    },
    /// Blocks overlap by more than the tolerance.
    #[error(
        "the blocks overlap by {depth} m, which is more than the tolerance of {shown} m: {remedy}"
    )]
    Overlap {
        /// The depth of the overlap \[m\].
        depth: String,
        /// The tolerance that the overlap exceeds \[m\].
        tolerance: f64,
        /// The tolerance with few digits, as the message shows it.
        shown: String,
        /// The remedy, in words of the message.
        remedy: String,
    },
    /// Corners that are nearer to each other than the tolerance cannot all meet.
    #[error(
        "not all corners nearer to each other than the tolerance of {shown} m can meet ({reason}): {remedy}"
    )]
    NotHealed {
        /// The tolerance below which corners are to meet \[m\].
        tolerance: f64,
        /// The tolerance with few digits, as the message shows it.
        shown: String,
        /// The reason for which the corners cannot meet.
        reason: &'static str,
        /// The remedy, in words of the message.
        remedy: String,
    },
    /// The scene itself has an error.
    #[error("{0}")]
    Scene(SceneError),
}

impl ImportErrorKind {
    pub(crate) fn at(self, places: &[&Place]) -> ImportError {
        let places = places.iter().map(|place| (*place).clone()).collect();
        ImportError { places, kind: Box::new(self) }
    }
}
