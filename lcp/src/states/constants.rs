//! The numbers that the linear system of a step goes by.
//!
//! Each says where it comes from: what was measured, what the theory asks for, or the rounding errors that it
//! stands for. "Chosen" is by judgement: no measurement of it is kept.

/// Springs on every displacement that keep bodies without contact in place during a step, relative to the
/// stiffness. Measured on walls: floating bricks stay nonsingular.
pub(crate) const PROXIMAL: f64 = 1e-12;
/// Steps of iterative refinement. Chosen.
pub(super) const REFINEMENTS: usize = 2;
/// The residual, relative to the right-hand side, that needs none. Measured on walls: 1e-7 would save a sixth of
/// the time far from the solution, with the same steps.
pub(super) const ENOUGH: f64 = 1e-11;
