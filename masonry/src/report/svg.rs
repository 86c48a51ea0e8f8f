//! Pictures as SVG: the scene, principal stresses, the deformed structure, forces in joints, cracks, a mechanism, diagrams.
//!
//! Every function returns the text of a whole file, with the legend outside the drawing. Numbers have a fixed count of digits, so that equal input gives equal bytes.

mod canvas;
mod cracks;
mod deformed;
#[cfg(feature = "study")]
pub mod diagram;
mod forces;
mod labels;
mod loads;
mod marks;
mod mechanism;
mod scene;
mod sheet;
mod stresses;

pub use cracks::cracks;
pub use deformed::deformed;
pub use forces::forces;
pub use mechanism::mechanism;
pub use scene::scene;
pub use stresses::{ReferenceLines, principal_stresses};
