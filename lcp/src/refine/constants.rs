//! The numbers that the refinement of states goes by, each with where it comes from.

use crate::vector::HALF_DIGITS;

/// How much passes hold on to what they start from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// Stiffness of a closed contact, relative to the bodies: a proximal step for forces, which redundant contacts
    /// need. The next pass closes the gaps that it leaves.
    pub(super) stiff: f64,
    /// Springs on all displacements, relative to the stiffness: a proximal step for bodies that nothing holds.
    pub(super) proximal: f64,
}

/// Weights that are tried one after the other. Theory: the first converge faster; rounding errors move free bodies far
/// against weak springs, and stiff contacts turn the rounding errors of such motions into forces.
pub(super) const WEIGHTS: [Weights; 2] =
    [Weights { stiff: 1.0 / HALF_DIGITS, proximal: 1e-10 }, Weights { stiff: 1e6, proximal: 1e-7 }];
/// Passes at most. Chosen.
pub(super) const PASSES: usize = 60;
/// Passes without a residual that falls, after which the residual is taken for an error of the data. Chosen.
pub(super) const PATIENCE: usize = 2;
/// Residuals that are rounding errors of double-double numbers. Rounding: the square of eps.
pub(crate) const ALL_DIGITS: f64 = f64::EPSILON * f64::EPSILON;
/// Residuals that are lost where the answer is rounded. Rounding: below half of eps.
pub(crate) const ROUNDED: f64 = f64::EPSILON / 4.0;
