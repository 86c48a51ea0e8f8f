//! The numbers that the refinement of states uses, each with its origin.

use crate::vector::HALF_DIGITS;

/// The weights by which passes keep near to their start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// Stiffness of a closed contact, relative to the bodies: a proximal step for forces, which redundant contacts
    /// need. The remaining gaps are closed by the next pass.
    pub(super) stiff: f64,
    /// Springs on all displacements, relative to the stiffness: a proximal step for bodies that nothing holds.
    pub(super) proximal: f64,
}

/// Weights that are tried one after the other. Theory: the first converge faster; rounding errors move free bodies far
/// against weak springs, and stiff contacts turn the rounding errors of such motions into forces.
pub(super) const WEIGHTS: [Weights; 2] =
    [Weights { stiff: 1.0 / HALF_DIGITS, proximal: 1e-10 }, Weights { stiff: 1e6, proximal: 1e-7 }];
/// Largest number of passes. Chosen.
pub(super) const PASSES: usize = 60;
/// Passes without a decrease of the residual, after which the residual counts as an error of the data. Chosen.
pub(super) const PATIENCE: usize = 2;
/// Residuals that are rounding errors of double-double numbers. Rounding: the square of eps.
pub(crate) const ALL_DIGITS: f64 = f64::EPSILON * f64::EPSILON;
/// Residuals that are lost when the answer is rounded. Rounding: below half of eps.
pub(crate) const ROUNDED: f64 = f64::EPSILON / 4.0;
