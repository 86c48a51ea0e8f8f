//! Words for the part of a structure that moves in a mechanism.

use nalgebra::Vector2;

use masonry::model::Model;
use masonry::verify::moving::{moving, speed};

/// Returns the number of moving blocks and the name of the fastest block, in words.
pub(super) fn moving_part(model: &Model, rates: &[Vec<Vector2<f64>>]) -> String {
    let speeds = rates.iter().map(|rate| speed(rate));
    let Some((_, block)) = speeds.zip(&model.blocks).max_by(|a, b| a.0.total_cmp(&b.0)) else {
        return "no block".to_owned();
    };
    let count = moving(rates).into_iter().filter(|moves| *moves).count();
    let part = match (count, rates.len()) {
        (1, 1) => return format!("block \"{}\"", block.name),
        (count, all) if count == all => format!("all {all} blocks"),
        (1, all) => return format!("block \"{}\" alone, of {all}", block.name),
        (count, all) => format!("{count} of {all} blocks"),
    };
    format!("{part}, \"{}\" fastest", block.name)
}
