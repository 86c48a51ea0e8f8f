//! Supports that blocks touch.

use super::fit::Fitted;
use super::sheet::Sheet;
use super::stones::Piece;
use masonry::geometry;
use masonry::scene::Support;
use masonry_drawing::Change;

/// The class of the joints of supports.
pub(crate) const CLASS: &str = "support";

/// Distances below this part of a block are rounding errors, as for the joints of a model.
const TOUCHING: f64 = 1e-9;

/// Supports on which blocks rest, each with a name of its own; the others are dropped.
pub(crate) fn used(sheet: &mut Sheet, fitted: &Fitted) -> Vec<(Support, Piece)> {
    let mut used: Vec<(Support, Piece)> = Vec::new();
    let mut taken = std::collections::BTreeMap::new();
    for (k, piece) in std::mem::take(&mut sheet.supports).into_iter().enumerate() {
        let mortar = fitted.grown.supports.get(&k).copied();
        if mortar.is_none() && !touches(sheet, &piece) {
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

fn touches(sheet: &Sheet, piece: &Piece) -> bool {
    let [from, to] = piece.ends;
    sheet.stones.iter().any(|stone| {
        let slack = TOUCHING * geometry::size(&stone.corners);
        let edges = (0..stone.corners.len()).map(|k| geometry::edge(&stone.corners, k));
        edges.into_iter().any(|edge| {
            let meets = |line| geometry::facing_overlap(edge, line, slack, 0.0).is_some();
            meets([from, to]) || meets([to, from])
        })
    })
}
