//! Pictures as SVG: the scene, principal stresses, the deformed structure, a mechanism,
//! and diagrams of a study.
//!
//! Every function returns the text of a whole file, 900 units wide, with the legend outside the
//! drawing. Numbers have a fixed count of digits, so that equal input gives equal bytes.

mod canvas;
mod deformed;
mod diagram;
mod loads;
mod marks;
mod mechanism;
mod scene;
mod sheet;
mod stresses;
mod study;

pub use deformed::deformed;
pub use mechanism::mechanism;
pub use scene::scene;
pub use stresses::{ReferenceLines, principal_stresses};
pub use study::{accuracy, digits, mesh, sizes, springs};
