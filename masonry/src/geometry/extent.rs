//! Bounding rectangles of points.

use nalgebra::Point2;

/// The smallest rectangle along the axes around points; `low` is above `high` if there are no points.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    pub(crate) low: Point2<f64>,
    pub(crate) high: Point2<f64>,
}

impl Extent {
    pub(crate) fn of<'a>(points: impl IntoIterator<Item = &'a Point2<f64>>) -> Self {
        let inf = Point2::new(f64::INFINITY, f64::INFINITY);
        let of_none = Self { low: inf, high: -inf };
        points.into_iter().fold(of_none, |all, p| all.union(Self { low: *p, high: *p }))
    }

    pub(crate) fn grown(mut self, by: f64) -> Self {
        self.low.iter_mut().for_each(|x| *x -= by);
        self.high.iter_mut().for_each(|x| *x += by);
        self
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    /// Returns the length of the longer side \[m\].
    pub(crate) fn longer_side(&self) -> f64 {
        (self.high - self.low).max()
    }
}
