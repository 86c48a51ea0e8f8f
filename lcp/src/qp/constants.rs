//! The numbers that quadratic programs use, each with its origin.

/// Tolerance of an interior point, whatever the tolerance of the answer. Theory: variables of a pair that both vanish
/// are accurate to the root of this number, and must not be mistaken for variables that do not vanish.
pub(super) const INTERIOR: f64 = 1e-11;
/// A run with half of the digits counts as diverging once its error is this many times larger. Chosen: the
/// iteration goes on and ends anywhere if the tolerance is below the rounding errors.
pub(super) const WORSE: f64 = 10.0;
/// Rounds without progress before the search for a proof that there is no solution; number of increases of bounds that
/// are too small; and number of re-centrings of soft springs without progress, after which the springs stay. Chosen.
pub(super) const DOUBTS: usize = 4;
/// Rounds without progress after which the method stops. Chosen.
pub(super) const IDLE: usize = 20;
