//! Analyses of a scene: a single solution, a load history step by step, a limit load, and a study of the cost of
//! accuracy.

pub mod checkpoint;
mod clock;
pub mod limit;
pub mod outcome;
pub mod solve;
#[cfg(feature = "study")]
pub mod study;
