//! The part of a structure that moves in a mechanism: a brick that slides out is no collapse of a facade.

use nalgebra::Vector2;

use crate::model::Model;

/// Blocks and joints slower than this part of the fastest have little to do with how the structure fails. Chosen.
pub(super) const SLOW: f64 = 0.05;

/// The largest rate of the corners of a block.
pub(super) fn speed(rate: &[Vector2<f64>]) -> f64 {
    rate.iter().map(Vector2::norm).fold(0.0, f64::max)
}

/// How many blocks move, and which one is the fastest.
pub(super) fn moving_part(model: &Model, rates: &[Vec<Vector2<f64>>]) -> String {
    let speeds: Vec<f64> = rates.iter().map(|rate| speed(rate)).collect();
    let blocks = speeds.iter().zip(&model.blocks);
    let Some((fastest, block)) = blocks.max_by(|a, b| a.0.total_cmp(b.0)) else {
        return "no block".to_owned();
    };
    let count = speeds.iter().filter(|it| **it >= SLOW * fastest).count();
    let part = match (count, speeds.len()) {
        (1, 1) => return format!("block \"{}\"", block.name),
        (count, all) if count == all => format!("all {all} blocks"),
        (1, all) => return format!("block \"{}\" alone, of {all}", block.name),
        (count, all) => format!("{count} of {all} blocks"),
    };
    format!("{part}, \"{}\" fastest", block.name)
}
