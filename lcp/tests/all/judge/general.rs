//! Points `(t, y)` of the general form.

use faer::Mat;
use lcp::HorizontalLcp;

use super::draw::Draw;
use super::planted::{Blocks, Planted, absolute, plus, product, sizes, times};

pub(crate) struct General {
    blocks: Blocks,
    a: Mat<f64>,
    b: Mat<f64>,
    t: Vec<f64>,
    y: Vec<f64>,
    row_unit: Vec<f64>,
    t_unit: Vec<f64>,
    y_unit: Vec<f64>,
}

/// What of one variable of a pair may be in the place of zero.
const SOME: f64 = 1.0 / 1024.0;

impl Planted for General {
    fn draw(draw: &mut Draw) -> Self {
        let blocks = Blocks::draw(draw, 3);
        let (a, b) = (blocks.matrix(draw), blocks.matrix(draw));
        let pair = |_| {
            let value = draw.number(0, 3);
            if draw.is_heads() { (value, 0.0) } else { (0.0, value) }
        };
        let (t, y) = (0..blocks.len()).map(pair).unzip();
        let [row_unit, t_unit, y_unit] = [0; 3].map(|_| blocks.units(draw));
        Self { blocks, a, b, t, y, row_unit, t_unit, y_unit }
    }

    fn is_loaded(&self, right_side: &[f64]) -> bool {
        self.blocks.are_loaded(right_side)
    }

    fn point(&self) -> Vec<f64> {
        [self.t.clone(), self.y.clone()].concat()
    }

    fn right_side(&self, point: &[f64]) -> Vec<f64> {
        let (t, y) = point.split_at(self.t.len());
        plus(&product(&self.a, t), &product(&self.b, y))
    }

    fn terms(&self, point: &[f64]) -> Vec<f64> {
        let (t, y) = point.split_at(self.t.len());
        let terms = plus(&sizes(&self.a, t), &sizes(&self.b, y));
        plus(&terms, &absolute(&self.right_side(point)))
    }

    fn worst(&self, right_side: &[f64], point: &[f64]) -> f64 {
        let Self { a, b, row_unit, t_unit, y_unit, .. } = self;
        let n = a.nrows();
        let problem = HorizontalLcp::new(
            Mat::from_fn(n, n, |i, j| row_unit[i] * a[(i, j)] / t_unit[j]),
            Mat::from_fn(n, n, |i, j| row_unit[i] * b[(i, j)] / y_unit[j]),
            times(right_side, row_unit),
        );
        let (t, y) = point.split_at(n);
        problem.unwrap().residuals(&times(t, t_unit), &times(y, y_unit)).worst()
    }

    fn violations(&self) -> Vec<(String, Vec<f64>)> {
        let (point, n) = (self.point(), self.t.len());
        let mut violations = Vec::new();
        for i in 0..2 * n {
            let partner = (i + n) % (2 * n);
            let mut add = |what: &str, value: f64| {
                let mut violated = point.clone();
                violated[i] = value;
                violations.push((format!("component {i} is {what}"), violated));
            };
            if point[i] == 0.0 {
                add("negative", -SOME);
            }
            if point[partner] > 0.0 {
                add("positive with its partner", SOME);
            }
        }
        violations
    }
}
