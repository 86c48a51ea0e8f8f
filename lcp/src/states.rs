//! What methods for contact share that come down to a state of every contact: the problem in units of its own, the
//! law of a state, and the linear system.

mod condensed;
mod constants;
mod law;
mod points;
mod scaled;

pub(crate) use condensed::{Condensed, Springs};
pub(crate) use constants::PROXIMAL;
pub(crate) use law::nearest;
pub(crate) use points::Point;
pub(crate) use scaled::Scaled;

/// Displacements and forces in units of a [`Scaled`] problem.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointRef<'a> {
    pub(crate) u: &'a [f64],
    pub(crate) forces: &'a [(f64, f64)],
}
