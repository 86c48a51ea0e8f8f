//! The part of a structure that moves in a mechanism: for instance, a facade does not collapse if a single brick
//! slides out.

use nalgebra::Vector2;

/// Threshold of motion, relative to the fastest block or joint \[-\]: slower ones contribute little to the failure of
/// the structure. Chosen.
pub const SLOW: f64 = 0.05;

/// Returns the largest rate of the corners of a block.
pub fn speed(rate: &[Vector2<f64>]) -> f64 {
    rate.iter().map(Vector2::norm).fold(0.0, f64::max)
}

/// Returns for each block whether it moves in a mechanism, from the rates of its corners.
pub fn moving(rates: &[Vec<Vector2<f64>>]) -> Vec<bool> {
    let speeds: Vec<f64> = rates.iter().map(|rate| speed(rate)).collect();
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    speeds.into_iter().map(|it| it > 0.0 && it >= SLOW * fastest).collect()
}
