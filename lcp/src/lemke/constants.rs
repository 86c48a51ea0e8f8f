//! The numbers that Lemke's method uses, each with its origin. A number that is "chosen" is set by judgement: no
//! measurement is kept.

/// Numbers below this part of their scale are zero: entries of the entering column and reduced costs relative to the
/// largest one, the part of a column outside the span of others, and the artificial variable relative to its first
/// value (it leaves). The same number bounds the drift of basic values or of a column against the start data for which
/// the tableau is kept, and the residual of the values of a factorised basis, and is the tolerance of answers. Entries
/// of an equilibrated inverse beyond its reciprocal reveal a nearly singular basis. Measured on 25 problems in five
/// scalings, all solved, and on walls: with 1e-12 for the artificial variable the path runs past the solution onto
/// false rays, with 1e-9 it stops early with residuals of 1e-10.
pub(super) const VANISHING: f64 = 1e-10;
/// A step may bring basic variables this far below zero, relative to the largest; a step that moves no variable by more
/// makes no breakpoint of a parametric path. Chosen: above the rounding errors of values.
pub(super) const TIE_WINDOW: f64 = 1e-12;
/// Up to this order bases of sparse problems are searched with dense matrices if columns alone give no basis, and
/// enlarged. Chosen: memory and time are small.
pub(super) const DENSE_SEARCH: usize = 2000;
/// The least factor by which an exchange must enlarge the determinant. Chosen: above rounding, so that exchanges end.
pub(super) const GAIN: f64 = 1.0 + 1e-6;
/// Number of passes through all pairs for such exchanges. Chosen.
pub(super) const GAIN_SWEEPS: usize = 8;
/// Pivots of at least this part of their column are sound enough for another start basis. Measured on 40 planted
/// problems of each of the orders 20 to 50: 0.01, 0.03 and 0.1 take equally many pivots, 0.3 takes up to five times as
/// many.
pub(super) const SOUND_PIVOT: f64 = 1e-2;
/// Average number of pairs of a sparse problem that are drawn for a start basis. Chosen: each pair costs some solves.
pub(super) const MANY_FLIPS: f64 = 500.0;

/// Largest number of pivots, divided by the order of the problem, of the path of every pair of a game in the first
/// round. Measured on a game of 228 pairs: the path of pair 0 takes more than a hundred, that of pair 1 takes eight.
pub(super) const FIRST_ROUND: usize = 10;
/// Least number of attempts, and the last attempt that may start from the last basis again, with another covering
/// vector. Theory: all kinds of [`Trial::after`](super::trial::Trial::after), with some of the random kind. Measured on
/// a published problem of 1056 pairs in other units: the seventh attempt finds the solution, with two pivots.
pub(super) const KINDS: usize = 12;
/// Attempts go on while their pivots have changed fewer entries of tableaus of the order of the problem; a new start
/// basis counts as a tableau with as many pivots as the order. Measured: this number takes four seconds, and gives the
/// solutions of most random indefinite problems of order 60.
pub(super) const WORK: usize = 4_000_000_000;
/// Fixed cost of an attempt in the unit of [`WORK`]. Measured: 40 microseconds.
pub(super) const ATTEMPT: usize = 40_000;
/// Number of dense matrices of the order of the problem in memory at the peak. Measured.
pub(super) const MATRICES: usize = 5;
/// Number of random right-hand sides of rounding size whose solutions show which entries are rounding errors. Chosen.
pub(super) const SAMPLES: u64 = 5;
/// The size of these right-hand sides, relative to the terms. Rounding: a few eps.
pub(super) const LEVEL: f64 = 8.0 * f64::EPSILON;
