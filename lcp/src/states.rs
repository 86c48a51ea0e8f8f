//! The problem in units of its own, the law of the state of a contact, and the linear system: shared by the methods for
//! contact that end with a state of every contact.

mod condensed;
mod law;
mod points;
mod scaled;

pub(crate) use condensed::{Condensed, PROXIMAL, Springs};
pub(crate) use law::nearest;
pub(crate) use points::Point;
pub(crate) use scaled::Scaled;

/// Displacements and forces in units of a [`Scaled`] problem.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointRef<'a> {
    pub(crate) u: &'a [f64],
    pub(crate) forces: &'a [(f64, f64)],
}
