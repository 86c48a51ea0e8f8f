//! Dense matrices of free sets.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, MatMut, Side};

use super::kernel::{Kernel, Outcome, is_vanishing, scales};
use crate::Matrix;
use crate::linear::Lu;

/// Cholesky's method.
pub(super) struct DenseCholesky<'a> {
    m: &'a Matrix,
    free: Vec<usize>,
    factor: Option<Llt<f64>>,
}

impl<'a> DenseCholesky<'a> {
    pub(super) fn new(m: &'a Matrix) -> Self {
        Self { m, free: Vec::new(), factor: None }
    }
}

impl Kernel for DenseCholesky<'_> {
    fn factorise(&mut self, is_free: &[bool]) -> Outcome {
        self.free = indices(is_free);
        let free = &self.free;
        let block = Mat::from_fn(free.len(), free.len(), |i, j| self.m[(free[i], free[j])]);
        self.factor = Llt::new(block.as_ref(), Side::Lower).ok();
        let Some(factor) = &self.factor else { return Outcome::Unsuited };
        let l = factor.L();
        if (0..free.len()).any(|k| is_vanishing(l[(k, k)], block[(k, k)])) {
            return Outcome::Singular;
        }
        Outcome::Regular
    }

    fn solve(&mut self, x: &mut [f64]) {
        if let Some(factor) = &self.factor {
            let mut packed: Vec<f64> = self.free.iter().map(|&i| x[i]).collect();
            let order = packed.len();
            factor.solve_in_place(MatMut::from_column_major_slice_mut(&mut packed, order, 1));
            self.free.iter().zip(packed).for_each(|(&i, v)| x[i] = v);
        }
    }
}

/// LU with partial pivoting, after equilibration.
pub(super) struct DenseLu<'a> {
    m: &'a Matrix,
    scales: (Vec<f64>, Vec<f64>),
    free: Vec<usize>,
    factor: Option<Lu>,
}

impl<'a> DenseLu<'a> {
    pub(super) fn new(m: &'a Matrix) -> Self {
        Self { m, scales: scales(m), free: Vec::new(), factor: None }
    }
}

impl Kernel for DenseLu<'_> {
    fn factorise(&mut self, is_free: &[bool]) -> Outcome {
        self.free = indices(is_free);
        let (free, (rows, cols)) = (&self.free, &self.scales);
        let entry = |i: usize, j: usize| rows[i] * self.m[(i, j)] * cols[j];
        let block = Mat::from_fn(free.len(), free.len(), |i, j| entry(free[i], free[j]));
        self.factor = Lu::new(block.as_ref());
        if self.factor.is_some() { Outcome::Regular } else { Outcome::Singular }
    }

    fn solve(&mut self, x: &mut [f64]) {
        if let Some(factor) = &self.factor {
            let (rows, cols) = &self.scales;
            let mut packed: Vec<f64> = self.free.iter().map(|&i| rows[i] * x[i]).collect();
            factor.solve_vector(&mut packed);
            self.free.iter().zip(packed).for_each(|(&i, v)| x[i] = cols[i] * v);
        }
    }
}

fn indices(is_free: &[bool]) -> Vec<usize> {
    (0..is_free.len()).filter(|&i| is_free[i]).collect()
}
