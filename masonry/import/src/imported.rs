//! The result of importing a drawing.

use nalgebra::Point2;

use masonry::scene::Scene;
use masonry_drawing::{Change, Place, Unit};

/// A scene made from a drawing, with a record of all changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The scene, which is valid as a model.
    pub scene: Scene,
    /// The parts of the drawing that were changed or left out, with distances in metres.
    pub changes: Vec<Change>,
    /// The tolerance \[m\]: corners and edges at smaller distances from each other were joined.
    pub tolerance: f64,
    /// The unit of length of the drawing.
    pub unit: Unit,
    /// The outlines and lines before all changes \[m\].
    pub(crate) drawn: Vec<Vec<Point2<f64>>>,
    /// The places of the blocks in the drawing.
    pub(crate) places: Vec<Place>,
    /// The number of supports of the scene that names the drawing; they are the last supports of the list.
    pub(crate) supports_of_scene: usize,
    /// The assumptions that the scene needs, since neither the drawing nor the options have the values.
    pub(crate) assumed: Vec<String>,
}
