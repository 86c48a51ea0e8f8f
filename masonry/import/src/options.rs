//! Options of the import of a drawing.

use masonry_drawing::Unit;

/// The treatment of joints that are drawn open, with gaps between blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joints {
    /// Gaps of one width are filled with mortar.
    Mortar,
    /// Blocks grow until they meet.
    Close,
    /// Gaps stay open.
    Open,
}

/// Options of the import of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportOptions {
    /// The title of the new scene.
    pub title: String,
    /// The unit of the drawing, instead of the unit in the file; `None` uses that of the file.
    pub unit: Option<Unit>,
    /// Factor by which all lengths of the drawing are multiplied.
    pub scale: f64,
    /// The distance up to which corners and edges are joined \[m\]; by default a part of the shortest edge.
    pub tolerance: Option<f64>,
    /// Thickness of the blocks out of the plane \[m\]; by default that of the bodies in the file, or one metre.
    pub thickness: Option<f64>,
    /// The treatment of joints that are drawn open; without a value, such joints are an error.
    pub joints: Option<Joints>,
    /// Density of the blocks \[kg/m^3\].
    pub density: f64,
    /// Coefficient of friction of all joints.
    pub mu: f64,
    /// Names of layers that are left out.
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
            // Chosen: limestone, and the friction of sawn stone; the scene lists both as assumptions.
            density: 2000.0,
            mu: 0.6,
            ignore: Vec::new(),
        }
    }
}
