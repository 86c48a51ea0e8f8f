//! The step from a point to the states of its contacts and their exact equations, and the best
//! point so far.

mod crossover;
mod original;
mod search;

pub(crate) use crossover::Effort;
pub(crate) use original::Original;
pub(crate) use search::{Search, unplanned};
