//! The numbers that the active set method goes by, each with where it comes from.
//! What is "chosen" is so by judgement: no measurement is kept.

use crate::active::Effort;

/// Steps without fewer negative variables than ever before, after which fewer pairs are exchanged. Chosen.
pub(super) const PATIENCE: usize = 10;
/// The same once fewer than all are exchanged. Chosen.
pub(super) const REDUCED_PATIENCE: usize = 4;
/// Pivots, and right-hand sides, below this relative to the terms that they come from are rounding errors. Rounding:
/// errors of long sums.
pub(super) const VANISHING: f64 = 1024.0 * f64::EPSILON;
/// Signs below this, relative to the terms of their row, are rounding errors. Rounding: errors of short sums.
pub(super) const NOISE: f64 = 64.0 * f64::EPSILON;
/// Largest residual, relative to the terms of its row, of a system that counts as solved. Chosen.
pub(super) const USABLE: f64 = 1e-6;
/// A variable below this, relative to the largest, may be one that vanishes. Chosen.
pub(super) const MAY_VANISH: f64 = 1e-11;
/// Residuals that a step of refinement would not decrease. Rounding: a few eps.
pub(super) const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Steps of refinement at most. Chosen.
pub(super) const REFINEMENTS: usize = 3;

/// The line search ends where the work of what is unbalanced is this part of that at its start. Chosen.
pub(super) const FLAT: f64 = 0.1;
/// Points that it tries at most. Chosen.
pub(super) const TRIALS: usize = 12;
/// It leaves out this part of the interval at both of its ends. Chosen: the usual safeguard of interpolation.
pub(super) const MARGIN: f64 = 0.1;
/// Stiffness of the contacts that are glued together at the start, and the springs that hold what they do not,
/// relative to the stiffness of the bodies, as all that follow. Chosen.
pub(super) const GLUE: (f64, f64) = (1e4, 1e-4);
/// Stiffness of the contacts in the first round. Theory: stiffer ones come nearer in a round, but with friction the
/// matrix of a step is positive definite only where they are not much stiffer than the bodies.
pub(super) const STIFFNESS: f64 = 3.0;
/// The least that failures make of it. Chosen: that of the bodies.
pub(super) const LEAST_STIFFNESS: f64 = 1.0;
/// The most that rounds make of it. Chosen.
pub(super) const MOST_STIFFNESS: f64 = 1e6;
/// Factor by which a round makes contacts stiffer or softer. Chosen.
pub(super) const STIFFER: f64 = 3.0;
/// Springs on all displacements in the first round. Chosen.
pub(super) const SPRING: f64 = 0.01;
/// Springs on all displacements at least. Chosen.
pub(super) const LEAST_SPRING: f64 = 1e-10;
/// Factor by which a round makes them softer. Chosen.
pub(super) const SOFTER: f64 = 0.1;
/// Factor by which a round that failed makes them stiffer. Chosen.
pub(super) const HARDER: f64 = 3.0;
/// Steps of a round at most. Chosen.
pub(super) const STEPS: usize = 12;
/// A round of so few steps is followed by one with stiffer contacts. Chosen.
pub(super) const FEW: usize = 4;
/// Part of the unbalanced forces at its start that a round may leave to the next. Chosen.
pub(super) const INEXACT: f64 = 0.01;
/// Rounds at most. Chosen.
pub(super) const ROUNDS: usize = 40;
/// Rounds that may fail one after the other. Chosen.
pub(super) const FAILURES: usize = 10;
/// A residual above this is more than rounding: states fit the tolerance and not each other. Rounding: some hundred
/// eps.
pub(super) const EXACT: f64 = 1e-13;
/// Rounds more that such states may take to better ones. Chosen.
pub(super) const MORE: usize = 3;
/// Exchanges of states after a round: as long as there are fewer contradictions every time, or nearly. Chosen.
pub(super) const EXCHANGES: Effort =
    Effort { rounds: 20, patience: 1, points: 50, ..Effort::THOROUGH };
