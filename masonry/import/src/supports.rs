//! Supports that touch blocks.

use nalgebra::Point2;

use super::fit::Fitted;
use super::sheet::Sheet;
use super::stones::Piece;
use masonry::geometry;
use masonry::scene::Support;
use masonry_drawing::Change;

/// The joint class of all supports.
pub(crate) const CLASS: &str = "support";

/// Distances below this part of the size of a block count as rounding errors, as for the joints of a model.
const TOUCHING: f64 = 1e-9;

/// Lengths below this part of the tolerance count as rounding errors.
const EXACT: f64 = 1e-6;

/// Removes the parts of supports that lie on other supports within the tolerance, so that no block is held twice. The
/// supports of a scene that names the drawing stay whole, and stay the last in the list.
pub(crate) fn without_overlaps(sheet: &mut Sheet) {
    let (of_scene, drawn): (Vec<Piece>, Vec<Piece>) =
        std::mem::take(&mut sheet.supports).into_iter().partition(|piece| piece.is_of_scene);
    let mut kept: Vec<Piece> = Vec::new();
    for piece in drawn {
        let mut rest = vec![piece.ends];
        for other in of_scene.iter().chain(&kept) {
            rest =
                rest.into_iter().flat_map(|it| beside(it, other.ends, sheet.tolerance)).collect();
        }
        if rest != [piece.ends] {
            let what = "parts of supports that lie on other supports were dropped";
            sheet.changes.push(Change::new(what, &piece.place));
        }
        kept.extend(rest.into_iter().map(|ends| Piece { ends, ..piece.clone() }));
    }
    kept.extend(of_scene);
    sheet.supports = kept;
}

/// Returns the parts of a segment that do not lie on another segment.
fn beside(
    ends: [Point2<f64>; 2],
    other: [Point2<f64>; 2],
    tolerance: f64,
) -> Vec<[Point2<f64>; 2]> {
    let whole = ends[1] - ends[0];
    let length = whole.norm();
    let along = whole / length;
    let place =
        |it: Point2<f64>| [(it - ends[0]).dot(&along), geometry::cross(along, it - ends[0])];
    let [mut first, mut last] = other.map(place);
    if last[0] < first[0] {
        std::mem::swap(&mut first, &mut last);
    }
    let [low, high] = [first[0].max(0.0), last[0].min(length)];
    if high - low <= TOUCHING * tolerance {
        return vec![ends];
    }
    let slope = (last[1] - first[1]) / (last[0] - first[0]);
    let is_on = |at: f64| (first[1] + slope * (at - first[0])).abs() <= tolerance;
    if slope.abs() > 1.0 || !is_on(low) || !is_on(high) {
        return vec![ends];
    }
    let mut parts = Vec::new();
    if low > EXACT * tolerance {
        parts.push([ends[0], ends[0] + along * low]);
    }
    if length - high > EXACT * tolerance {
        parts.push([ends[0] + along * high, ends[1]]);
    }
    parts
}

/// Returns the supports on which blocks rest, each with a unique name; drops the other supports.
pub(crate) fn used(sheet: &mut Sheet, fitted: &Fitted) -> Vec<(Support, Piece)> {
    let mut used: Vec<(Support, Piece)> = Vec::new();
    let mut taken = std::collections::BTreeMap::new();
    for (k, piece) in std::mem::take(&mut sheet.supports).into_iter().enumerate() {
        let mortar = fitted.grown.supports.get(&k).copied();
        if mortar.is_none() && !touches(sheet, &piece, fitted.grown.open) {
            let what = "sides of supports that touch no block were dropped";
            sheet.changes.push(Change::new(what, &piece.place));
            continue;
        }
        let number = taken.entry(piece.name.clone()).and_modify(|it| *it += 1).or_insert(1_u32);
        let name = match number {
            1 => piece.name.clone(),
            _ => format!("{} {number}", piece.name),
        };
        let class = match mortar {
            Some(true) => "bed",
            Some(false) => "head",
            None => CLASS,
        };
        let [from, to] = piece.ends.map(|end| [end.x, end.y]);
        used.push((Support::new(&name, from, to, class), piece));
    }
    used
}

/// Whether a block lies on a support directly, or across a gap of at most `gap` \[m\] that stays open.
fn touches(sheet: &Sheet, piece: &Piece, gap: f64) -> bool {
    let [from, to] = piece.ends;
    sheet.stones.iter().any(|stone| {
        let slack = TOUCHING * geometry::size(&stone.corners);
        let edges = (0..stone.corners.len()).map(|k| geometry::edge(&stone.corners, k));
        edges.into_iter().any(|edge| {
            let meets = |line| geometry::facing_overlap(edge, line, slack, gap).is_some();
            meets([from, to]) || meets([to, from])
        })
    })
}
