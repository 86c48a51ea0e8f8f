//! Options of the import of a drawing.

use masonry_drawing::Unit;

/// The treatment of joints that are drawn open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joints {
    /// Gaps of one width are filled with mortar.
    Mortar,
    /// Blocks grow until they meet.
    Close,
    /// Gaps stay.
    Open,
}

/// Options of the import of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportOptions {
    /// The title of the scene.
    pub title: String,
    /// The unit of the drawing, in place of that of the file.
    pub unit: Option<Unit>,
    /// Factor of all lengths.
    pub scale: f64,
    /// The distance up to which corners and edges are joined \[m\]; by default a part of the shortest edge.
    pub tolerance: Option<f64>,
    /// Thickness out of the plane \[m\]; by default that of the bodies of the file, or one metre.
    pub thickness: Option<f64>,
    /// The treatment of joints that are drawn open; `None` makes them an error.
    pub joints: Option<Joints>,
    /// Density of the blocks \[kg/m^3\].
    pub density: f64,
    /// Coefficient of friction of all joints.
    pub mu: f64,
    /// Layers that are left out.
    pub ignore: Vec<String>,
}

impl Default for ImportOptions {
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
