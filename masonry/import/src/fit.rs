//! Makes blocks meet exactly: joints are closed or filled, corners are moved onto others, and no overlap remains.

use nalgebra::Point2;

use super::gaps::{self, Grown};
use super::report::metres;
use super::sheet::Sheet;
use super::stones::{Stone, near_pairs};
use super::{ImportError, ImportErrorKind, ImportOptions};
use masonry::geometry;
use masonry::model::heal::heal;
use masonry::model::{Movement, PlacedBlock, PlacedSupport};
use masonry_drawing::Change;

/// Overlaps below this part of the smaller block count as rounding errors, as in the checks of a model.
const TOUCHING: f64 = 1e-9;

/// The changes by which the blocks of a sheet were made to meet.
pub(crate) struct Fitted {
    pub(crate) grown: Grown,
}

impl Fitted {
    /// Makes the blocks of a sheet meet.
    ///
    /// # Errors
    /// Some blocks cannot meet, or still overlap.
    pub(crate) fn of(sheet: &mut Sheet, options: &ImportOptions) -> Result<Self, ImportError> {
        let grown = gaps::grow(sheet, options.joints)?;
        move_together(sheet)?;
        check_overlaps(sheet)?;
        gaps::shrink(sheet, &grown);
        round(sheet);
        Ok(Self { grown })
    }
}

/// Moves corners onto the corners and edges that are nearer than the tolerance.
fn move_together(sheet: &mut Sheet) -> Result<(), ImportError> {
    let mut blocks: Vec<PlacedBlock> = sheet.stones.iter().map(block).collect();
    let supports: Vec<PlacedSupport> = sheet
        .supports
        .iter()
        .map(|it| {
            let [from, to] = it.ends;
            PlacedSupport { name: it.name.clone(), from, to, movement: Movement::default() }
        })
        .collect();
    let (count, tolerance) = (blocks.len(), sheet.tolerance);
    heal(&mut blocks, count, &supports, Some(tolerance)).map_err(|reason| {
        let (shown, remedy) = (metres(tolerance), String::new());
        ImportErrorKind::NotHealed { tolerance, shown, reason, remedy }.at(&[])
    })?;
    for (stone, block) in sheet.stones.iter_mut().zip(blocks) {
        let moved = stone.corners.iter().zip(&block.corners).map(|(from, to)| (to - from).norm());
        let by = moved.fold(0.0, f64::max);
        if by > TOUCHING * geometry::size(&stone.corners) {
            let what = "corners were moved so that blocks meet exactly";
            sheet.changes.push(Change::by(what, &stone.place, by));
        }
        stone.corners = block.corners;
    }
    Ok(())
}

fn block(stone: &Stone) -> PlacedBlock {
    PlacedBlock {
        name: String::new(),
        corners: stone.corners.clone(),
        elasticity: None,
        density: None,
        mesh: None,
        loads: Vec::new(),
    }
}

fn check_overlaps(sheet: &Sheet) -> Result<(), ImportError> {
    let stones = &sheet.stones;
    for [first, second] in near_pairs(stones, 0.0)? {
        let [a, b] = [first, second].map(|k| &stones[k].corners);
        let area = geometry::overlap_area(a, b);
        let size = geometry::size(a).min(geometry::size(b));
        if area > TOUCHING * size * size {
            let tolerance = sheet.tolerance;
            let depth = metres(depth(a, b, area));
            let (shown, remedy) = (metres(tolerance), String::new());
            let kind = ImportErrorKind::Overlap { depth, tolerance, shown, remedy };
            return Err(kind.at(&[&stones[first].place, &stones[second].place]));
        }
    }
    Ok(())
}

/// Returns the depth to which two polygons with an overlap of area `area` reach into each other. If both are convex:
/// the least depth, perpendicular to an edge. Otherwise: the depth of the deepest corner of one in the other, or the
/// mean width of the overlap if that is larger.
fn depth(one: &[Point2<f64>], other: &[Point2<f64>], area: f64) -> f64 {
    let of_convex = |one: &[Point2<f64>], other: &[Point2<f64>]| {
        let across = |k: usize| {
            let normal = geometry::outward_normal(other, k);
            let inside = one.iter().map(|corner| (other[k] - corner).dot(&normal));
            inside.fold(f64::NEG_INFINITY, f64::max)
        };
        (0..other.len()).map(across).fold(f64::INFINITY, f64::min)
    };
    if [one, other].iter().all(|it| geometry::check_convex(it).is_ok()) {
        return of_convex(one, other).min(of_convex(other, one));
    }
    let deepest = |one: &[Point2<f64>], other: &[Point2<f64>]| {
        let inside = one.iter().map(|corner| -geometry::outside(other, *corner));
        inside.fold(f64::NEG_INFINITY, f64::max)
    };
    let width = area / geometry::size(one).min(geometry::size(other));
    deepest(one, other).max(deepest(other, one)).max(width)
}

/// Removes meaningless digits of coordinates, so that corners at one place are written alike.
fn round(sheet: &mut Sheet) {
    /// The last digit that is kept, divided by the size of the drawing. Theory: joints are found to 1e-9 of a block.
    const DIGITS: f64 = 1e-13;
    let corners = sheet.stones.iter().flat_map(|stone| &stone.corners);
    let largest = corners.map(|it| it.x.abs().max(it.y.abs())).fold(0.0, f64::max);
    // Division by a power of ten leaves numbers with few digits.
    let per_metre = 10.0_f64.powf(-(DIGITS * largest).log10().ceil()).round();
    if !(per_metre.is_finite() && per_metre >= 1.0) {
        return;
    }
    let round = |it: f64| (it * per_metre).round() / per_metre + 0.0;
    for corner in sheet.stones.iter_mut().flat_map(|stone| &mut stone.corners) {
        *corner = Point2::new(round(corner.x), round(corner.y));
    }
}

/// Finds a tolerance for which `does` returns true, near a tolerance that did not suffice, with the digits that a
/// message shows; `None` if no tried one suffices.
pub(crate) fn sufficient(tolerance: f64, does: impl Fn(f64) -> bool) -> Option<f64> {
    /// Factors by which the insufficient tolerance is multiplied, the nearest ones first. Chosen: a larger tolerance
    /// joins separate corners, a smaller one leaves corners apart that cannot be joined.
    const FACTORS: [f64; 12] = [1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 0.5, 0.25, 0.1, 0.03, 0.01];
    let written = |factor: f64| metres(tolerance * factor).parse().ok();
    FACTORS.into_iter().filter_map(written).find(|tolerance| does(*tolerance))
}
