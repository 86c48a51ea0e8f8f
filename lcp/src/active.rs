//! What methods for contact share that come down to a state of every contact: the problem in units of its own,
//! the linear system, exchanges of states, and the best point so far.

mod condensed;
mod crossover;
mod original;
mod scaled;
mod search;

pub(crate) use condensed::{Condensed, Springs};
pub(crate) use crossover::{Effort, cross_over, nearest};
pub(crate) use original::{Original, state_brought_right};
pub(crate) use scaled::{Point, Scaled};
pub(crate) use search::Search;

/// Springs on every displacement that keep bodies without contact in place during a step, relative to the
/// stiffness.
pub(crate) const PROXIMAL: f64 = 1e-12;
