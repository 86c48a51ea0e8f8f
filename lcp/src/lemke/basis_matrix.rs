//! The matrix of a complementary basis, factorised.

use faer::Mat;

use super::constants::SAMPLES;
use super::start::Equilibrated;
use crate::certify::ROUNDING;
use crate::linear::{Lu, inverse_norm};
use crate::random::SplitMix;
use crate::sparse::{Columns, SparseLu};
use crate::vector::max_abs;
use crate::{Basis, Side};

/// The equilibrated matrix of a basis.
pub(super) struct BasisMatrix {
    columns: Columns,
    lu: Factors,
}

enum Factors {
    Dense(Lu),
    Sparse(SparseLu),
}

impl BasisMatrix {
    /// `None` when the matrix is singular to working precision.
    pub(super) fn new(problem: &Equilibrated<'_>, basis: &Basis) -> Option<Self> {
        let columns: Vec<_> = basis.sides().iter().copied().enumerate().map(Some).collect();
        Self::from_columns(problem, &columns)
    }

    /// Of any columns, as many as there are rows; none is the right-hand side.
    pub(super) fn from_columns(
        problem: &Equilibrated<'_>,
        columns: &[Option<(usize, Side)>],
    ) -> Option<Self> {
        let sparse = problem.sparse_columns(columns.iter().copied());
        let lu = if problem.problem.is_sparse() {
            let (lu, replaced) = SparseLu::new(&sparse);
            Factors::Sparse(Some(lu).filter(|_| replaced.is_empty())?)
        } else {
            let mut dense = Mat::zeros(columns.len(), columns.len());
            for j in 0..columns.len() {
                sparse.add_to(j, 1.0, dense.col_as_slice_mut(j));
            }
            Factors::Dense(Lu::new(dense.as_ref())?)
        };
        Some(Self { columns: sparse, lu })
    }

    pub(super) fn solve(&self, x: &mut [f64]) {
        match &self.lu {
            Factors::Dense(lu) => lu.solve_vector(x),
            Factors::Sparse(lu) => lu.solve(x, &mut Vec::new()),
        }
    }

    pub(super) fn solve_transpose(&self, x: &mut [f64]) {
        match &self.lu {
            Factors::Dense(lu) => lu.solve_transpose_vector(x),
            Factors::Sparse(lu) => lu.solve_transpose(x, &mut Vec::new()),
        }
    }

    /// Calls with `(position, row, entry)` for all entries that are not zero.
    fn for_each(&self, mut f: impl FnMut(usize, usize, f64)) {
        let columns = &self.columns;
        (0..columns.len()).for_each(|j| columns.entries(j).for_each(|(i, v)| f(j, i, v)));
    }

    /// `right - M (x + low)` with twice the working precision (Ogita, Rump and Oishi 2005).
    pub(super) fn residual(&self, right: &[f64], x: &[f64], low: &[f64]) -> Vec<f64> {
        let mut high = right.to_vec();
        let mut error = vec![0.0; right.len()];
        let mut add = |i: usize, a: f64, b: f64| {
            let product = a * b;
            let product_error = a.mul_add(b, -product);
            let sum = high[i] + product;
            let part = sum - high[i];
            error[i] += (high[i] - (sum - part)) + (product - part) + product_error;
            high[i] = sum;
        };
        self.for_each(|j, i, v| {
            add(i, -v, x[j]);
            if low[j] != 0.0 {
                add(i, -v, low[j]);
            }
        });
        high.iter().zip(&error).map(|(high, error)| high + error).collect()
    }

    /// Row `position` of the inverse, refined, without the rounding errors in place of zeros.
    pub(super) fn inverse_row(&self, position: usize) -> Vec<f64> {
        let n = self.columns.len();
        let mut y = vec![0.0; n];
        y[position] = 1.0;
        self.solve_transpose(&mut y);
        let (mut step, mut sizes) = (vec![0.0; n], vec![0.0; n]);
        step[position] = 1.0;
        self.for_each(|j, i, v| {
            step[j] -= v * y[i];
            sizes[j] += (v * y[i]).abs();
        });
        self.solve_transpose(&mut step);
        let errors = sampled(&sizes, |sample| self.solve_transpose(sample));
        // What refinement has made smaller and smaller is below the error of nothing.
        let least = f64::EPSILON * f64::EPSILON * max_abs(&y);
        let refined = y.iter().zip(&step).map(|(y, step)| y + step);
        refined
            .zip(errors)
            .map(|(y, error)| if y.abs() > error.max(least) { y } else { 0.0 })
            .collect()
    }

    /// Estimate of the condition number in the 1-norm.
    pub(super) fn condition(&self) -> f64 {
        let n = self.columns.len();
        if n == 0 {
            return 1.0;
        }
        let mut sums = vec![0.0; n];
        self.for_each(|j, _, v| sums[j] += v.abs());
        let norm =
            inverse_norm(
                n,
                |x, is_transposed| {
                    if is_transposed { self.solve_transpose(x) } else { self.solve(x) }
                },
            );
        norm * max_abs(&sums)
    }
}

/// Solutions for random right-hand sides of rounding size: the largest of each entry. Sizes are random
/// too, since signs alone cancel now and then.
fn sampled(sizes: &[f64], solve: impl Fn(&mut [f64])) -> Vec<f64> {
    let mut errors = vec![0.0_f64; sizes.len()];
    for seed in 0..SAMPLES {
        let mut random = SplitMix::new(seed);
        let draw = |size: &f64| ROUNDING * size * (2.0 * random.next_f64() - 1.0);
        let mut sample: Vec<f64> = sizes.iter().map(draw).collect();
        solve(&mut sample);
        errors.iter_mut().zip(sample).for_each(|(error, it)| *error = error.max(it.abs()));
    }
    errors
}
