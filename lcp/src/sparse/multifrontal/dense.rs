//! Dense operations on frontal matrices. Those of large ones are done by panels on all cores; the panels do not depend on
//! the number of cores, so results do not either.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{
    LdltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par, Spec};

use crate::linear::{self, add_product};
use crate::parallel::for_each;

/// Columns of a panel. Measured on a wall of 100 000 bricks: on two cores with 64 to 256 all is as fast.
const PANEL: usize = 128;
/// Operations from which panels are given to several threads. Measured there: with 1e6 to 1e8 all is as fast.
const LARGE: usize = 10_000_000;

/// Overwrites right-hand sides with the solutions for a lower triangular matrix whose diagonal is taken for one.
pub(super) fn solve_unit_lower(matrix: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    let work = matrix.nrows() * matrix.nrows() * right.ncols();
    by_panels(right, work, |panel, _| {
        linear::solve_unit_lower(matrix, panel);
    });
}

/// Overwrites `rows` with the solution of `X U = rows` for an upper triangular matrix `U`.
pub(super) fn solve_right_upper(upper: MatRef<'_, f64>, rows: MatMut<'_, f64>) {
    let work = upper.nrows() * upper.nrows() * rows.nrows();
    by_panels(rows.transpose_mut(), work, |panel, _| {
        solve_lower_triangular_in_place(upper.transpose(), panel, Par::Seq);
    });
}

/// `out -= left * right`
pub(super) fn subtract_product(
    out: MatMut<'_, f64>,
    left: MatRef<'_, f64>,
    right: MatRef<'_, f64>,
) {
    let work = left.nrows() * left.ncols() * right.ncols();
    by_panels(out, work, |panel, at| {
        let right = right.subcols(at, panel.ncols());
        add_product(panel, -1.0, left, right);
    });
}

/// The same for the lower half of a symmetric product.
pub(super) fn subtract_lower_product(
    out: MatMut<'_, f64>,
    left: MatRef<'_, f64>,
    right: MatRef<'_, f64>,
) {
    let work = left.nrows() * left.ncols() * right.ncols() / 2;
    let lower = BlockStructure::TriangularLower;
    let whole = BlockStructure::Rectangular;
    by_panels(out, work, |panel, at| {
        let (rows, width) = (panel.nrows(), panel.ncols());
        let right = right.subcols(at, width);
        let (_, panel) = panel.split_at_row_mut(at);
        let (diagonal, below) = panel.split_at_row_mut(width);
        let here = left.subrows(at, width);
        triangular::matmul(diagonal, lower, Accum::Add, here, whole, right, whole, -1.0, Par::Seq);
        let left = left.subrows(at + width, rows - at - width);
        add_product(below, -1.0, left, right);
    });
}

/// Overwrites the lower half of a symmetric matrix with `D` on the diagonal and `L` below it. Pivots below `vanishing` are
/// replaced by `held`; gives their number.
pub(super) fn factorise_symmetric(block: MatMut<'_, f64>, vanishing: f64, held: f64) -> usize {
    let n = block.nrows();
    let signs = vec![1; n];
    let regularization = LdltRegularization {
        dynamic_regularization_signs: Some(&signs),
        dynamic_regularization_delta: held,
        dynamic_regularization_epsilon: vanishing,
    };
    let scratch = cholesky_in_place_scratch::<f64>(n, Par::Seq, Spec::default());
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    let outcome = cholesky_in_place(block, regularization, Par::Seq, stack, Spec::default());
    let info = outcome.unwrap_or_else(|_| unreachable!("vanishing pivots are replaced"));
    info.dynamic_regularization_count
}

/// Does work for panels of columns, each with the number of its first.
fn by_panels(matrix: MatMut<'_, f64>, work: usize, one: impl Fn(MatMut<'_, f64>, usize) + Sync) {
    if work < LARGE {
        return one(matrix, 0);
    }
    let (mut rest, mut panels, mut at) = (matrix, Vec::new(), 0);
    while rest.ncols() > 0 {
        let width = PANEL.min(rest.ncols());
        let (panel, others) = rest.split_at_col_mut(width);
        panels.push((panel, at));
        (rest, at) = (others, at + width);
    }
    for_each(panels, |(panel, at)| one(panel, at));
}
