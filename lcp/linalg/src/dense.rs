//! The dense linear algebra that the methods need, in terms of faer.

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par, unzip, zip};

use crate::max_abs;

/// An LU factorisation that is known not to be singular to working precision.
#[derive(Debug)]
pub struct Lu(PartialPivLu<f64>);

impl Lu {
    /// Factorises a square matrix; `None` when a pivot vanishes against the largest entry of its column of
    /// `U`, the sign of a singular matrix in an LU with partial pivoting.
    pub fn new(m: MatRef<'_, f64>) -> Option<Self> {
        let lu = m.partial_piv_lu();
        has_pivots(lu.U()).then_some(Self(lu))
    }

    /// Overwrites the right-hand sides with the solutions.
    pub fn solve_in_place(&self, rhs: MatMut<'_, f64>) {
        self.0.solve_in_place(rhs);
    }

    /// Overwrites one right-hand side with the solution.
    pub fn solve_vector(&self, rhs: &mut [f64]) {
        let n = rhs.len();
        self.0.solve_in_place(MatMut::from_column_major_slice_mut(rhs, n, 1));
    }

    /// Overwrites one right-hand side with the solution of the transposed system.
    pub fn solve_transpose_vector(&self, rhs: &mut [f64]) {
        let n = rhs.len();
        self.0.solve_transpose_in_place(MatMut::from_column_major_slice_mut(rhs, n, 1));
    }
}

/// Whether no pivot of an upper triangular factor vanishes against the largest entry of its column.
pub fn has_pivots(u: MatRef<'_, f64>) -> bool {
    let n = u.nrows();
    let tolerance = 4.0 * n as f64 * f64::EPSILON;
    (0..n).all(|k| {
        let largest = (0..=k).fold(0.0_f64, |max, i| max.max(u[(i, k)].abs()));
        let pivot = u[(k, k)].abs();
        pivot.is_finite() && pivot > tolerance * largest
    })
}

/// `out += factor * left * right`, on one thread.
pub fn add_product(
    out: MatMut<'_, f64>,
    factor: f64,
    left: MatRef<'_, f64>,
    right: MatRef<'_, f64>,
) {
    matmul(out, Accum::Add, left, right, factor, Par::Seq);
}

/// Overwrites the right-hand sides with the solutions for a lower triangular matrix whose diagonal is
/// assumed to be one, on one thread.
pub fn solve_unit_lower(matrix: MatRef<'_, f64>, rhs: MatMut<'_, f64>) {
    solve_unit_lower_triangular_in_place(matrix, rhs, Par::Seq);
}

/// Overwrites the right-hand sides with the solutions for an upper triangular matrix.
pub fn solve_upper(matrix: MatRef<'_, f64>, rhs: MatMut<'_, f64>) {
    solve_upper_triangular_in_place(matrix, rhs, Par::Seq);
}

/// LU factorisation in place of a block with row exchanges, which `beside` follows: step `k` exchanges rows
/// `k` and `exchanges[k]`. Pivots below `vanishing` times the largest entry of their column are replaced by
/// that bound; the result is their number. (A column by itself may be small against others and exact
/// nevertheless.)
///
/// Blocks of sparse problems are narrow, so this is as fast as blocked algorithms.
pub fn factorise_block(
    mut block: MatMut<'_, f64>,
    mut beside: MatMut<'_, f64>,
    exchanges: &mut [usize],
    vanishing: f64,
) -> usize {
    const PANEL: usize = 32;
    let n = block.nrows();
    // Most blocks are small: the norm of a library would cost more than the elimination.
    let largest = |max: f64, v: &f64| max.max(v.abs());
    let least: Vec<f64> =
        block.rb().col_iter().map(|column| vanishing * column.iter().fold(0.0, largest)).collect();
    let mut replaced = 0;
    for start in (0..n).step_by(PANEL) {
        let end = n.min(start + PANEL);
        for k in start..end {
            let column = block.rb().col(k).try_as_col_major().map(faer::ColRef::as_slice);
            let column = column.unwrap_or_else(|| unreachable!("blocks are stored by columns"));
            let pivot = (k..n).fold(
                k,
                |best, i| {
                    if column[i].abs() > column[best].abs() { i } else { best }
                },
            );
            exchanges[k] = pivot;
            if pivot != k {
                swap_rows(block.rb_mut(), k, pivot);
                swap_rows(beside.rb_mut(), k, pivot);
            }
            if block[(k, k)].abs() <= least[k] {
                block[(k, k)] = if least[k] > 0.0 { least[k].copysign(block[(k, k)]) } else { 1.0 };
                replaced += 1;
            }
            let inverse = 1.0 / block[(k, k)];
            for i in k + 1..n {
                block[(i, k)] *= inverse;
            }
            let (left, right) = block.rb_mut().split_at_col_mut(k + 1);
            let multipliers = left.rb().subrows(k + 1, n - k - 1).col(k);
            let right = right.subcols_mut(0, end - k - 1);
            for mut column in right.col_iter_mut() {
                let factor = column[k];
                if factor != 0.0 {
                    let below = column.rb_mut().subrows_mut(k + 1, n - k - 1);
                    zip!(below, multipliers).for_each(|unzip!(v, l)| *v -= factor * *l);
                }
            }
        }
        // The panel is finished: the columns to its right follow.
        let (left, right) = block.rb_mut().split_at_col_mut(end);
        let (mut top, below) = right.split_at_row_mut(end);
        let top = top.rb_mut().subrows_mut(start, end - start);
        let panel = left.rb().subcols(start, end - start);
        let mut top = top;
        solve_unit_lower(panel.subrows(start, end - start), top.rb_mut());
        add_product(below, -1.0, panel.subrows(end, n - end), top.rb());
    }
    replaced
}

fn swap_rows(mut matrix: MatMut<'_, f64>, i: usize, j: usize) {
    for mut column in matrix.rb_mut().col_iter_mut() {
        let value = column[i];
        column[i] = column[j];
        column[j] = value;
    }
}

/// Estimate of the 1-norm of the inverse of a matrix of order `n` (Hager 1984; Higham 1988). `solve`
/// overwrites a vector with the solution of the system, or of the transposed one.
pub fn inverse_norm(n: usize, mut solve: impl FnMut(&mut [f64], bool)) -> f64 {
    let mut x = vec![1.0 / n as f64; n];
    let mut estimate = 0.0_f64;
    loop {
        let mut image = x.clone();
        solve(&mut image, false);
        let size: f64 = image.iter().map(|v| v.abs()).sum();
        if size <= estimate {
            return estimate;
        }
        estimate = size;
        if !size.is_finite() {
            return estimate;
        }
        let mut gradient: Vec<f64> = image.iter().map(|v| v.signum()).collect();
        solve(&mut gradient, true);
        let largest = max_abs(&gradient);
        let inner: f64 = gradient.iter().zip(&x).map(|(g, x)| g * x).sum();
        if largest <= inner {
            return estimate;
        }
        x.fill(0.0);
        if let Some(j) = gradient.iter().position(|g| g.abs() >= largest) {
            x[j] = 1.0;
        }
    }
}
