//! The numbers that quadratic programs go by, each with where it comes from.

/// Tolerance of an interior point, whatever that of the answer. Theory: where both variables of a pair vanish it is
/// good to the root of this, and they must not be taken for some that do not.
pub(super) const INTERIOR: f64 = 1e-11;
/// A run that had half of the digits is on its way away from them once it is this many times farther off. Chosen: where the
/// tolerance is below what rounding errors allow, the iteration goes on and ends anywhere.
pub(super) const WORSE: f64 = 10.0;
/// Rounds without progress after which it is asked whether there is a solution at all, and times that larger bounds are
/// tried where none were large enough yet. Times that soft springs are centred anew and let go of nothing, after which they stay.
/// Chosen.
pub(super) const DOUBTS: usize = 4;
/// Rounds without progress after which there is no hope. Chosen.
pub(super) const IDLE: usize = 20;
