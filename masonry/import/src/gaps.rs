//! Joints that are drawn open: the edges of blocks move outwards until blocks meet, and move back again if mortar lies
//! between the blocks.

use std::collections::BTreeMap;

use nalgebra::Point2;

use super::report::metres;
use super::sheet::Sheet;
use super::size::{self, median};
use super::stones::near_pairs;
use super::{ImportError, ImportErrorKind, Joints};
use masonry::geometry;
use masonry_drawing::Change;

/// The widest gap between blocks that counts as a joint, divided by the shortest edge. Chosen: joints of 10 mm beside
/// bricks of 52 mm have a fifth; wider gaps are openings.
const WIDEST: f64 = 0.35;

/// An edge of a stone: the index of the stone, and the index of the edge.
type Edge = (usize, usize);

/// A gap between an edge of a stone and an edge of another stone, or a support.
struct Gap {
    edges: [Option<Edge>; 2],
    support: Option<usize>,
    /// The two stones; twice the same stone at a support.
    stones: [usize; 2],
    width: f64,
    length: f64,
    is_bed: bool,
}

/// The edges that were moved outwards, and the thicknesses of mortar.
#[derive(Debug, Default)]
pub(crate) struct Grown {
    edges: Vec<(Edge, f64)>,
    /// The thickness of mortar in bed joints \[m\]; `None` without mortar.
    pub(crate) bed: Option<f64>,
    /// The thickness of mortar in head joints \[m\]; `None` without mortar.
    pub(crate) head: Option<f64>,
    /// The widest gap that stays open \[m\].
    pub(crate) open: f64,
    /// Indices of supports below mortar, each with whether the joint at the support is a bed joint.
    pub(crate) supports: BTreeMap<usize, bool>,
}

/// Moves the edges along open joints outwards, so that blocks meet in the middle of the joints.
///
/// # Errors
/// Joints are open and no option gives their meaning, or no single thickness of mortar fits them.
pub(crate) fn grow(sheet: &mut Sheet, joints: Option<Joints>) -> Result<Grown, ImportError> {
    let gaps = gaps(sheet, sheet.tolerance)?;
    if matches!(joints, Some(Joints::Open | Joints::Mortar)) {
        note_narrow(sheet)?;
    }
    let mut grown = Grown::default();
    let Some(first) = gaps.first() else { return Ok(grown) };
    match joints {
        None => {
            let (count, width) = (gaps.len(), metres(first.width));
            let places = first.stones.map(|k| &sheet.stones[k].place);
            return Err(ImportErrorKind::OpenJoints { count, width }.at(&places));
        }
        Some(Joints::Open) => {
            let widest = gaps.iter().map(|gap| gap.width).fold(0.0, f64::max);
            // Each of two facing corners moves by less than the tolerance afterwards.
            grown.open = widest + 2.0 * sheet.tolerance;
            return Ok(grown);
        }
        Some(Joints::Close) => {}
        Some(Joints::Mortar) => {
            let of = |is_bed| mortar(gaps.iter().filter(|gap| gap.is_bed == is_bed), sheet);
            (grown.bed, grown.head) = (of(true)?, of(false)?);
            let at_supports = gaps.iter().filter_map(|gap| Some((gap.support?, gap.is_bed)));
            grown.supports = at_supports.collect();
        }
    }
    grown.edges = shares(&gaps, &grown);
    note(sheet, &gaps, joints);
    move_edges(sheet, &grown.edges, 1.0);
    Ok(grown)
}

/// Moves the edges back again if there is mortar, which needs the room.
pub(crate) fn shrink(sheet: &mut Sheet, grown: &Grown) {
    if grown.bed.is_some() || grown.head.is_some() {
        move_edges(sheet, &grown.edges, -1.0);
    }
}

fn note(sheet: &mut Sheet, gaps: &[Gap], joints: Option<Joints>) {
    let is_mortar = joints == Some(Joints::Mortar);
    let what = if is_mortar { "open joints became mortar" } else { "open joints were closed" };
    for gap in gaps {
        let place = &sheet.stones[gap.stones[0]].place;
        sheet.changes.push(Change::by(what, place, gap.width));
    }
}

/// Notes gaps of constant width below the tolerance, which the tolerance closes for every choice of joints.
fn note_narrow(sheet: &mut Sheet) -> Result<(), ImportError> {
    /// Gaps below this part of the tolerance count as rounding errors. Chosen: a gap of millimetres is reported, a gap
    /// of micrometres is not.
    const NARROWEST: f64 = 0.05;
    let tolerance = sheet.tolerance;
    let narrow = gaps(sheet, NARROWEST * tolerance)?;
    let what = format!(
        "gaps were closed, as the tolerance of {} m is larger (one of half their width keeps them open)",
        metres(tolerance)
    );
    for gap in narrow.iter().filter(|gap| gap.width <= tolerance) {
        let place = &sheet.stones[gap.stones[0]].place;
        sheet.changes.push(Change::by(&what, place, gap.width));
    }
    Ok(())
}

/// Returns all gaps that are wider than the tolerance.
fn gaps(sheet: &Sheet, tolerance: f64) -> Result<Vec<Gap>, ImportError> {
    let stones = &sheet.stones;
    let edges = stones.iter().flat_map(|stone| size::edges(&stone.corners));
    let reach = WIDEST * edges.fold(f64::INFINITY, f64::min);
    let mut gaps = Vec::new();
    for pair in near_pairs(stones, reach)? {
        let [a, b] = pair.map(|k| &stones[k].corners);
        for (i, j) in (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j))) {
            let edges = [geometry::edge(a, i), geometry::edge(b, j)];
            if let Some(found) = between(edges, tolerance, reach) {
                gaps.push(Gap {
                    edges: [Some((pair[0], i)), Some((pair[1], j))],
                    stones: pair,
                    ..found
                });
            }
        }
    }
    for (k, stone) in stones.iter().enumerate() {
        let edges = (0..stone.corners.len()).map(|i| (i, geometry::edge(&stone.corners, i)));
        for (s, (i, edge)) in
            (0..sheet.supports.len()).flat_map(|s| edges.clone().map(move |it| (s, it)))
        {
            let [from, to] = sheet.supports[s].ends;
            let mut lines = [[from, to], [to, from]].into_iter();
            let found = lines.find_map(|line| between([edge, line], tolerance, reach));
            let at =
                |it| Gap { edges: [Some((k, i)), None], stones: [k, k], support: Some(s), ..it };
            gaps.extend(found.map(at));
        }
    }
    Ok(gaps)
}

/// Returns the gap between two edges; `None` unless the edges face each other, and the gap has the same width at both
/// ends, is wider than the tolerance, and is longer than wide.
fn between(edges: [[Point2<f64>; 2]; 2], tolerance: f64, reach: f64) -> Option<Gap> {
    let overlap = geometry::facing_overlap(edges[0], edges[1], tolerance, reach)?;
    let [low, high] = [overlap.gap[0].min(overlap.gap[1]), overlap.gap[0].max(overlap.gap[1])];
    let is_even = high - low <= 2.0 * tolerance;
    let width = 0.5 * (low + high);
    let [from, to] = overlap.on_first;
    let length = (to - from) * (edges[0][1] - edges[0][0]).norm();
    let is_bed = overlap.normal.y.abs() >= overlap.normal.x.abs();
    (is_even && width > tolerance && length > width).then_some(Gap {
        edges: [None; 2],
        support: None,
        stones: [0; 2],
        width,
        length,
        is_bed,
    })
}

/// Returns the thickness of mortar that fits all gaps: their median width, rounded; `None` without gaps.
///
/// # Errors
/// The width of a gap differs from the median by more than twice the tolerance.
fn mortar<'a>(
    gaps: impl Iterator<Item = &'a Gap>,
    sheet: &Sheet,
) -> Result<Option<f64>, ImportError> {
    /// Thicknesses of mortar are rounded to multiples of this step \[m\], tenths of millimetres, if that changes them
    /// by at most half the tolerance. Chosen: masons do not work more finely.
    const STEP: f64 = 1e-4;
    let gaps: Vec<&Gap> = gaps.collect();
    let Some(width) = median(gaps.iter().map(|gap| gap.width).collect()) else { return Ok(None) };
    if let Some(gap) = gaps.iter().find(|gap| (gap.width - width).abs() > 2.0 * sheet.tolerance) {
        let [width, usual] = [gap.width, width].map(metres);
        let places = gap.stones.map(|k| &sheet.stones[k].place);
        return Err(ImportErrorKind::UnevenMortar { width, usual }.at(&places));
    }
    // The quotient is the nearest number to the decimal number with few digits.
    let rounded = (width / STEP).round() / STEP.recip();
    let is_same = (rounded - width).abs() <= 0.5 * sheet.tolerance && rounded > 0.0;
    Ok(Some(if is_same { rounded } else { width }))
}

/// Returns the distance by which each edge moves outwards: half of the mortar thickness, or of the width of the gap
/// along most of the edge if there is no mortar; at a support the whole thickness or width.
fn shares(gaps: &[Gap], grown: &Grown) -> Vec<(Edge, f64)> {
    let mut of_edges: BTreeMap<Edge, (f64, f64)> = BTreeMap::new();
    for gap in gaps {
        let mortar = if gap.is_bed { grown.bed } else { grown.head };
        let width = mortar.unwrap_or(gap.width);
        let share = if gap.edges[1].is_some() { 0.5 * width } else { width };
        for edge in gap.edges.into_iter().flatten() {
            let (length, of_edge) = of_edges.entry(edge).or_insert((0.0, share));
            if gap.length > *length {
                (*length, *of_edge) = (gap.length, share);
            }
        }
    }
    of_edges.into_iter().map(|(edge, (_, share))| (edge, share)).collect()
}

/// Moves each edge outwards by its distance \[m\] in `shares` times `factor`. Edges of one stone must be consecutive in
/// `shares`.
fn move_edges(sheet: &mut Sheet, shares: &[(Edge, f64)], factor: f64) {
    for of_stone in shares.chunk_by(|a, b| a.0.0 == b.0.0) {
        let stone = &mut sheet.stones[of_stone[0].0.0];
        let mut by = vec![0.0; stone.corners.len()];
        for ((_, edge), share) in of_stone {
            by[*edge] = factor * share;
        }
        stone.corners = offset(&stone.corners, &by);
    }
}

/// Returns the polygon whose edges are moved outwards by the distances `by`.
fn offset(corners: &[Point2<f64>], by: &[f64]) -> Vec<Point2<f64>> {
    let count = corners.len();
    let corner = |k: usize| {
        let before = (k + count - 1) % count;
        let [m, n] = [before, k].map(|edge| geometry::outward_normal(corners, edge));
        // The displacement `d` of a corner has given components `d . m` and `d . n` along the normals of both edges.
        let determinant = geometry::cross(m, n);
        let (a, b) = (by[before], by[k]);
        corners[k] + nalgebra::Vector2::new(a * n.y - b * m.y, b * m.x - a * n.x) / determinant
    };
    (0..count).map(corner).collect()
}
