//! Dense matrices of free sets.

use faer::prelude::ReborrowMut;
use faer::{Mat, MatMut, MatRef};

use super::kernel::{Kernel, Outcome, is_vanishing, scales};
use crate::Matrix;
use crate::linear::{Lu, factorise_cholesky, solve_cholesky};
use crate::matrix::Column;

/// Cholesky's method.
pub(super) struct DenseCholesky<'a> {
    m: &'a Matrix,
    free: Vec<usize>,
    /// The lower half of the factor of the free pairs comes first; kept from step to step, and never shrunk.
    factor: Vec<f64>,
}

impl<'a> DenseCholesky<'a> {
    pub(super) fn new(m: &'a Matrix) -> Self {
        Self { m, free: Vec::new(), factor: Vec::new() }
    }
}

impl Kernel for DenseCholesky<'_> {
    fn factorise(&mut self, is_free: &[bool]) -> Outcome {
        self.free = indices(is_free);
        let (free, order) = (&self.free, self.free.len());
        if self.factor.len() < order * order {
            self.factor = vec![0.0; order * order];
        }
        let entries = &mut self.factor[..order * order];
        for (k, (column, &j)) in entries.chunks_exact_mut(order).zip(free).enumerate() {
            picked(self.m.slice(j), &free[k..], &mut column[k..]);
        }
        let mut factor = MatMut::from_column_major_slice_mut(entries, order, order);
        if !factorise_cholesky(factor.rb_mut()) {
            return Outcome::Unsuited;
        }
        let vanishes = |k: usize| is_vanishing(factor[(k, k)], self.m[(free[k], free[k])]);
        if (0..order).any(vanishes) { Outcome::Singular } else { Outcome::Regular }
    }

    fn solve(&mut self, x: &mut [f64]) {
        let order = self.free.len();
        let mut packed: Vec<f64> = self.free.iter().map(|&i| x[i]).collect();
        let factor = &self.factor[..order * order];
        solve_cholesky(MatRef::from_column_major_slice(factor, order, order), &mut packed);
        self.free.iter().zip(packed).for_each(|(&i, v)| x[i] = v);
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
        let mut block = Mat::zeros(free.len(), free.len());
        for (k, &j) in free.iter().enumerate() {
            let column = block.col_as_slice_mut(k);
            picked(self.m.slice(j), free, column);
            column.iter_mut().zip(free).for_each(|(v, &i)| *v = rows[i] * *v * cols[j]);
        }
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

/// The entries of a column in some rows.
fn picked(column: Column<'_>, rows: &[usize], out: &mut [f64]) {
    if let Column::Dense(values) = column {
        out.iter_mut().zip(rows).for_each(|(out, &i)| *out = values[i]);
    }
}

fn indices(is_free: &[bool]) -> Vec<usize> {
    (0..is_free.len()).filter(|&i| is_free[i]).collect()
}
