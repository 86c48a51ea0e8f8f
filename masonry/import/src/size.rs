//! The unit of a drawing, and the check that blocks in this unit have the size of stones.

use nalgebra::Point2;

use super::report::metres;
use super::{ImportError, ImportErrorKind, ImportOptions};
use masonry::geometry;
use masonry_drawing::{Drawing, Unit};

/// Bounds of the size of the median block \[m\]. Chosen: tiles of a mosaic have a centimetre, the blocks of Baalbek 20
/// m; a drawing in millimetres read as metres has bricks of 200 m, and one in metres read as millimetres has stones
/// below 2 mm.
const SMALLEST: f64 = 3e-3;
const LARGEST: f64 = 25.0;

/// Returns the unit of a drawing: that of the options, else that of the file, else the metre.
///
/// # Errors
/// The unit of the file is unknown, or the median block does not have the size of a stone in it. There is no error if
/// the options give a unit.
pub(crate) fn unit(drawing: &Drawing, options: &ImportOptions) -> Result<Unit, ImportError> {
    if let (None, Some(number)) = (options.unit, drawing.unknown_unit) {
        return Err(ImportErrorKind::UnknownUnit { number }.at(&[]));
    }
    let (unit, from) = match (options.unit, drawing.unit) {
        (Some(unit), _) => return Ok(unit),
        (None, Some(unit)) => (unit, "as the file says"),
        (None, None) => (Unit::Metre, "which the file does not say"),
    };
    let Some(size) = median_size(drawing) else { return Ok(unit) };
    let metres_of = |unit: Unit| size * unit.metres() * options.scale;
    let fits = |unit: &Unit| (SMALLEST..=LARGEST).contains(&metres_of(*unit));
    if fits(&unit) {
        return Ok(unit);
    }
    let others: Vec<String> =
        Unit::ALL.iter().filter(|it| fits(it)).map(|it| format!("--unit {it}")).collect();
    let remedy = if others.is_empty() {
        "give --scale".to_owned()
    } else {
        format!("give {}, or --unit {unit} if that is right", others.join(" or "))
    };
    let compared = if metres_of(unit) > LARGEST { "larger" } else { "smaller" };
    // The message states "larger than" or "smaller than", so that rounding to three digits does not matter.
    let size = metres(metres_of(unit));
    Err(ImportErrorKind::Size { compared, size, unit, from, remedy }.at(&[]))
}

/// Returns the median size of outlines, or of lines if there are no outlines, in the unit of the drawing.
fn median_size(drawing: &Drawing) -> Option<f64> {
    let extent = |points: &[Point2<f64>]| {
        let first = points.first()?;
        Some(points.iter().map(|it| (it - first).norm()).fold(0.0, f64::max))
    };
    let of_outlines = drawing.outlines.iter().map(|it| &it.corners[..]);
    let of_outlines: Vec<f64> = of_outlines.filter_map(extent).filter(|it| *it > 0.0).collect();
    let sizes = if of_outlines.is_empty() {
        drawing.lines.iter().filter_map(|it| extent(&it.points)).collect()
    } else {
        of_outlines
    };
    median(sizes)
}

/// Returns the median of numbers; `None` if there are none.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Returns the lengths of the edges of a polygon.
pub(crate) fn edges(corners: &[Point2<f64>]) -> impl Iterator<Item = f64> {
    (0..corners.len()).map(|k| {
        let [from, to] = geometry::edge(corners, k);
        (to - from).norm()
    })
}
