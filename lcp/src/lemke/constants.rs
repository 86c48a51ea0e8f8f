//! The numbers that Lemke's method goes by, each with where it comes from.
//! A number that is "chosen" is so by judgement: no measurement is kept.

/// Numbers below this part of their scale are zero: entries of the entering column and reduced costs beside the largest
/// one, the part of a column outside the span of others, the artificial variable beside its first value (it leaves),
/// the drift of
/// basic values or of a column against the start data, with which the tableau stays, and the residual of the values of a
/// factorised basis. Entries of an equilibrated inverse beyond its reciprocal betray a nearly singular basis. The tolerance of
/// answers. Measured on 25 problems in five scalings, all solved, and on walls: an artificial variable of 1e-12 runs past the
/// solution onto false rays, one of 1e-9 stops early with residuals of 1e-10.
pub(super) const VANISHING: f64 = 1e-10;
/// A step may bring basic variables this far below zero, relative to the largest; one that moves no variable by more
/// makes no breakpoint of a parametric path. Chosen: above the rounding errors of values.
pub(super) const TIE_WINDOW: f64 = 1e-12;
/// Up to this order bases of sparse problems are searched with dense matrices where columns alone give none, and
/// enlarged. Chosen: memory and time are small.
pub(super) const DENSE_SEARCH: usize = 2000;
/// An exchange that makes the determinant larger by less is none. Chosen: above rounding, so that exchanges end.
pub(super) const GAIN: f64 = 1.0 + 1e-6;
/// Times that all pairs are gone through for such exchanges. Chosen.
pub(super) const GAIN_SWEEPS: usize = 8;
/// Pivots of at least this part of their column are sound enough for another start basis. Measured on 40 planted problems of
/// each of the orders 20 to 50: 0.01, 0.03 and 0.1 take as many pivots, 0.3 takes up to five times as many.
pub(super) const SOUND_PIVOT: f64 = 1e-2;
/// Pairs of a sparse problem that are drawn for one, on average. Chosen: each costs some solves.
pub(super) const MANY_FLIPS: f64 = 500.0;

/// Pivots by the order of the problem that the path of every pair of a game may take at first. Measured on a game of 228 pairs:
/// the path of pair 0 takes more than a hundred, that of pair 1 takes eight.
pub(super) const FIRST_ROUND: usize = 10;
/// Attempts at least, and those up to which the last basis is started from again, with another covering vector. Theory: all
/// kinds of [`Trial::after`](super::trial::Trial::after), with some of the one that chance decides. Measured on a published
/// problem of 1056 pairs in other units: the seventh attempt finds the solution, with two pivots.
pub(super) const KINDS: usize = 12;
/// Attempts go on while their pivots have changed fewer entries of tableaus of the order of the problem; a new start basis
/// counts as a tableau with as many pivots as the order. Measured: that takes four seconds, and finds the solutions of most
/// random indefinite problems of order 60.
pub(super) const WORK: usize = 4_000_000_000;
/// Fixed cost of an attempt in the unit of [`WORK`]. Measured: 40 microseconds.
pub(super) const ATTEMPT: usize = 40_000;
/// Dense matrices of the order of the problem at the peak. Measured.
pub(super) const MATRICES: usize = 5;
/// Random right-hand sides of the size of rounding errors that are solved for to see which entries are rounding errors. Chosen.
pub(super) const SAMPLES: u64 = 5;
/// Their size, relative to the terms. Rounding: a few eps.
pub(super) const LEVEL: f64 = 8.0 * f64::EPSILON;
