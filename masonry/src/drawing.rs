//! Drawings: closed outlines and lines in a plane, with their layer and their place in the file that they come from.
//!
//! A [`Drawing`] is what a file says, without repairs: [`import`](crate::import) makes a scene of it.
//!
//! ```
//! use masonry::drawing::{Drawing, Format};
//! let text = r#"[{ "material": "stone", "corners": [[0, 0], [2, 0], [2, 1], [0, 1]] }]"#;
//! let drawing = Drawing::read(text.as_bytes(), Format::List)?;
//! assert_eq!(drawing.outlines[0].layer, "stone");
//! # Ok::<(), masonry::drawing::DrawingError>(())
//! ```

mod compas;
mod curve;
mod dxf;
mod error;
mod list;
mod mesh;
mod obj;
mod svg;
mod unit;

use std::fmt;

use nalgebra::Point2;

pub use self::error::{DrawingError, DrawingErrorKind};
pub use self::unit::Unit;

/// Bytes of a file. Chosen: fifty times a drawing of 1500 stones; as numbers in a list, JSON takes half a gigabyte of memory.
pub const LARGEST_FILE: usize = 32 << 20;
/// Outlines and lines of a drawing, after blocks were inserted. Chosen: a hundred times a wall of 1500 stones.
const MOST_SHAPES: usize = 150_000;
/// Corners of one outline or line. Chosen: a stone that was scanned has some hundreds.
const MOST_CORNERS: usize = 1000;
/// Corners of a drawing: those that fit into some tens of megabytes.
const MOST_POINTS: usize = 2_000_000;

/// A format of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Drawing exchange format, as text.
    Dxf,
    /// Scalable vector graphics.
    Svg,
    /// Wavefront OBJ.
    Obj,
    /// JSON: an assembly or a mesh of COMPAS, or a list of blocks.
    Json,
    /// JSON: a list of objects with `material`, `corners` and perhaps `name`.
    List,
}

impl Format {
    /// The format by the ending of a file's name.
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending.to_ascii_lowercase().as_str() {
            "dxf" => Some(Self::Dxf),
            "svg" => Some(Self::Svg),
            "obj" => Some(Self::Obj),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}

/// Closed outlines and lines of a file, in its own unit, y up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// The unit of length, if the file gives it.
    pub unit: Option<Unit>,
    /// The extent across the plane, if the file has bodies.
    pub thickness: Option<f64>,
    /// Closed outlines.
    pub outlines: Vec<Outline>,
    /// Open lines.
    pub lines: Vec<Line>,
    /// What was simplified or left out.
    pub changes: Vec<Change>,
    /// Corners so far.
    points: usize,
}

/// A closed outline: a block, or a support.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Corners, in either direction; the last is not the first again.
    pub corners: Vec<Point2<f64>>,
    /// The layer, or the material.
    pub layer: String,
    /// The name, if the file gives one.
    pub name: Option<String>,
    /// Whether the file says that it does not move.
    pub is_fixed: bool,
    /// The place in the file.
    pub place: Place,
}

/// An open line of straight pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The ends of its pieces.
    pub points: Vec<Point2<f64>>,
    /// The layer.
    pub layer: String,
    /// The place in the file.
    pub place: Place,
}

/// A place in a file: what is there, and its line.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Place {
    /// The entity, with its handle or name.
    pub entity: String,
    /// The line of the file, from 1.
    pub line: Option<usize>,
}

impl Place {
    pub(crate) fn new(entity: impl Into<String>, line: Option<usize>) -> Self {
        Self { entity: entity.into(), line }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Names of a file may be long, and may hold what a terminal obeys.
        let shown = |c: char| if c.is_control() { '\u{fffd}' } else { c };
        let mut rest = self.entity.chars();
        let entity: String = rest.by_ref().take(LONGEST_NAME).map(shown).collect();
        let dots = if rest.next().is_some() { "..." } else { "" };
        write!(f, "{entity}{dots}")?;
        self.line.map_or(Ok(()), |line| write!(f, " (line {line})"))
    }
}

/// Characters of a name that are shown. Chosen: one line of a terminal.
const LONGEST_NAME: usize = 100;

/// Something of a drawing that is not in the scene as it was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// What happened.
    pub what: String,
    /// The place in the file.
    pub place: Place,
    /// The largest distance by which a point moved, in the unit of the drawing; in metres once it is imported.
    pub by: Option<f64>,
}

impl Change {
    pub(crate) fn new(what: impl Into<String>, place: &Place) -> Self {
        Self { what: what.into(), place: place.clone(), by: None }
    }

    pub(crate) fn by(what: impl Into<String>, place: &Place, by: f64) -> Self {
        Self { by: Some(by), ..Self::new(what, place) }
    }
}

impl Drawing {
    /// Reads a file.
    ///
    /// # Errors
    /// What is wrong with the file, with the entity and the line, and the remedy.
    pub fn read(bytes: &[u8], format: Format) -> Result<Self, DrawingError> {
        if bytes.len() > LARGEST_FILE {
            return Err(DrawingErrorKind::LargeFile { limit: LARGEST_FILE >> 20 }.nowhere());
        }
        if bytes.starts_with(b"AutoCAD Binary DXF") || bytes.contains(&0) {
            return Err(DrawingErrorKind::Binary.nowhere());
        }
        let text = decoded(bytes);
        let text = text.trim_start_matches('\u{feff}');
        let drawing = match format {
            Format::Dxf => dxf::read(text),
            Format::Svg => svg::read(text),
            Format::Obj => obj::read(text),
            Format::Json if text.trim_start().starts_with('[') => list::read(text),
            Format::Json => compas::read(text),
            Format::List => list::read(text),
        }?;
        if drawing.outlines.is_empty() && drawing.lines.is_empty() {
            return Err(DrawingErrorKind::Empty { left_out: drawing.left_out() }.nowhere());
        }
        Ok(drawing)
    }

    /// What was left out, in words that follow those of an error.
    fn left_out(&self) -> String {
        let first = self.changes.first();
        first.map_or(String::new(), |it| format!(" ({}: {})", it.place, it.what))
    }

    fn add_outline(&mut self, mut outline: Outline) -> Result<(), DrawingError> {
        if outline.corners.len() > 1 && outline.corners.first() == outline.corners.last() {
            outline.corners.pop();
        }
        shorten(&mut outline.layer, &mut outline.place);
        self.count(&outline.corners, &outline.place)?;
        self.outlines.push(outline);
        Ok(())
    }

    fn add_line(&mut self, mut line: Line) -> Result<(), DrawingError> {
        shorten(&mut line.layer, &mut line.place);
        self.count(&line.points, &line.place)?;
        self.lines.push(line);
        Ok(())
    }

    /// Refuses points that are no numbers, or too many.
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

/// Cuts names that would fill the memory if all shapes had them.
fn shorten(layer: &mut String, place: &mut Place) {
    for name in [layer, &mut place.entity] {
        if let Some((end, _)) = name.char_indices().nth(LONGEST_KEPT) {
            name.truncate(end);
        }
    }
}

/// Characters of a name. Theory: names in DXF files have 255 at most.
const LONGEST_KEPT: usize = 255;

/// The largest coordinate. Theory: squares of areas stay below the largest number.
const FARTHEST: f64 = 1e60;

/// The text of a file. Old drawings are no UTF-8: each of their bytes is a character, which keeps names apart.
fn decoded(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect::<String>().into(),
    }
}
