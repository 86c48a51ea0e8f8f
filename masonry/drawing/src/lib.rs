//! Drawings: closed outlines and lines in a plane, each with its layer and its place in the file.
//!
//! A [`Drawing`] has the contents of a file, without repairs. The crate `masonry-import` makes a scene from it.
//!
//! ```
//! use masonry_drawing::{Drawing, DrawingFormat};
//! let text = r#"[{ "material": "stone", "corners": [[0, 0], [2, 0], [2, 1], [0, 1]] }]"#;
//! let drawing = Drawing::read(text.as_bytes(), DrawingFormat::List)?;
//! assert_eq!(drawing.outlines[0].layer, "stone");
//! # Ok::<(), masonry_drawing::DrawingError>(())
//! ```

mod compas;
mod curve;
mod dxf;
mod error;
mod list;
mod mesh;
mod obj;
mod place;
mod shapes;
mod svg;
mod unit;

pub use self::error::{DrawingError, DrawingErrorKind};
pub use self::place::Place;
pub use self::shapes::{Change, Drawing, DrawnLine, Outline};
pub use self::unit::Unit;

/// The largest size of a file in bytes. Chosen: fifty times a drawing of 1500 stones; a JSON file that is one list of
/// numbers takes half a gigabyte of memory at this size.
pub const LARGEST_FILE: usize = 32 << 20;

/// A file format of drawings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingFormat {
    /// Drawing exchange format, as text.
    Dxf,
    /// Scalable vector graphics.
    Svg,
    /// Wavefront OBJ.
    Obj,
    /// JSON: an assembly or a mesh of COMPAS, or a list of blocks.
    Json,
    /// JSON: a list of objects with `material`, `corners` and optionally `name`.
    List,
}

impl DrawingFormat {
    /// Returns the format for the ending of a file's name; `None` for an unknown ending.
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

impl Drawing {
    /// Reads a drawing from the bytes of a file.
    ///
    /// # Errors
    /// The mistake in the file, with its entity, its line, and a remedy.
    pub fn read(bytes: &[u8], format: DrawingFormat) -> Result<Self, DrawingError> {
        if bytes.len() > LARGEST_FILE {
            return Err(DrawingErrorKind::LargeFile { limit: LARGEST_FILE >> 20 }.nowhere());
        }
        if bytes.starts_with(b"AutoCAD Binary DXF") || bytes.contains(&0) {
            return Err(DrawingErrorKind::Binary.nowhere());
        }
        let text = decoded(bytes);
        let text = text.trim_start_matches('\u{feff}');
        let drawing = match format {
            DrawingFormat::Dxf => dxf::read(text),
            DrawingFormat::Svg => svg::read(text),
            DrawingFormat::Obj => obj::read(text),
            DrawingFormat::Json if text.trim_start().starts_with('[') => list::read(text),
            DrawingFormat::Json => compas::read(text),
            DrawingFormat::List => list::read(text),
        }?;
        if drawing.outlines.is_empty() && drawing.lines.is_empty() {
            return Err(DrawingErrorKind::Empty { left_out: drawing.left_out() }.nowhere());
        }
        Ok(drawing)
    }
}

/// Returns the bytes of a file as text. Old drawings are not UTF-8: each byte then becomes a character, so that
/// different names stay different.
fn decoded(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect::<String>().into(),
    }
}
