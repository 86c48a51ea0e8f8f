//! Search for pairs of shapes that are close enough to touch.

use nalgebra::Point2;

use crate::geometry::{self, Extent, SAME_PLACE};

/// Returns the pairs of shapes whose bounding boxes come within `reach` \[m\] of each other, in increasing order.
///
/// The search sweeps the boxes along the longer side of the whole structure, so that only neighbours in this direction
/// are compared.
pub(crate) fn near_pairs<'a>(
    shapes: impl IntoIterator<Item = &'a [Point2<f64>]>,
    reach: f64,
) -> Vec<[usize; 2]> {
    let grown = |it: &[Point2<f64>]| Extent::of(it).grown(reach + SAME_PLACE * geometry::size(it));
    let boxes: Vec<Extent> = shapes.into_iter().map(grown).collect();
    let Some(whole) = boxes.iter().copied().reduce(Extent::union) else { return Vec::new() };
    let axis = usize::from(whole.high.y - whole.low.y > whole.high.x - whole.low.x);
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|i, j| boxes[*i].low[axis].total_cmp(&boxes[*j].low[axis]));

    let mut active: Vec<usize> = Vec::new();
    let mut pairs = Vec::new();
    for &new in &order {
        active.retain(|old| boxes[*old].high[axis] >= boxes[new].low[axis]);
        let near = active.iter().filter(|old| boxes[**old].meets(&boxes[new]));
        pairs.extend(near.map(|old| [new.min(*old), new.max(*old)]));
        active.push(new);
    }
    pairs.sort_unstable();
    pairs
}
