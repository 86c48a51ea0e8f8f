//! What methods for contact share that come down to a state of every contact: the problem in units of its own, the
//! law of a state, and the linear system.

mod condensed;
mod law;
mod scaled;

pub(crate) use condensed::{Condensed, Springs};
pub(crate) use law::nearest;
pub(crate) use scaled::{Point, Scaled};

/// Springs on every displacement that keep bodies without contact in place during a step, relative to the
/// stiffness.
pub(crate) const PROXIMAL: f64 = 1e-12;
