//! The part of a structure that moves in a mechanism: a facade does not collapse if a brick slides out.

use nalgebra::Vector2;

/// Blocks and joints slower than this part of the fastest contribute little to the failure of the structure.
/// Chosen.
pub const SLOW: f64 = 0.05;

/// The largest rate of the corners of a block.
pub fn speed(rate: &[Vector2<f64>]) -> f64 {
    rate.iter().map(Vector2::norm).fold(0.0, f64::max)
}

/// Whether each block moves in a mechanism, by the rates of its corners.
pub fn moving(rates: &[Vec<Vector2<f64>>]) -> Vec<bool> {
    let speeds: Vec<f64> = rates.iter().map(|rate| speed(rate)).collect();
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    speeds.into_iter().map(|it| it > 0.0 && it >= SLOW * fastest).collect()
}
