//! Analyses of a scene: one solution, a load history step by step, a study of the cost of accuracy.

pub mod checkpoint;
pub mod outcome;
pub mod solve;
#[cfg(feature = "study")]
pub mod study;
