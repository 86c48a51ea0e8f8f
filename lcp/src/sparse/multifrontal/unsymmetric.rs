//! Factors `L U` with exchanges of rows inside a supernode.

use faer::{MatMut, MatRef};

use super::analysis::Supernode;
use super::dense::{solve_right_upper, solve_unit_lower, subtract_product};
use super::fronts::Factor;
use crate::linear::{factorise_block, solve_upper};

/// Pivots below this multiple of the largest entry of their column of the block are replaced by it.
const VANISHING: f64 = 1e-15;

/// Rows of its block exchanged, `L` and `U` of the block in one, the rows of `L` below it, and the columns of `U` to the
/// right.
pub(super) struct Unsymmetric {
    /// The row of the block that became each row.
    rows: Vec<usize>,
    /// `order x width`, columns one after the other.
    lower: Vec<f64>,
    /// `width x rows below`.
    upper: Vec<f64>,
}

impl Factor for Unsymmetric {
    const IS_SYMMETRIC: bool = false;

    fn of(node: &Supernode) -> Self {
        Self {
            rows: vec![0; node.width],
            lower: vec![0.0; node.order() * node.width],
            upper: vec![0.0; node.width * node.rows.len()],
        }
    }

    fn eliminate(&mut self, node: &Supernode, front: &mut [f64]) -> usize {
        let (width, order) = (node.width, node.order());
        let matrix = MatMut::from_column_major_slice_mut(front, order, order);
        let (left, right) = matrix.split_at_col_mut(width);
        let (mut block, mut below) = left.split_at_row_mut(width);
        let (mut beside, corner) = right.split_at_row_mut(width);
        let replaced = factorise_block(block.as_mut(), beside.as_mut(), &mut self.rows, VANISHING);
        solve_right_upper(block.as_ref(), below.as_mut());
        solve_unit_lower(block.as_ref(), beside.as_mut());
        subtract_product(corner, below.as_ref(), beside.as_ref());
        self.lower.copy_from_slice(&front[..order * width]);
        let columns = front[order * width..].chunks_exact(order);
        for (stored, column) in self.upper.chunks_exact_mut(width).zip(columns) {
            stored.copy_from_slice(&column[..width]);
        }
        replaced
    }

    fn forward(&self, node: &Supernode, x: &mut [f64], block: &mut Vec<f64>) {
        let (width, order) = (node.width, node.order());
        block.clear();
        block.extend(self.rows.iter().map(|row| x[node.start + row]));
        for (j, column) in self.lower.chunks_exact(order).enumerate() {
            let pivot = block[j];
            if pivot == 0.0 {
                continue;
            }
            block[j + 1..].iter_mut().zip(&column[j + 1..width]).for_each(|(b, v)| *b -= v * pivot);
            for (v, &row) in column[width..].iter().zip(&node.rows) {
                x[row as usize] -= v * pivot;
            }
        }
        x[node.start..node.start + width].copy_from_slice(block);
    }

    fn backward(&self, node: &Supernode, x: &mut [f64], _: &mut Vec<f64>) {
        let (width, order) = (node.width, node.order());
        let (head, tail) = x.split_at_mut(node.start + width);
        let block = &mut head[node.start..];
        for (column, &row) in self.upper.chunks_exact(width).zip(&node.rows) {
            let value = tail[row as usize - node.start - width];
            if value != 0.0 {
                block.iter_mut().zip(column).for_each(|(b, v)| *b -= v * value);
            }
        }
        let block = MatMut::from_column_major_slice_mut(block, width, 1);
        let lower = MatRef::from_column_major_slice(&self.lower, order, width);
        solve_upper(lower.subrows(0, width), block);
    }
}

impl Unsymmetric {
    /// Whether the determinant of the block is negative.
    pub(super) fn is_negative(&self) -> bool {
        let width = self.rows.len();
        let order = self.lower.len() / width.max(1);
        let pivots = (0..width).filter(|k| self.lower[k * (order + 1)] < 0.0).count();
        if self.rows.iter().enumerate().all(|(i, row)| i == *row) {
            return pivots % 2 == 1;
        }
        // A cycle of even length is an odd number of exchanges.
        let mut seen = vec![false; width];
        let mut exchanges = 0;
        for first in 0..width {
            let mut row = first;
            while !std::mem::replace(&mut seen[row], true) {
                row = self.rows[row];
                exchanges += usize::from(row != first);
            }
        }
        (pivots + exchanges) % 2 == 1
    }
}
