//! Pictures as SVG: the scene, principal stresses, the deformed structure, forces in joints, cracks, a mechanism,
//! curves of load histories, and diagrams.
//!
//! Every function returns the text of a whole file. The legend is outside the drawing. Numbers have at most two
//! decimals, so that equal input gives equal bytes.

mod arrows;
mod axis;
mod bond_lines;
mod canvas;
mod cracks;
mod deformed;
pub mod diagram;
mod dimensions;
mod forces;
mod history;
mod labels;
mod legend;
mod mechanism;
mod motion;
mod names;
pub mod pictures;
mod scene;
mod sheet;
mod stresses;
mod structure;
mod style;

pub(super) use arrows::Growth;
pub use bond_lines::ReferenceLines;
pub(super) use canvas::escape as escaped;
pub use cracks::{cracks, cracks_or_none};
pub use deformed::deformed;
pub use forces::forces;
pub(super) use history::train;
pub use history::{history, path};
pub use mechanism::mechanism;
pub(super) use mechanism::{Collapse, collapse};
pub use scene::scene;
pub use stresses::principal_stresses;
pub(super) use structure::counted;
pub(super) use style::STYLE;
