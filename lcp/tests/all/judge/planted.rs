//! Problems made for a point in small integers, and what the judge must see of changes.
//!
//! The integers are multiplied by powers of two that differ between rows, variables and blocks, so that the
//! rows hold without rounding in any units.

use faer::Mat;

use super::draw::Draw;

/// What is changed of a component or of the terms of a row.
const CHANGE: f64 = 1e-3;
/// What the judge must say at least of such a change: twice the usual tolerance. Rows without a load count as much
/// as those with one feel of them.
const SEEN: f64 = 1e-9;

/// A problem whose right-hand side is made for a point, in integers.
pub(crate) trait Planted {
    fn draw(draw: &mut Draw) -> Self;

    /// Whether every block that is coupled weakly or not at all has a right-hand side. The others only feel what comes
    /// through the couplings, twice weakened, and count for no more.
    fn is_loaded(&self, right_side: &[f64]) -> bool;

    /// A solution.
    fn point(&self) -> Vec<f64>;

    /// The right-hand side for which the rows hold at a point.
    fn right_side(&self, point: &[f64]) -> Vec<f64>;

    /// The sums of the sizes of the terms of every row at a point, right-hand side included.
    fn terms(&self, point: &[f64]) -> Vec<f64>;

    /// What the judge says of a point of the problem with this right-hand side.
    fn worst(&self, right_side: &[f64], point: &[f64]) -> f64;

    /// Points at which one condition on the variables does not hold by something that matters, each with what
    /// is wrong.
    fn violations(&self) -> Vec<(String, Vec<f64>)>;

    /// Nonzero components that cannot be changed alone.
    fn fixed_components(&self) -> Vec<usize> {
        let point = self.point();
        (0..point.len()).filter(|&i| point[i] != 0.0).collect()
    }

    /// Rows that cannot be changed alone.
    fn fixed_rows(&self) -> Vec<usize> {
        (0..self.terms(&self.point()).len()).collect()
    }
}

/// The first problem that is drawn in which all blocks are loaded.
pub(crate) fn planted<P: Planted>(seed: u64) -> P {
    let mut draw = Draw::new(seed);
    loop {
        let drawn = P::draw(&mut draw);
        if drawn.is_loaded(&drawn.right_side(&drawn.point())) {
            return drawn;
        }
    }
}

/// The exact point passes.
pub(crate) fn assert_solved<P: Planted>(planted: &P) {
    let point = planted.point();
    let worst = planted.worst(&planted.right_side(&point), &point);
    assert!(worst <= 1e-14, "{worst:e}");
}

/// The point with one component changed by a part of its own size fails.
pub(crate) fn assert_components_are_seen<P: Planted>(planted: &P) {
    let point = planted.point();
    let right_side = planted.right_side(&point);
    for i in planted.fixed_components() {
        for factor in [1.0 + CHANGE, 1.0 - CHANGE] {
            let mut changed = point.clone();
            changed[i] *= factor;
            let worst = planted.worst(&right_side, &changed);
            assert!(worst > SEEN, "component {i} times {factor}: {worst:e}");
        }
    }
}

/// The point fails where a row of the problem is changed by a part of its own terms.
pub(crate) fn assert_rows_are_seen<P: Planted>(planted: &P) {
    let point = planted.point();
    let (right_side, terms) = (planted.right_side(&point), planted.terms(&point));
    for i in planted.fixed_rows().into_iter().filter(|&i| terms[i] > 0.0) {
        for change in [CHANGE, -CHANGE] {
            let mut changed = right_side.clone();
            changed[i] += change * terms[i];
            let worst = planted.worst(&changed, &point);
            assert!(worst > SEEN, "row {i} changed by {change} of its terms: {worst:e}");
        }
    }
}

/// Where all rows hold and one condition on the variables does not, the point fails.
pub(crate) fn assert_conditions_are_seen<P: Planted>(planted: &P) {
    for (what, point) in planted.violations() {
        let right_side = planted.right_side(&point);
        let worst = planted.worst(&right_side, &point);
        assert!(worst > SEEN || !planted.is_loaded(&right_side), "{what}: {worst:e}");
    }
}

/// Blocks of a problem, which are of different sizes and coupled weakly or not at all.
pub(crate) struct Blocks {
    /// The block of every index.
    pub(crate) of: Vec<usize>,
    /// The size of the variables of every block.
    pub(crate) size: Vec<f64>,
    /// What couplings are multiplied by.
    pub(crate) coupling: f64,
    /// The largest exponent of further factors of rows and variables.
    spread: i32,
}

impl Blocks {
    /// One to three blocks, each with so many indices at most.
    pub(crate) fn draw(draw: &mut Draw, most: usize) -> Self {
        let count = 1 + draw.index(3);
        let sizes: Vec<usize> = (0..count).map(|_| 1 + draw.index(most)).collect();
        let of = sizes.iter().enumerate().flat_map(|(block, n)| vec![block; *n]).collect();
        let size = (0..count).map(|_| f64::from(draw.one_of(&[0, 20, 40])).exp2()).collect();
        let coupling = draw.one_of(&[0.0, (-20_f64).exp2(), 1.0]);
        Self { of, size, coupling, spread: draw.one_of(&[0, 3, 40, 60]) }
    }

    /// The same, and blocks that are coupled are of sizes up to this.
    pub(crate) fn within(mut self, largest: f64) -> Self {
        if self.coupling > 0.0 {
            self.size.iter_mut().for_each(|size| *size = size.min(largest));
        }
        self
    }

    /// Whether all blocks are coupled strongly, or have a right-hand side of their own, given row by row.
    pub(crate) fn are_loaded(&self, right_side: &[f64]) -> bool {
        let rows = || right_side.iter().zip(self.of.iter().cycle());
        let is_loaded = |block| rows().any(|(q, of)| *of == block && *q != 0.0);
        self.coupling == 1.0 || (0..self.size.len()).all(is_loaded)
    }

    pub(crate) fn len(&self) -> usize {
        self.of.len()
    }

    /// What an entry is multiplied by that couples two indices.
    pub(crate) fn between(&self, i: usize, j: usize) -> f64 {
        if self.of[i] == self.of[j] { 1.0 } else { self.coupling }
    }

    /// The size of the block of every index.
    pub(crate) fn sizes(&self) -> Vec<f64> {
        self.of.iter().map(|&block| self.size[block]).collect()
    }

    /// Units of the indices: the sizes of their blocks times a factor of their own.
    pub(crate) fn units(&self, draw: &mut Draw) -> Vec<f64> {
        self.sizes().into_iter().map(|size| size * draw.power(self.spread)).collect()
    }

    /// Factors that have nothing to do with the blocks.
    pub(crate) fn factors(&self, draw: &mut Draw) -> Vec<f64> {
        (0..self.len()).map(|_| draw.power(self.spread)).collect()
    }

    /// Small integers, of which the diagonal is not zero, with the couplings between the blocks.
    pub(crate) fn matrix(&self, draw: &mut Draw) -> Mat<f64> {
        Mat::from_fn(self.len(), self.len(), |i, j| {
            let value = if i == j {
                draw.one_of(&[-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
            } else {
                draw.number(-3, 3)
            };
            self.between(i, j) * value
        })
    }
}

pub(crate) fn product(m: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    (0..m.nrows()).map(|i| x.iter().enumerate().map(|(j, x)| m[(i, j)] * x).sum()).collect()
}

pub(crate) fn sizes(m: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    let row = |i| x.iter().enumerate().map(|(j, x)| (m[(i, j)] * x).abs()).sum();
    (0..m.nrows()).map(row).collect()
}

pub(crate) fn transposed(m: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    product(&m.transpose().to_owned(), x)
}

pub(crate) fn plus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

pub(crate) fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

pub(crate) fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

pub(crate) fn absolute(a: &[f64]) -> Vec<f64> {
    a.iter().map(|a| a.abs()).collect()
}
