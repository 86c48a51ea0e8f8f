//! A JSON list of blocks, with the same keys as in scenes.

use nalgebra::Point2;
use serde::Deserialize;

use super::{Drawing, DrawingError, DrawingErrorKind, Outline, Place};

/// A block of the JSON list.
#[derive(Deserialize)]
struct Listed {
    #[serde(default)]
    name: Option<String>,
    material: String,
    corners: Vec<[f64; 2]>,
}

pub(super) fn read(text: &str) -> Result<Drawing, DrawingError> {
    let listed: Vec<Listed> = serde_json::from_str(text).map_err(|error| json_error(&error))?;
    let mut drawing = Drawing::default();
    for (number, Listed { name, material, corners }) in (1..).zip(listed) {
        let place = match &name {
            Some(name) => format!("block \"{name}\""),
            None => format!("block {number} of the list"),
        };
        let place = Place::new(place, None);
        let corners = corners.into_iter().map(Point2::from).collect();
        let outline = Outline { corners, layer: material, name, is_fixed: false, place };
        drawing.add_outline(outline)?;
    }
    Ok(drawing)
}

/// Returns the mistake in a text that is not JSON, or not a list of blocks.
pub(super) fn json_error(error: &serde_json::Error) -> DrawingError {
    let place = Place::new("JSON", Some(error.line()));
    if error.is_eof() {
        return DrawingErrorKind::Truncated.at(&place);
    }
    DrawingErrorKind::Syntax { message: error.to_string() }.at(&place)
}
