//! The numbers that exchanges of states go by beside their [`Effort`](super::Effort), each with where it comes from.
//! A number that is "chosen" is so by judgement: no measurement is kept.

/// Steps of refinement. Chosen.
pub(super) const REFINEMENTS: usize = 12;
/// Contradictions smaller than this part of the largest are left to what its exchange makes of them. Chosen.
pub(super) const LARGE: f64 = 0.01;
/// A largest contradiction below this part of those before is progress, as a smaller number is. Chosen.
pub(super) const SMALLER: f64 = 0.1;
