//! Scenes from drawings: outlines become blocks that meet exactly, lines become supports, and a report says what was changed.
//!
//! ```
//! use masonry::drawing::{Drawing, Format};
//! use masonry::import::{Options, import};
//! // Two stones, the upper one a millimetre too low.
//! let text = r#"[{ "material": "stone", "corners": [[0, 0], [2, 0], [2, 1], [0, 1]] },
//!                { "material": "stone", "corners": [[0, 0.999], [2, 0.999], [2, 2], [0, 2]] }]"#;
//! let drawing = Drawing::read(text.as_bytes(), Format::List)?;
//! let imported = import(&drawing, &Options::default())?;
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
mod near;
mod outline;
mod picture;
mod report;
mod sheet;
mod size;
mod stones;
mod supports;
mod text;

use nalgebra::Point2;

pub use self::error::{ImportError, ImportErrorKind};
use self::fit::Fitted;
use self::sheet::Sheet;
use crate::drawing::{Change, Drawing, Place, Unit};
use crate::scene::Scene;

/// What becomes of joints that are drawn open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joints {
    /// Gaps of one width are filled with mortar.
    Mortar,
    /// Blocks grow until they meet.
    Close,
    /// Gaps stay.
    Open,
}

/// How a drawing becomes a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The title of the scene.
    pub title: String,
    /// The unit of the drawing, in place of that of the file.
    pub unit: Option<Unit>,
    /// Factor of all lengths.
    pub scale: f64,
    /// What is nearer than this belongs together \[m\]; by default a part of the shortest edge.
    pub tolerance: Option<f64>,
    /// Thickness out of the plane \[m\]; by default that of the bodies of the file, or one metre.
    pub thickness: Option<f64>,
    /// What becomes of joints that are drawn open; without it they are an error.
    pub joints: Option<Joints>,
    /// Density of the blocks \[kg/m^3\].
    pub density: f64,
    /// Coefficient of friction of all joints.
    pub mu: f64,
    /// Layers that are left out.
    pub ignore: Vec<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            title: "Imported drawing".to_owned(),
            unit: None,
            scale: 1.0,
            tolerance: None,
            thickness: None,
            joints: None,
            // Chosen: limestone, and the friction of sawn stone; both are written into the scene as assumptions.
            density: 2000.0,
            mu: 0.6,
            ignore: Vec::new(),
        }
    }
}

/// A scene from a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The scene, which is a model without mistakes.
    pub scene: Scene,
    /// What was changed and left out, with distances in metres.
    pub changes: Vec<Change>,
    /// What was nearer than this belonged together \[m\].
    pub tolerance: f64,
    /// The unit of the drawing.
    pub unit: Unit,
    /// The outlines and lines as they were drawn \[m\].
    drawn: Vec<Vec<Point2<f64>>>,
    /// The places of the blocks in the drawing.
    places: Vec<Place>,
    /// What nobody said, and the scene needs.
    assumed: Vec<String>,
}

/// Makes a scene of a drawing.
///
/// # Errors
/// What cannot be mended, with its place in the drawing and the remedy, such as the tolerance that would suffice.
pub fn import(drawing: &Drawing, options: &Options) -> Result<Imported, ImportError> {
    let attempt = |tolerance| {
        let mut sheet = Sheet::of(drawing, options, tolerance)?;
        let fitted = Fitted::of(&mut sheet, options)?;
        build::scene(sheet, fitted, options)
    };
    attempt(options.tolerance).map_err(|error| match error.tolerance() {
        Some(tolerance) => {
            error.with_remedy(fit::sufficient(tolerance, |it| attempt(Some(it)).is_ok()))
        }
        None => error,
    })
}
