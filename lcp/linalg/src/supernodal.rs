//! LU factorisation of sparse matrices with a symmetric pattern and unsymmetric values.

use std::ops::Range;

use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SymbolicSparseColMatRef};
use faer::{MatMut, MatRef, Par, Side};

use crate::VANISHING;
use crate::dense::{add_product, factorise_block, solve_unit_lower, solve_upper};

/// LU factors of matrices with one symmetric pattern and unsymmetric values, again and again for other values:
/// supernodes in an order of approximate minimum degree, each with the rows of a Cholesky factorisation of the pattern.
///
/// Pivots are exchanged within a supernode only, so that pattern, order and memory never change. A pivot that vanishes
/// against its column is replaced by a small one, which the caller has to correct by iterative refinement. The cost is
/// that of two sparse Cholesky factorisations of the pattern, nearly all of it in dense matrix products.
pub struct SupernodalLu {
    /// The variable at every place of the order.
    order: Vec<usize>,
    nodes: Vec<Supernode>,
    /// The place of every entry of the matrix among the values.
    places: Vec<usize>,
    /// The factors of one supernode after the other.
    values: Vec<f64>,
    /// The place that every pivot was exchanged with.
    exchanges: Vec<usize>,
}

/// Columns that are eliminated together, and the rows below them, increasing; places of the order.
struct Supernode {
    columns: Range<usize>,
    rows: Vec<usize>,
    /// The first of its values: `L` with the block of the columns on top, by columns, then the rows of `U` to the right
    /// of the block, by columns.
    begin: usize,
    /// The supernodes before it that have rows among its columns.
    earlier: Vec<Earlier>,
}

/// A supernode, and those of its rows that are columns of another.
struct Earlier {
    node: usize,
    rows: Range<usize>,
}

impl Supernode {
    fn width(&self) -> usize {
        self.columns.len()
    }

    /// Rows of `L`.
    fn order(&self) -> usize {
        self.width() + self.rows.len()
    }

    fn lower<'a>(&self, values: &'a [f64]) -> &'a [f64] {
        &values[self.begin..][..self.order() * self.width()]
    }

    fn upper<'a>(&self, values: &'a [f64]) -> &'a [f64] {
        &values[self.begin + self.order() * self.width()..][..self.width() * self.rows.len()]
    }

    /// The row of `L` at a place.
    fn local(&self, place: usize) -> usize {
        if self.columns.contains(&place) {
            return place - self.columns.start;
        }
        let found = self.rows.binary_search(&place);
        self.width() + found.unwrap_or_else(|_| unreachable!("the pattern has all entries"))
    }

    /// The place of an entry in a row or a column of the supernode.
    fn place(&self, row: usize, col: usize) -> usize {
        let (order, width) = (self.order(), self.width());
        if self.columns.contains(&col) {
            return self.begin + order * (col - self.columns.start) + self.local(row);
        }
        self.begin + order * width + width * (self.local(col) - width) + row - self.columns.start
    }
}

impl SupernodalLu {
    /// Plans factors for the pattern of a square matrix, which must contain every diagonal entry and the mirrored one
    /// of every entry.
    ///
    /// # Errors
    /// If memory does not suffice.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let n = pattern.ncols();
        let symbolic =
            factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params)?;
        let order: Vec<usize> =
            symbolic.perm().map_or_else(|| (0..n).collect(), |it| it.arrays().0.to_vec());
        let (mut nodes, mut stored) = (Vec::new(), 0);
        let mut add = |columns: Range<usize>, rows: &[usize]| {
            let node =
                Supernode { columns, rows: rows.to_vec(), begin: stored, earlier: Vec::new() };
            stored += node.width() * (node.order() + node.rows.len());
            nodes.push(node);
        };
        match symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(raw) => (0..raw.n_supernodes()).for_each(|s| {
                let columns = raw.supernode_begin()[s]..raw.supernode_end()[s];
                add(columns, raw.supernode(s).pattern());
            }),
            // Only a diagonal matrix has no supernodes.
            SymbolicCholeskyRaw::Simplicial(_) => (0..n).for_each(|j| add(j..j + 1, &[])),
        }
        let mut node_of = vec![0; n];
        for (s, node) in nodes.iter().enumerate() {
            node_of[node.columns.clone()].fill(s);
        }
        for node in 0..nodes.len() {
            let mut from = 0;
            while let Some(&row) = nodes[node].rows.get(from) {
                let later = node_of[row];
                let end = nodes[later].columns.end;
                let end = nodes[node].rows.partition_point(|&row| row < end);
                nodes[later].earlier.push(Earlier { node, rows: from..end });
                from = end;
            }
        }
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(at, &i)| place[i] = at);
        let entries =
            (0..n).flat_map(|j| pattern.row_idx_of_col_raw(j).iter().map(move |&i| (i, j)));
        let places = entries.map(|(i, j)| (place[i], place[j]));
        let places = places.map(|(i, j)| nodes[node_of[i.min(j)]].place(i, j)).collect();
        Ok(Self { order, nodes, places, values: vec![0.0; stored], exchanges: vec![0; n] })
    }

    /// Factorises for the values of the entries, in the order of the pattern, and returns the number of pivots that
    /// were replaced.
    pub fn factorise(&mut self, values: &[f64]) -> usize {
        let Self { order, nodes, places, values: factors, exchanges } = self;
        factors.fill(0.0);
        places.iter().zip(values).for_each(|(&place, v)| factors[place] += v);
        let mut work = Work { local: vec![0; order.len()], product: Vec::new() };
        let mut replaced = 0;
        for node in &*nodes {
            let (before, own) = factors.split_at_mut(node.begin);
            let (lower, upper) = own.split_at_mut(node.order() * node.width());
            let upper = &mut upper[..node.width() * node.rows.len()];
            let mut front = Front { node, lower, upper };
            let places = node.columns.clone().chain(node.rows.iter().copied());
            places.enumerate().for_each(|(k, place)| work.local[place] = k);
            for earlier in &node.earlier {
                work.subtract(&mut front, &nodes[earlier.node], &earlier.rows, before);
            }
            replaced += front.eliminate(&mut exchanges[node.columns.clone()]);
        }
        replaced
    }

    /// Whether the determinant of the last factorised matrix is negative.
    pub fn is_negative(&self) -> bool {
        let mut is_negative = false;
        for node in &self.nodes {
            let lower = node.lower(&self.values);
            for (k, &exchanged) in self.exchanges[node.columns.clone()].iter().enumerate() {
                is_negative ^= (lower[k * (node.order() + 1)] < 0.0) ^ (exchanged != k);
            }
        }
        is_negative
    }

    /// Overwrites a right-hand side with the solution for the last factorisation.
    pub fn solve(&self, x: &mut [f64]) {
        let mut ordered: Vec<f64> = self.order.iter().map(|&i| x[i]).collect();
        self.nodes.iter().for_each(|node| self.solve_lower(node, &mut ordered));
        self.nodes.iter().rev().for_each(|node| self.solve_upper(node, &mut ordered));
        ordered.into_iter().zip(&self.order).for_each(|(v, &i)| x[i] = v);
    }

    fn solve_lower(&self, node: &Supernode, x: &mut [f64]) {
        let (head, below) = x.split_at_mut(node.columns.end);
        let block = &mut head[node.columns.start..];
        for (k, &exchanged) in self.exchanges[node.columns.clone()].iter().enumerate() {
            block.swap(k, exchanged);
        }
        let width = block.len();
        for (j, column) in node.lower(&self.values).chunks_exact(node.order()).enumerate() {
            let pivot = block[j];
            if pivot == 0.0 {
                continue;
            }
            block[j + 1..].iter_mut().zip(&column[j + 1..width]).for_each(|(b, v)| *b -= v * pivot);
            for (v, row) in column[width..].iter().zip(&node.rows) {
                below[row - node.columns.end] -= v * pivot;
            }
        }
    }

    fn solve_upper(&self, node: &Supernode, x: &mut [f64]) {
        let (head, below) = x.split_at_mut(node.columns.end);
        let block = &mut head[node.columns.start..];
        let width = block.len();
        for (column, row) in node.upper(&self.values).chunks_exact(width).zip(&node.rows) {
            let value = below[row - node.columns.end];
            if value != 0.0 {
                block.iter_mut().zip(column).for_each(|(b, v)| *b -= v * value);
            }
        }
        let lower = MatRef::from_column_major_slice(node.lower(&self.values), node.order(), width);
        solve_upper(lower.subrows(0, width), MatMut::from_column_major_slice_mut(block, width, 1));
    }
}

/// The entries in the columns and rows of a supernode, which are overwritten by its factors.
struct Front<'a> {
    node: &'a Supernode,
    lower: &'a mut [f64],
    upper: &'a mut [f64],
}

impl Front<'_> {
    /// Eliminates the block and returns the number of pivots that were replaced.
    fn eliminate(&mut self, exchanges: &mut [usize]) -> usize {
        let (order, width) = (self.node.order(), self.node.width());
        let lower = MatMut::from_column_major_slice_mut(self.lower, order, width);
        let (mut block, below) = lower.split_at_row_mut(width);
        let mut beside = MatMut::from_column_major_slice_mut(self.upper, width, order - width);
        let replaced = factorise_block(block.rb_mut(), beside.rb_mut(), exchanges, VANISHING);
        // `X U = below`.
        let block = block.rb();
        solve_lower_triangular_in_place(block.transpose(), below.transpose_mut(), Par::Seq);
        solve_unit_lower(block, beside);
        replaced
    }
}

/// Memory of a factorisation.
struct Work {
    /// The row of `L` of the present supernode at every place.
    local: Vec<usize>,
    product: Vec<f64>,
}

impl Work {
    /// Subtracts the update by the elimination of another supernode, some rows of which are columns of the present one.
    fn subtract(
        &mut self,
        front: &mut Front<'_>,
        other: &Supernode,
        rows: &Range<usize>,
        values: &[f64],
    ) {
        let (inner, left) = (other.width(), other.rows.len() - rows.start);
        let lower = MatRef::from_column_major_slice(other.lower(values), other.order(), inner);
        let lower = lower.subrows(inner + rows.start, left);
        let upper = MatRef::from_column_major_slice(other.upper(values), inner, other.rows.len());
        let (beside, right) = upper.subcols(rows.start, left).split_at_col(rows.len());
        let (order, width) = (front.node.order(), front.node.width());
        let local = |&place: &usize| self.local[place];
        let local: Vec<usize> = other.rows[rows.start..].iter().map(local).collect();
        multiply(&mut self.product, lower, beside);
        for (column, j) in self.product.chunks_exact(left).zip(&local) {
            let out = &mut front.lower[order * j..][..order];
            local.iter().zip(column).for_each(|(&i, v)| out[i] -= v);
        }
        if right.ncols() == 0 {
            return;
        }
        multiply(&mut self.product, lower.subrows(0, rows.len()), right);
        for (column, j) in self.product.chunks_exact(rows.len()).zip(&local[rows.len()..]) {
            let out = &mut front.upper[width * (j - width)..][..width];
            local.iter().zip(column).for_each(|(&i, v)| out[i] -= v);
        }
    }
}

/// The product of two matrices, by columns.
fn multiply(out: &mut Vec<f64>, left: MatRef<'_, f64>, right: MatRef<'_, f64>) {
    let (rows, cols) = (left.nrows(), right.ncols());
    out.clear();
    out.resize(rows * cols, 0.0);
    add_product(MatMut::from_column_major_slice_mut(out, rows, cols), 1.0, left, right);
}
