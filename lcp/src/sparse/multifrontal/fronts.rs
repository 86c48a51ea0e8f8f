//! The numerical part: frontal matrices one after the other, and the solves with their factors.

use faer::{MatMut, MatRef};

use super::analysis::{Analysis, Supernode};
use crate::linear::{add_product, factorise_block, solve_right_upper, solve_unit_lower};

/// Pivots below this multiple of the largest entry of their column of the block are replaced by it.
const VANISHING: f64 = 1e-15;

/// The factors of all supernodes.
pub(super) struct Fronts {
    factors: Vec<Factor>,
    /// The frontal matrix in work.
    front: Vec<f64>,
    /// Whether the determinant of the last matrix is negative.
    is_negative: bool,
}

/// The factors of a supernode: rows of its block exchanged, `L` and `U` of the block in one, the rows of
/// `L` below it, and the columns of `U` to the right.
#[derive(Default)]
struct Factor {
    /// The row of the block that became each row.
    rows: Vec<usize>,
    /// `order x width`, columns one after the other.
    lower: Vec<f64>,
    /// `width x rows below`.
    upper: Vec<f64>,
}

impl Fronts {
    pub(super) fn new(analysis: &Analysis) -> Self {
        let factor = |node: &Supernode| Factor {
            rows: vec![0; node.width],
            lower: vec![0.0; node.order() * node.width],
            upper: vec![0.0; node.width * node.rows.len()],
        };
        let largest = analysis.supernodes.iter().map(Supernode::order).max().unwrap_or(0);
        Self {
            factors: analysis.supernodes.iter().map(factor).collect(),
            front: vec![0.0; largest * largest],
            is_negative: false,
        }
    }

    pub(super) fn factorise(&mut self, analysis: &Analysis, values: &[f64]) -> usize {
        let mut replaced = 0;
        // What every supernode leaves for its parent, until that is assembled.
        let mut left: Vec<Vec<f64>> = vec![Vec::new(); analysis.supernodes.len()];
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); analysis.supernodes.len()];
        for (s, node) in analysis.supernodes.iter().enumerate() {
            let order = node.order();
            let front = &mut self.front[..order * order];
            front.fill(0.0);
            for entry in &node.entries {
                front[entry.row as usize + order * entry.col as usize] +=
                    values[entry.position as usize];
            }
            for child in std::mem::take(&mut children[s]) {
                let update = std::mem::take(&mut left[child]);
                extend_add(front, order, &update, &analysis.places[child]);
            }
            replaced += eliminate(front, node, &mut self.factors[s]);
            if let Some(parent) = node.parent {
                left[s] = remainder(front, node);
                children[parent].push(s);
            }
        }
        self.is_negative =
            self.factors.iter().fold(false, |negative, factor| negative ^ factor.is_negative());
        replaced
    }

    pub(super) fn is_negative(&self) -> bool {
        self.is_negative
    }

    pub(super) fn solve(&self, analysis: &Analysis, x: &mut [f64]) {
        let mut ordered: Vec<f64> = analysis.order.iter().map(|&i| x[i]).collect();
        let largest = analysis.supernodes.iter().map(|node| node.width).max().unwrap_or(0);
        let mut block = vec![0.0; largest];
        for (node, factor) in analysis.supernodes.iter().zip(&self.factors) {
            factor.forward(node, &mut ordered, &mut block);
        }
        for (node, factor) in analysis.supernodes.iter().zip(&self.factors).rev() {
            factor.backward(node, &mut ordered);
        }
        analysis.order.iter().zip(&ordered).for_each(|(&i, value)| x[i] = *value);
    }
}

/// Adds what a child left to the frontal matrix of its parent.
fn extend_add(front: &mut [f64], order: usize, update: &[f64], places: &[u32]) {
    for (column, &j) in update.chunks_exact(places.len()).zip(places) {
        let target = &mut front[order * j as usize..][..order];
        column.iter().zip(places).for_each(|(v, &i)| target[i as usize] += v);
    }
}

/// Eliminates the columns of a supernode in its frontal matrix and stores the factors. What is left
/// stands in the lower right corner.
fn eliminate(front: &mut [f64], node: &Supernode, factor: &mut Factor) -> usize {
    let (width, order) = (node.width, node.order());
    let matrix = MatMut::from_column_major_slice_mut(front, order, order);
    let (left, right) = matrix.split_at_col_mut(width);
    let (mut block, mut below) = left.split_at_row_mut(width);
    let (mut beside, corner) = right.split_at_row_mut(width);
    let replaced = factorise_block(block.as_mut(), beside.as_mut(), &mut factor.rows, VANISHING);
    solve_right_upper(block.as_ref(), below.as_mut());
    solve_unit_lower(block.as_ref(), beside.as_mut());
    add_product(corner, -1.0, below.as_ref(), beside.as_ref());
    factor.lower.copy_from_slice(&front[..order * width]);
    let columns = front[order * width..].chunks_exact(order);
    for (stored, column) in factor.upper.chunks_exact_mut(width).zip(columns) {
        stored.copy_from_slice(&column[..width]);
    }
    replaced
}

/// The lower right corner of an eliminated frontal matrix.
fn remainder(front: &[f64], node: &Supernode) -> Vec<f64> {
    let (width, order) = (node.width, node.order());
    let mut left = Vec::with_capacity(node.rows.len() * node.rows.len());
    for column in front[order * width..].chunks_exact(order) {
        left.extend_from_slice(&column[width..]);
    }
    left
}

impl Factor {
    /// Whether the determinant of the block is negative.
    fn is_negative(&self) -> bool {
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

    fn forward(&self, node: &Supernode, x: &mut [f64], block: &mut [f64]) {
        let (width, order) = (node.width, node.order());
        let block = &mut block[..width];
        block.iter_mut().zip(&self.rows).for_each(|(b, row)| *b = x[node.start + row]);
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

    fn backward(&self, node: &Supernode, x: &mut [f64]) {
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
        crate::linear::solve_upper(lower.subrows(0, width), block);
    }
}
