//! Blocks, supports and marked joints of a drawing, in metres.

use nalgebra::Point2;

use super::near;
use super::{ImportError, ImportErrorKind};
use masonry::geometry::{self, PolygonError};
use masonry_drawing::{Change, Place};

/// A block of the drawing, in metres.
#[derive(Debug, Clone)]
pub(crate) struct Stone {
    pub(crate) name: Option<String>,
    pub(crate) material: String,
    pub(crate) corners: Vec<Point2<f64>>,
    pub(crate) place: Place,
}

/// A straight piece of a line on a layer of supports or joints, or an edge of an outline that is fixed.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    /// The name of the support, or the class of the joint.
    pub(crate) name: String,
    pub(crate) ends: [Point2<f64>; 2],
    pub(crate) place: Place,
    /// Whether the piece is a support of the scene that names the drawing.
    pub(crate) is_of_scene: bool,
}

/// Returns the corners of each stone.
pub(crate) fn shapes(stones: &[Stone]) -> Vec<&[Point2<f64>]> {
    stones.iter().map(|stone| &stone.corners[..]).collect()
}

/// Finds the pairs of stones whose boxes are nearer to each other than `reach`.
pub(crate) fn near_pairs(stones: &[Stone], reach: f64) -> Result<Vec<[usize; 2]>, ImportError> {
    let crowded = |k: usize| ImportErrorKind::Crowded.at(&[&stones[k].place]);
    near::pairs(&shapes(stones), reach).map_err(crowded)
}

/// Drops duplicate stones: each corner of the stone lies near a corner of an earlier stone, and vice versa.
pub(crate) fn without_duplicates(
    stones: &mut Vec<Stone>,
    tolerance: f64,
    changes: &mut Vec<Change>,
) -> Result<(), ImportError> {
    let mut is_again = vec![false; stones.len()];
    for [first, second] in near_pairs(stones, tolerance)? {
        let [a, b] = [first, second].map(|k| &stones[k].corners);
        if !is_again[first] && covers(a, b, tolerance) && covers(b, a, tolerance) {
            is_again[second] = true;
        }
    }
    let mut again = is_again.into_iter();
    stones.retain(|stone| {
        let is_again = again.next().unwrap_or(false);
        if is_again {
            changes.push(Change::new("blocks drawn twice were dropped", &stone.place));
        }
        !is_again
    });
    Ok(())
}

/// Whether each corner of `other` is near a corner of `one`.
fn covers(one: &[Point2<f64>], other: &[Point2<f64>], tolerance: f64) -> bool {
    other.iter().all(|corner| one.iter().any(|it| (it - corner).norm() <= tolerance))
}

/// Refuses blocks whose edges cross or touch each other, and notes blocks that are not convex.
pub(crate) fn check_simple(stones: &[Stone], changes: &mut Vec<Change>) -> Result<(), ImportError> {
    for stone in stones {
        match geometry::check_simple(&stone.corners) {
            Ok(()) => {}
            Err(PolygonError::NoWidth(corner)) => {
                let [x, y] = stone.corners[corner].coords.into();
                let [x, y] = [x, y].map(|it: f64| super::report::metres(it));
                return Err(ImportErrorKind::NoWidth { x, y }.at(&[&stone.place]));
            }
            Err(_) => return Err(ImportErrorKind::Crossing.at(&[&stone.place])),
        }
        if geometry::check_convex(&stone.corners).is_err() {
            let what = "blocks with a corner that points inwards are one rigid body each";
            changes.push(Change::new(what, &stone.place));
        }
    }
    Ok(())
}
