//! The result of importing a drawing.

use nalgebra::Point2;

use masonry::scene::Scene;
use masonry_drawing::{Change, Place, Unit};

/// A scene from a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The scene, which is a model without mistakes.
    pub scene: Scene,
    /// The changes and the parts left out, with distances in metres.
    pub changes: Vec<Change>,
    /// The tolerance \[m\]: corners and edges at smaller distances were joined.
    pub tolerance: f64,
    /// The unit of the drawing.
    pub unit: Unit,
    /// The outlines and lines as they were drawn \[m\].
    pub(crate) drawn: Vec<Vec<Point2<f64>>>,
    /// The places of the blocks in the drawing.
    pub(crate) places: Vec<Place>,
    /// The number of supports, the last ones, that belong to the scene which names the drawing.
    pub(crate) supports_of_scene: usize,
    /// The assumptions that the scene needs and nobody gave.
    pub(crate) assumed: Vec<String>,
}
