//! Points `(z, w)` of standard, mixed and boxed problems.

use faer::Mat;
use lcp::{BoxedLcp, Lcp, MixedLcp};

use super::draw::Draw;
use super::planted::{Blocks, Planted, absolute, minus, plus, product, sizes, times};

/// The place of a variable between its bounds.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Lower,
    Upper,
    Between,
    Free,
    Fixed,
}

/// A problem with bounds of all kinds.
pub(crate) struct Bounded {
    blocks: Blocks,
    m: Mat<f64>,
    place: Vec<Place>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    z: Vec<f64>,
    w: Vec<f64>,
    row_unit: Vec<f64>,
    z_unit: Vec<f64>,
}

/// How far a variable may be from where it should be.
const SOME: f64 = 1.0 / 1024.0;

impl Bounded {
    fn new(draw: &mut Draw, places: &[Place], bound: (i32, i32)) -> Self {
        let blocks = Blocks::draw(draw, 3);
        let n = blocks.len();
        let m = blocks.matrix(draw);
        let place: Vec<Place> = (0..n).map(|_| draw.one_of(places)).collect();
        let (mut lower, mut upper) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
        let (mut z, mut w) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let (bound, room) = (draw.number(bound.0, bound.1), draw.number(1, 3));
            let (push, is_one_sided) = (draw.number(0, 3), bound == 0.0 || draw.is_heads());
            let far = if is_one_sided { f64::INFINITY } else { room };
            match place[i] {
                Place::Free => z[i] = draw.number(-3, 3),
                Place::Lower => {
                    (lower[i], upper[i], z[i], w[i]) = (bound, bound + far, bound, push);
                }
                Place::Upper => {
                    (lower[i], upper[i], z[i], w[i]) = (bound - far, bound, bound, -push);
                }
                Place::Between => {
                    (lower[i], upper[i], z[i]) = (bound, bound + room + far, bound + room);
                }
                Place::Fixed => {
                    (lower[i], upper[i], z[i], w[i]) = (bound, bound, bound, push - 1.0);
                }
            }
        }
        let [row_unit, z_unit] = [0; 2].map(|_| blocks.units(draw));
        Self { blocks, m, place, lower, upper, z, w, row_unit, z_unit }
    }

    /// The matrix and the vector in their units.
    fn data(&self, q: &[f64]) -> (Mat<f64>, Vec<f64>) {
        let Self { m, row_unit, z_unit, .. } = self;
        let n = m.nrows();
        (Mat::from_fn(n, n, |i, j| row_unit[i] * m[(i, j)] / z_unit[j]), times(q, row_unit))
    }

    /// `z` and `w` in their units.
    fn in_units(&self, point: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (z, w) = point.split_at(self.z.len());
        (times(z, &self.z_unit), times(w, &self.row_unit))
    }
}

impl Bounded {
    fn point(&self) -> Vec<f64> {
        [self.z.clone(), self.w.clone()].concat()
    }

    fn right_side(&self, point: &[f64]) -> Vec<f64> {
        let (z, w) = point.split_at(self.z.len());
        minus(w, &product(&self.m, z))
    }

    fn terms(&self, point: &[f64]) -> Vec<f64> {
        let (z, w) = point.split_at(self.z.len());
        plus(&plus(&sizes(&self.m, z), &absolute(w)), &absolute(&self.right_side(point)))
    }

    fn violations(&self) -> Vec<(String, Vec<f64>)> {
        let (point, n) = (self.point(), self.z.len());
        let mut violations = Vec::new();
        for (i, place) in self.place.iter().enumerate() {
            let mut add = |what: &str, component: usize, value: f64| {
                let mut violated = point.clone();
                violated[component] = value;
                violations.push((format!("variable {i}: {what}"), violated));
            };
            let (z, w) = (self.z[i], self.w[i]);
            match place {
                Place::Free => {}
                Place::Upper => add("z beyond the upper bound", i, z + SOME),
                Place::Between => add("z beyond the lower bound", i, self.lower[i] - SOME),
                Place::Lower => add("z beyond the lower bound", i, z - SOME),
                Place::Fixed => {
                    add("z beyond the upper bound", i, z + SOME);
                    add("z beyond the lower bound", i, z - SOME);
                }
            }
            match place {
                Place::Lower if w > 0.0 => {
                    add("z between its bounds with a positive w", i, z + SOME);
                }
                Place::Upper if w < 0.0 => {
                    add("z between its bounds with a negative w", i, z - SOME);
                }
                _ => {}
            }
            match place {
                Place::Lower => add("a negative w at the lower bound", n + i, -SOME),
                Place::Upper => add("a positive w at the upper bound", n + i, SOME),
                Place::Between | Place::Free => {
                    add("a positive w between its bounds", n + i, SOME);
                    add("a negative w between its bounds", n + i, -SOME);
                }
                Place::Fixed => {}
            }
        }
        violations
    }
}

/// What the problems with bounds have in common, for a type with one field.
macro_rules! planted_bounds {
    ($class:ty, $places:expr, $bound:expr, $worst:expr) => {
        impl Planted for $class {
            fn draw(draw: &mut Draw) -> Self {
                Self(Bounded::new(draw, &$places, $bound))
            }

            fn is_loaded(&self, right_side: &[f64]) -> bool {
                self.0.blocks.are_loaded(right_side)
            }

            fn point(&self) -> Vec<f64> {
                self.0.point()
            }

            fn right_side(&self, point: &[f64]) -> Vec<f64> {
                self.0.right_side(point)
            }

            fn terms(&self, point: &[f64]) -> Vec<f64> {
                self.0.terms(point)
            }

            fn worst(&self, right_side: &[f64], point: &[f64]) -> f64 {
                let ((m, q), (z, w)) = (self.0.data(right_side), self.0.in_units(point));
                $worst(&self.0, m, q, &z, &w)
            }

            fn violations(&self) -> Vec<(String, Vec<f64>)> {
                self.0.violations()
            }
        }
    };
}

pub(crate) struct Standard(Bounded);
pub(crate) struct Mixed(Bounded);
pub(crate) struct Boxed(Bounded);

planted_bounds!(
    Standard,
    [Place::Lower, Place::Between],
    (0, 0),
    |_: &Bounded, m, q, z: &[f64], w: &[f64]| Lcp::new(m, q).unwrap().residuals(z, w).worst()
);

planted_bounds!(
    Mixed,
    [Place::Lower, Place::Between, Place::Free],
    (0, 0),
    |it: &Bounded, m, q, z: &[f64], w: &[f64]| {
        let free = it.place.iter().map(|place| *place == Place::Free).collect();
        MixedLcp::new(m, q, free).unwrap().residuals(z, w).worst()
    }
);

planted_bounds!(
    Boxed,
    [Place::Lower, Place::Upper, Place::Between, Place::Free, Place::Fixed],
    (-3, 3),
    |it: &Bounded, m, q, z: &[f64], w: &[f64]| {
        let (lower, upper) = (times(&it.lower, &it.z_unit), times(&it.upper, &it.z_unit));
        BoxedLcp::new(m, q, lower, upper).unwrap().residuals(z, w).worst()
    }
);
