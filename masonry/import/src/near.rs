//! Pairs of shapes that are near each other.

use nalgebra::Point2;

/// The axis-parallel box around points, enlarged by `reach` on all sides.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    low: Point2<f64>,
    high: Point2<f64>,
}

impl Bounds {
    fn of(points: &[Point2<f64>], reach: f64) -> Self {
        let none = Point2::new(f64::INFINITY, f64::INFINITY);
        let (low, high) = points
            .iter()
            .fold((none, -none), |(low, high), point| (low.inf(point), high.sup(point)));
        let margin = nalgebra::Vector2::repeat(reach);
        Self { low: low - margin, high: high + margin }
    }
}

/// Finds the pairs of shapes whose boxes, each enlarged by half of `reach`, intersect; in increasing order. `Err` with
/// the index of a shape if there are far more pairs than neighbouring shapes have.
pub(crate) fn pairs(shapes: &[&[Point2<f64>]], reach: f64) -> Result<Vec<[usize; 2]>, usize> {
    /// The largest number of pairs, divided by the number of shapes. Chosen: bricks have six to eight neighbours, a
    /// floor slab has a whole course of neighbours.
    const MOST: usize = 64;
    let boxes: Vec<Bounds> = shapes.iter().map(|it| Bounds::of(it, 0.5 * reach)).collect();
    // Fewer shapes overlap along the axis with the larger extent.
    let extent = |axis: usize| {
        let low = boxes.iter().map(|it| it.low[axis]).fold(f64::INFINITY, f64::min);
        boxes.iter().map(|it| it.high[axis]).fold(f64::NEG_INFINITY, f64::max) - low
    };
    let axis = usize::from(extent(1) > extent(0));
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|i, j| boxes[*i].low[axis].total_cmp(&boxes[*j].low[axis]));
    let (mut active, mut pairs): (Vec<usize>, Vec<[usize; 2]>) = (Vec::new(), Vec::new());
    for new in order {
        let (here, other) = (boxes[new], 1 - axis);
        active.retain(|old| boxes[*old].high[axis] >= here.low[axis]);
        let meets = |old: &&usize| {
            let old = boxes[**old];
            old.low[other] <= here.high[other] && here.low[other] <= old.high[other]
        };
        pairs.extend(active.iter().filter(meets).map(|old| [new.min(*old), new.max(*old)]));
        active.push(new);
        if pairs.len() > MOST * boxes.len() {
            return Err(new);
        }
    }
    pairs.sort_unstable();
    Ok(pairs)
}
