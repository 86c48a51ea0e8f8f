//! Units of a form, removed by powers of two: exact, so that it costs no accuracy.

use faer::sparse::SparseColMat;

use super::constants::SWEEPS;
use super::form::{Bounds, Form, Point};
use crate::Matrix;
use crate::problem::column_of;
use crate::vector::max_abs;

/// A form whose matrices and vectors are near one, and the way back.
#[derive(Debug, Clone)]
pub(super) struct Scaled {
    pub(super) form: Form,
    /// One user unit of `x` is so many of the scaled form.
    x: Vec<f64>,
    lambda: Vec<f64>,
}

/// Units of the two kinds of variables and of the objective. Stationarity and slacks are one saddle
/// problem, whose symmetry leaves these three free.
struct Units {
    x: f64,
    lambda: f64,
    objective: f64,
}

impl Scaled {
    /// Units of the whole are removed first, exactly: forms that differ by powers of two in them
    /// give the same scaled form. What differs from row to row is balanced after that (Ruiz 2001).
    pub(super) fn new(form: &Form) -> Self {
        let units = Units::of(form);
        let [p, d, s] = [
            units.objective * units.x * units.x,
            units.objective * units.x * units.lambda,
            units.objective * units.lambda * units.lambda,
        ];
        let (x, lambda) = balance(form, [p, d, s]);
        let rows = |factor: f64, by: &[f64]| by.iter().map(|v| factor * v).collect::<Vec<_>>();
        let of_x = rows(units.objective * units.x, &x);
        let of_lambda = rows(units.objective * units.lambda, &lambda);
        let times = |v: &[f64], by: &[f64]| v.iter().zip(by).map(|(v, by)| v * by).collect();
        let (mut linear, mut offset): (Vec<f64>, Vec<f64>) =
            (times(&form.linear, &of_x), times(&form.offset, &of_lambda));
        let load = exponent(max_abs(&linear).max(max_abs(&offset)));
        linear.iter_mut().chain(&mut offset).for_each(|v| *v /= load);
        let bounds = form.bounds.iter().enumerate().map(|(i, bounds)| match *bounds {
            Bounds::Cone { normal, mu } => {
                Bounds::Cone { normal, mu: mu * lambda[normal] / lambda[i] }
            }
            simple @ (Bounds::Free | Bounds::Nonnegative) => simple,
        });
        let scaled = Form {
            p: scale(&form.p, p, &x, &x),
            d: scale(&form.d, d, &lambda, &x),
            s: scale(&form.s, s, &lambda, &lambda),
            linear,
            offset,
            bounds: bounds.collect(),
        };
        let back = |unit: f64, by: Vec<f64>| by.iter().map(|v| load * unit * v).collect();
        Self { form: scaled, x: back(units.x, x), lambda: back(units.lambda, lambda) }
    }

    /// To the units of the user.
    pub(super) fn unscaled(&self, point: &Point) -> Point {
        let times = |v: &[f64], by: &[f64]| v.iter().zip(by).map(|(v, by)| v * by).collect();
        Point { x: times(&point.x, &self.x), lambda: times(&point.lambda, &self.lambda) }
    }
}

impl Units {
    /// Those in which the largest entries of two of the three matrices are near one.
    fn of(form: &Form) -> Self {
        let [p, d, s] = [&form.p, &form.d, &form.s].map(largest);
        match (p > 0.0, d > 0.0, s > 0.0) {
            (true, true, _) => Self { x: d / p, lambda: 1.0, objective: p / (d * d) },
            (true, false, true) => Self { x: 1.0, lambda: half_power(p / s), objective: 1.0 / p },
            (true, false, false) => Self { x: 1.0, lambda: 1.0, objective: 1.0 / p },
            (false, true, true) => Self { x: s / d, lambda: 1.0, objective: 1.0 / s },
            (false, true, false) => Self { x: 1.0, lambda: 1.0, objective: 1.0 / d },
            (false, false, true) => Self { x: 1.0, lambda: 1.0, objective: 1.0 / s },
            (false, false, false) => Self { x: 1.0, lambda: 1.0, objective: 1.0 },
        }
    }
}

/// Factors of `x` and `lambda` that bring the largest entry of every row of `[P, D^T; D, S]`, whose
/// blocks come with a factor each, near one.
fn balance(form: &Form, [p, d, s]: [f64; 3]) -> (Vec<f64>, Vec<f64>) {
    let mut x = vec![1.0_f64; form.unknowns()];
    let mut lambda = vec![1.0_f64; form.rows()];
    for _ in 0..SWEEPS {
        let mut x_max = vec![0.0_f64; x.len()];
        let mut lambda_max = vec![0.0_f64; lambda.len()];
        for j in 0..x.len() {
            for (i, v) in column_of(&form.p, j) {
                x_max[j] = x_max[j].max((p * v * x[i] * x[j]).abs());
            }
            for (i, v) in column_of(&form.d, j) {
                let v = (d * v * lambda[i] * x[j]).abs();
                x_max[j] = x_max[j].max(v);
                lambda_max[i] = lambda_max[i].max(v);
            }
        }
        for j in 0..lambda.len() {
            for (i, v) in column_of(&form.s, j) {
                lambda_max[j] = lambda_max[j].max((s * v * lambda[i] * lambda[j]).abs());
            }
        }
        let pairs = x.iter_mut().zip(x_max).chain(lambda.iter_mut().zip(lambda_max));
        pairs.filter(|(_, max)| *max > 0.0).for_each(|(factor, max)| *factor /= max.sqrt());
    }
    let rounded = |v: Vec<f64>| v.into_iter().map(exponent).collect();
    (rounded(x), rounded(lambda))
}

fn scale(
    matrix: &SparseColMat<usize, f64>,
    factor: f64,
    rows: &[f64],
    cols: &[f64],
) -> SparseColMat<usize, f64> {
    let entries = (0..matrix.ncols()).flat_map(|j| {
        column_of(matrix, j).map(move |(i, v)| (i, j, factor * rows[i] * v * cols[j]))
    });
    Matrix::from_entries(matrix.nrows(), matrix.ncols(), entries).into_sparse()
}

/// The largest entry, as the power of two below it; zero of a matrix of zeros.
fn largest(matrix: &SparseColMat<usize, f64>) -> f64 {
    let columns = (0..matrix.ncols()).flat_map(|j| column_of(matrix, j));
    let max = columns.fold(0.0_f64, |max, (_, v)| max.max(v.abs()));
    if max > 0.0 { exponent(max) } else { 0.0 }
}

/// The power of two below a positive number, from its bits, so that it is exact; one for zero.
fn exponent(v: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    if v >= f64::MIN_POSITIVE { f64::from_bits(v.to_bits() & EXPONENT) } else { 1.0 }
}

/// Nearly the root of a power of two, as a power of two.
fn half_power(v: f64) -> f64 {
    exponent(v.sqrt())
}
