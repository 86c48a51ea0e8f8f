//! What import makes of a drawing.

use nalgebra::Point2;

use masonry::scene::Scene;
use masonry_drawing::{Change, Place, Unit};

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
    pub(crate) drawn: Vec<Vec<Point2<f64>>>,
    /// The places of the blocks in the drawing.
    pub(crate) places: Vec<Place>,
    /// How many of the last supports belong to the scene that names the drawing.
    pub(crate) supports_of_scene: usize,
    /// What nobody said, and the scene needs.
    pub(crate) assumed: Vec<String>,
}
