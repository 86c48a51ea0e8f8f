//! Scenes from drawings: outlines become blocks that meet exactly, lines become supports, and a report lists all
//! changes.
//!
//! ```
//! use masonry_drawing::{Drawing, DrawingFormat};
//! use masonry_import::{ImportOptions, import};
//! // Two stones, the upper one a millimetre too low.
//! let text = r#"[{ "material": "stone", "corners": [[0, 0], [2, 0], [2, 1], [0, 1]] },
//!                { "material": "stone", "corners": [[0, 0.999], [2, 0.999], [2, 2], [0, 2]] }]"#;
//! let drawing = Drawing::read(text.as_bytes(), DrawingFormat::List)?;
//! let imported = import(&drawing, &ImportOptions::default())?;
//! assert_eq!(imported.scene.blocks[1].corners[0], [0.0, 0.9995]);
//! assert!(imported.report().contains("corners were moved"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod classes;
mod error;
mod faces;
mod fit;
mod floor;
mod gaps;
mod imported;
mod listed;
mod near;
mod options;
mod outline;
mod picture;
mod report;
mod sheet;
mod size;
mod stones;
mod supports;
mod text;

pub use self::error::{ImportError, ImportErrorKind};
use self::fit::Fitted;
pub use self::imported::Imported;
pub use self::listed::{read_scene, scene_from_toml};
pub use self::options::{ImportOptions, Joints};
use self::sheet::Sheet;
use masonry_drawing::Drawing;

/// Makes a scene from a drawing.
///
/// # Errors
/// A mistake that cannot be repaired, with its place in the drawing and a remedy, such as a sufficient tolerance.
pub fn import(drawing: &Drawing, options: &ImportOptions) -> Result<Imported, ImportError> {
    let attempt = |tolerance| -> Result<Imported, ImportError> {
        let mut sheet = Sheet::of(drawing, options, tolerance)?;
        let floor = floor::add(&mut sheet)?;
        supports::without_overlaps(&mut sheet);
        let fitted = Fitted::of(&mut sheet, options)?;
        let mut imported = build::scene(sheet, &fitted, options)?;
        imported.assumed.extend(floor);
        Ok(imported)
    };
    attempt(options.tolerance).map_err(|error| match error.tolerance() {
        Some(tolerance) => {
            // A tolerance with which more blocks are dropped as slivers or duplicates is not a remedy.
            let count =
                Sheet::of(drawing, options, options.tolerance).map_or(0, |it| it.stones.len());
            let does = |it| attempt(Some(it)).is_ok_and(|it| it.scene.blocks.len() >= count);
            error.with_remedy(fit::sufficient(tolerance, does))
        }
        None => error,
    })
}
