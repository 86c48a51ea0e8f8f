//! Outlines and lines of a drawing, and the changes that a reader makes to them.

use nalgebra::Point2;

use super::error::{DrawingError, DrawingErrorKind};
use super::place::{Place, harmless};
use super::unit::Unit;

/// The largest number of outlines and lines of a drawing, including those of inserted blocks. Chosen: a hundred times a
/// wall of 1500 stones.
pub(super) const MOST_SHAPES: usize = 150_000;
/// The largest number of corners of one outline or line. Chosen: a scanned stone has some hundreds.
pub(super) const MOST_CORNERS: usize = 1000;
/// The largest number of corners of all outlines and lines of a drawing. Chosen: they take some tens of megabytes.
pub(super) const MOST_POINTS: usize = 2_000_000;

/// Closed outlines and lines of a file, in the unit of the file, y up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// The unit of length; `None` if the file gives none that is known.
    pub unit: Option<Unit>,
    /// The number of the unit in `$INSUNITS`, if it is not that of a [`Unit`].
    pub unknown_unit: Option<i64>,
    /// The depth of the bodies perpendicular to the plane, if the file has bodies.
    pub thickness: Option<f64>,
    /// The closed outlines.
    pub outlines: Vec<Outline>,
    /// The open lines.
    pub lines: Vec<DrawnLine>,
    /// The parts of the file that were simplified or left out.
    pub changes: Vec<Change>,
    /// The number of corners of all outlines and lines so far.
    points: usize,
}

/// A closed outline of a block or a support.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Corners, in either direction; the first is not repeated at the end.
    pub corners: Vec<Point2<f64>>,
    /// The name of the layer or of the material.
    pub layer: String,
    /// The name of the block, if the file gives one.
    pub name: Option<String>,
    /// Whether the file marks the outline as fixed, which makes it a support.
    pub is_fixed: bool,
    /// The place of the outline in the file.
    pub place: Place,
}

/// An open polyline.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnLine {
    /// The points of the polyline, in their order.
    pub points: Vec<Point2<f64>>,
    /// The name of the layer.
    pub layer: String,
    /// The place of the line in the file.
    pub place: Place,
}

/// A change of a part of a drawing, or a part that was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// A description of the change.
    pub what: String,
    /// The place of the part in the file.
    pub place: Place,
    /// The largest distance by which a point moved, in the unit of the drawing, or in metres after the import; `None`
    /// if no point moved.
    pub by: Option<f64>,
}

impl Change {
    /// Creates a change without a distance.
    pub fn new(what: impl Into<String>, place: &Place) -> Self {
        Self { what: what.into(), place: place.clone(), by: None }
    }

    /// Creates a change with the distance by which points moved, in units of the drawing.
    pub fn by(what: impl Into<String>, place: &Place, by: f64) -> Self {
        Self { by: Some(by), ..Self::new(what, place) }
    }
}

impl Drawing {
    pub(super) fn in_unit(unit: Option<Unit>) -> Self {
        Self { unit, ..Self::default() }
    }

    /// Returns words for the first part that was left out, to follow an error message.
    pub(super) fn left_out(&self) -> String {
        let first = self.changes.first();
        first.map_or(String::new(), |it| format!(" ({}: {})", it.place, it.what))
    }

    pub(super) fn add_outline(&mut self, mut outline: Outline) -> Result<(), DrawingError> {
        if outline.corners.len() > 1 && outline.corners.first() == outline.corners.last() {
            outline.corners.pop();
        }
        outline.name = outline.name.map(|name| name.chars().map(harmless).collect());
        shorten(&mut outline.layer, &mut outline.place);
        self.count(&outline.corners, &outline.place)?;
        self.outlines.push(outline);
        Ok(())
    }

    pub(super) fn add_line(&mut self, mut line: DrawnLine) -> Result<(), DrawingError> {
        shorten(&mut line.layer, &mut line.place);
        self.count(&line.points, &line.place)?;
        self.lines.push(line);
        Ok(())
    }

    /// Counts points; an error if there are too many, or a coordinate is not finite or too large.
    fn count(&mut self, points: &[Point2<f64>], place: &Place) -> Result<(), DrawingError> {
        let is_place = |it: &f64| it.abs() < FARTHEST;
        if !points.iter().flat_map(|point| point.iter()).all(is_place) {
            return Err(DrawingErrorKind::NotFinite.at(place));
        }
        self.points += points.len();
        let counts = [
            (points.len(), MOST_CORNERS, "corners of one outline"),
            (self.outlines.len() + self.lines.len(), MOST_SHAPES, "outlines and lines"),
            (self.points, MOST_POINTS, "corners"),
        ];
        for (count, limit, what) in counts {
            if count >= limit {
                return Err(DrawingErrorKind::TooMany { what, limit }.at(place));
            }
        }
        Ok(())
    }
}

/// Shortens names, which could fill the memory if all shapes had long ones.
fn shorten(layer: &mut String, place: &mut Place) {
    for name in [layer, &mut place.entity] {
        if let Some((end, _)) = name.char_indices().nth(LONGEST_KEPT) {
            name.truncate(end);
        }
    }
}

/// The largest number of characters of a name that are kept. Theory: names in DXF files have 255 at most.
const LONGEST_KEPT: usize = 255;

/// The largest absolute value of a coordinate. Theory: squares of areas stay below the largest floating-point number.
const FARTHEST: f64 = 1e60;
