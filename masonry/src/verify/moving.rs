//! The part of a structure that moves in a mechanism: a brick that slides out is no collapse of a facade.

use nalgebra::Vector2;

/// Blocks and joints slower than this part of the fastest have little to do with how the structure fails. Chosen.
pub const SLOW: f64 = 0.05;

/// The largest rate of the corners of a block.
pub fn speed(rate: &[Vector2<f64>]) -> f64 {
    rate.iter().map(Vector2::norm).fold(0.0, f64::max)
}

/// Which blocks move in a mechanism, by the rates of their corners.
pub fn moving(rates: &[Vec<Vector2<f64>>]) -> Vec<bool> {
    let speeds: Vec<f64> = rates.iter().map(|rate| speed(rate)).collect();
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    speeds.into_iter().map(|it| it > 0.0 && it >= SLOW * fastest).collect()
}
