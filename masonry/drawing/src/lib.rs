//! Drawings: closed outlines and lines in a plane, with their layer and their place in the file.
//!
//! A [`Drawing`] has the contents of a file, without repairs: the crate `masonry-import` makes a scene of it.
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

/// The largest size of a file in bytes. Chosen: fifty times a drawing of 1500 stones; a JSON file of numbers in a list
/// takes half a gigabyte of memory.
pub const LARGEST_FILE: usize = 32 << 20;

/// A format of files.
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
    /// JSON: a list of objects with `material`, `corners` and perhaps `name`.
    List,
}

impl DrawingFormat {
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

impl Drawing {
    /// Reads a file.
    ///
    /// # Errors
    /// The mistake in the file, with the entity and the line, and the remedy.
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

/// The text of a file. Old drawings are not UTF-8: each of their bytes becomes a character, which keeps names apart.
fn decoded(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect::<String>().into(),
    }
}
