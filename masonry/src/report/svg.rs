//! Pictures as SVG: the scene, principal stresses, the deformed structure, forces in joints, cracks, a mechanism, curves
//! of load histories, diagrams.
//!
//! Every function returns the text of a whole file, with the legend outside the drawing. Numbers have a fixed count of digits, so that equal input gives equal bytes.

mod canvas;
mod cracks;
mod deformed;
pub mod diagram;
mod dimensions;
mod forces;
mod history;
mod labels;
mod loads;
mod marks;
mod materials;
mod mechanism;
mod names;
mod path;
pub(super) mod pictures;
mod scene;
mod sheet;
mod stresses;
mod style;

pub(super) use canvas::escape as escaped;
pub use cracks::cracks;
pub use deformed::deformed;
pub use forces::forces;
pub(super) use history::curves;
pub use history::history;
pub(super) use marks::counted;
pub use mechanism::mechanism;
pub(super) use mechanism::mechanism_on_page;
pub use path::path;
pub use scene::scene;
pub use stresses::{ReferenceLines, principal_stresses};
