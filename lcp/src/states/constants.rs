//! The numbers that the linear system of a step goes by, each with where it comes from.
//! A number that is "chosen" is so by judgement: no measurement is kept.

/// Springs on every displacement that keep bodies without contact in place during a step, relative to the stiffness.
/// Measured on walls: floating bricks stay nonsingular.
pub(crate) const PROXIMAL: f64 = 1e-12;
/// The residual, relative to the right-hand side, that needs none. Measured on walls: 1e-7 would save a sixth of the
/// time far from the solution, with the same steps.
pub(super) const ENOUGH: f64 = 1e-11;
