//! Residuals and distances, computed here and not by the library.

use faer::Mat;
use faer::sparse::{SparseColMat, Triplet};
use lcp::{HorizontalLcp, Lcp, Matrix};

/// That a residual is summed up here in another order.
pub(crate) const ROUNDING: f64 = 1.01;

pub(crate) fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, v| max.max(v.abs()))
}

/// The largest difference, in units of the largest entry expected.
pub(crate) fn distance(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let difference: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    let size = largest(expected);
    if size > 0.0 { largest(&difference) / size } else { largest(&difference) }
}

pub(crate) fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn times(m: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    (0..m.nrows()).map(|i| x.iter().enumerate().map(|(j, x)| m[(i, j)] * x).sum()).collect()
}

pub(crate) fn transposed(m: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    times(&m.transpose().to_owned(), x)
}

pub(crate) fn sparse(m: &Mat<f64>) -> Matrix {
    let places = (0..m.ncols()).flat_map(|j| (0..m.nrows()).map(move |i| (i, j)));
    let nonzero = places.filter(|&place| m[place] != 0.0);
    let triplets: Vec<_> = nonzero.map(|(i, j)| Triplet::new(i, j, m[(i, j)])).collect();
    SparseColMat::try_new_from_triplets(m.nrows(), m.ncols(), &triplets).unwrap().into()
}

/// The largest residual of a point of the general problem `A t + B y = c`, by the definitions of the
/// library: rows relative to their terms, but to 2^-10 of the largest possible one at least, pairs
/// relative to the largest of their vectors.
pub(crate) fn worst_of_general(problem: &HorizontalLcp, t: &[f64], y: &[f64]) -> f64 {
    let (a, b) = (problem.a().to_dense(), problem.b().to_dense());
    let (t_max, y_max) = (largest(t), largest(y));
    let unit = |max: f64| if max > 0.0 { max } else { 1.0 };
    let pair = |(t, y): (&f64, &f64)| (t / unit(t_max)).min(y / unit(y_max)).abs();
    let pairs = t.iter().zip(y).map(pair).fold(0.0, f64::max);
    let row = |i: usize| {
        let terms = (0..t.len()).flat_map(|j| [a[(i, j)] * t[j], b[(i, j)] * y[j]]);
        let terms: Vec<f64> = terms.chain([-problem.c()[i]]).collect();
        let possible = (0..t.len()).flat_map(|j| [a[(i, j)] * t_max, b[(i, j)] * y_max]);
        let possible: Vec<f64> = possible.collect();
        let size = terms.iter().map(|v| v.abs()).sum::<f64>().max(largest(&possible) / 1024.0);
        if size > 0.0 { terms.iter().sum::<f64>().abs() / size } else { 0.0 }
    };
    (0..t.len()).map(row).fold(pairs, f64::max)
}

/// What a point of `w = M z + q` with a residual may lack of an exact solution of a problem near by.
pub(crate) struct Lack {
    /// The point made complementary: in no component further from `z` than `residual max z`.
    pub(crate) z: Vec<f64>,
    /// For every row, how much `q` must change at most that the point solves the problem.
    pub(crate) change: Vec<f64>,
    /// How far the point was moved at most.
    pub(crate) moved: f64,
}

impl Lack {
    pub(crate) fn new(lcp: &Lcp, (z, w): (&[f64], &[f64]), residual: f64) -> Self {
        let m = lcp.m().to_dense();
        let n = z.len();
        let residual = ROUNDING * residual;
        let (z_max, w_max) = (largest(z), largest(w));
        let unit = |max: f64| if max > 0.0 { max } else { 1.0 };
        let is_zero = |i: usize| z[i] / unit(z_max) <= w[i] / unit(w_max);
        let change = |i: usize| {
            let row = || (0..n).map(|j| m[(i, j)].abs());
            let terms = row().zip(z).map(|(m, z)| m * z.abs()).sum::<f64>();
            let possible = row().fold(0.0, f64::max) * z_max;
            let size = (terms + lcp.q()[i].abs() + w[i].abs()).max(possible.max(w_max) / 1024.0);
            residual * (size + w_max + row().sum::<f64>() * z_max)
        };
        Self {
            z: (0..n).map(|i| if is_zero(i) { 0.0 } else { z[i].max(0.0) }).collect(),
            change: (0..n).map(change).collect(),
            moved: residual * z_max,
        }
    }
}
