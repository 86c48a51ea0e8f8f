//! Residuals and distances, computed here and not by the library.

use faer::Mat;
use faer::sparse::{SparseColMat, Triplet};
use lcp::{BoxedLcp, HorizontalLcp, Lcp, Matrix};

/// That a residual is measured here in a simpler way, which differs where terms are small against the loads.
pub(crate) const ROUNDING: f64 = 2.0;

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

/// The largest residual of a point of the general problem `A t + B y = c`: what is left of a row relative to its terms,
/// and of every pair the smaller one of what its variables are of the terms of their rows. Rows whose terms
/// are below a sixteenth of the largest right-hand side are measured by that, which fits problems whose entries are near
/// one.
pub(crate) fn worst_of_general(problem: &HorizontalLcp, t: &[f64], y: &[f64]) -> f64 {
    let (a, b) = (problem.a().to_dense(), problem.b().to_dense());
    let n = t.len();
    let terms = |i: usize| (0..n).flat_map(|j| [a[(i, j)] * t[j], b[(i, j)] * y[j]]).collect();
    let terms: Vec<Vec<f64>> = (0..n).map(terms).collect();
    let least = largest(problem.c()) / 16.0;
    let size = |i: usize| {
        let sum: f64 = terms[i].iter().map(|v| v.abs()).sum();
        (sum + problem.c()[i].abs()).max(least)
    };
    let sizes: Vec<f64> = (0..n).map(size).collect();
    let part = |v: f64, size: f64| if v == 0.0 { 0.0 } else { v.abs() / size };
    let row = |i: usize| part(terms[i].iter().sum::<f64>() - problem.c()[i], sizes[i]);
    let effect = |m: &Mat<f64>, j: usize, v: f64| {
        (0..n).map(|i| part(m[(i, j)] * v, sizes[i])).fold(0.0, f64::max)
    };
    let pair = |j: usize| {
        let (of_t, of_y) = (effect(&a, j, t[j]), effect(&b, j, y[j]));
        match (t[j] < 0.0, y[j] < 0.0) {
            (false, false) => of_t.min(of_y),
            (true, false) => of_t,
            (false, true) => of_y,
            (true, true) => of_t.max(of_y),
        }
    };
    (0..n).map(row).chain((0..n).map(pair)).fold(0.0, f64::max)
}

/// The same of `(z, w)` of a boxed problem: rows `w - M z - q`, and at every bound its distance with the part of `w`
/// that it allows.
pub(crate) fn worst_of_boxed(boxed: &BoxedLcp, z: &[f64], w: &[f64]) -> f64 {
    let (m, n) = (boxed.m().to_dense(), z.len());
    let terms = |i: usize| (0..n).map(|j| m[(i, j)] * z[j]).chain([boxed.q()[i]]).collect();
    let terms: Vec<Vec<f64>> = (0..n).map(terms).collect();
    let size = |i: usize| w[i].abs() + terms[i].iter().map(|v| v.abs()).sum::<f64>();
    let sizes: Vec<f64> = (0..n).map(size).collect();
    let least = largest(&sizes) / 1024.0;
    let part = |v: f64, i: usize| if v == 0.0 { 0.0 } else { v.abs() / sizes[i].max(least) };
    let row = |i: usize| part(w[i] - terms[i].iter().sum::<f64>(), i);
    let moved = |j: usize, by: f64| (0..n).map(|i| part(m[(i, j)] * by, i)).fold(0.0, f64::max);
    let condition = |j: usize, distance: f64, w: f64| {
        if !distance.is_finite() {
            part(w, j)
        } else if distance < 0.0 {
            moved(j, distance)
        } else {
            moved(j, distance).min(part(w, j))
        }
    };
    let of_bounds = |j: usize| {
        let below = condition(j, z[j] - boxed.lower()[j], w[j].max(0.0));
        below.max(condition(j, boxed.upper()[j] - z[j], (-w[j]).max(0.0)))
    };
    (0..n).map(row).chain((0..n).map(of_bounds)).fold(0.0, f64::max)
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
