//! Factorisations of the matrices of free sets.

use faer::linalg::solvers::Solve as _;
use faer::{Mat, MatMut, Side};

use crate::Matrix;
use crate::divide::block;
use crate::linear::Lu;
use crate::matrix::{Column, Storage};
use crate::scaling::equilibrate;
use crate::sparse::{Cholesky, Columns, SparseLu, solve_refined};
use crate::vector::SMALL;

/// Factors of `M_FF`, dense or sparse like `M`: those of Cholesky where the matrix is symmetric and positive definite, else LU.
pub(super) struct Factors<'a> {
    m: &'a Matrix,
    is_symmetric: bool,
    free: Vec<usize>,
    block: Matrix,
    solve: Option<Solve>,
    /// How many factorisations there were.
    pub(super) count: usize,
}

/// Overwrites a right-hand side with the solution.
type Solve = Box<dyn Fn(&mut [f64])>;

impl<'a> Factors<'a> {
    pub(super) fn new(m: &'a Matrix) -> Self {
        let is_symmetric = m.check_symmetric("M").is_ok();
        let block = block(m, &[], &[]);
        Self { m, is_symmetric, free: Vec::new(), block, solve: None, count: 0 }
    }

    /// Factorises the matrix of some pairs, at least one; `false` where it is singular to working precision.
    pub(super) fn factorise(&mut self, is_free: &[bool]) -> bool {
        self.free = (0..is_free.len()).filter(|&i| is_free[i]).collect();
        self.block = block(self.m, &self.free, &self.free);
        self.count += 1;
        if self.is_symmetric {
            if let Some((pivots, solve)) = cholesky(&self.block) {
                self.solve = Some(solve);
                let mut pivots = pivots.into_iter().enumerate();
                return pivots.all(|(k, pivot)| pivot > SMALL * self.block[(k, k)]);
            }
            self.count += 1;
        }
        self.solve = lu(&self.block);
        self.solve.is_some()
    }

    /// Overwrites a right-hand side, zero for pairs that are not free, with the solution for the last factorisation.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let Some(solve) = &self.solve else { return };
        let mut packed: Vec<f64> = self.free.iter().map(|&i| x[i]).collect();
        solve_refined(&mut packed, f64::EPSILON, solve, |x, rest| {
            x.iter().enumerate().for_each(|(j, x)| self.block.slice(j).add_to(-x, rest));
        });
        self.free.iter().zip(packed).for_each(|(&i, v)| x[i] = v);
    }
}

/// The pivots of a symmetric matrix; `None` where it is not positive definite, or memory does not suffice.
fn cholesky(block: &Matrix) -> Option<(Vec<f64>, Solve)> {
    let n = block.ncols();
    let (pivots, solve): (Vec<f64>, Solve) = match block.storage() {
        Storage::Sparse(block) => {
            let mut factors = Cholesky::new(block.symbolic()).ok()?;
            factors.factorise(block.as_ref())?;
            (factors.pivots(), Box::new(move |x| factors.solve(x)))
        }
        Storage::Dense(block) => {
            let factors = block.llt(Side::Lower).ok()?;
            let pivots = (0..n).map(|k| factors.L()[(k, k)].powi(2)).collect();
            let solve = move |x: &mut [f64]| {
                factors.solve_in_place(MatMut::from_column_major_slice_mut(x, n, 1));
            };
            (pivots, Box::new(solve))
        }
    };
    pivots.iter().all(|pivot| *pivot > 0.0).then_some((pivots, solve))
}

/// Solves by LU factors of the matrix with entries near one; `None` if it is singular.
fn lu(block: &Matrix) -> Option<Solve> {
    let n = block.ncols();
    let columns: Vec<Column<'_>> = (0..n).map(|k| block.slice(k)).collect();
    let (rows, cols) = equilibrate(n, &columns);
    let solve: Solve = if block.is_sparse() {
        let mut scaled = Columns::default();
        for (column, unit) in columns.iter().zip(&cols) {
            column.for_each(|i, v| scaled.push(i, rows[i] * v * unit));
            scaled.close();
        }
        let (factors, replaced) = SparseLu::new(&scaled);
        if !replaced.is_empty() {
            return None;
        }
        Box::new(move |x| factors.solve(x, &mut Vec::new()))
    } else {
        let scaled = Mat::from_fn(n, n, |i, j| rows[i] * block[(i, j)] * cols[j]);
        let factors = Lu::new(scaled.as_ref())?;
        Box::new(move |x| factors.solve_vector(x))
    };
    let multiply = |x: &mut [f64], by: &[f64]| x.iter_mut().zip(by).for_each(|(x, by)| *x *= by);
    Some(Box::new(move |x| {
        multiply(x, &rows);
        solve(x);
        multiply(x, &cols);
    }))
}
