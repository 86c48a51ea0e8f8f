//! From a point to the states of its contacts and their exact equations, and the best point so far.

mod constants;
mod crossover;
mod original;
mod search;

pub(crate) use crossover::Effort;
#[cfg(feature = "clarabel")]
pub(crate) use crossover::cross_over;
pub(crate) use original::{Original, state_brought_right};
pub(crate) use search::{Search, unplanned};
