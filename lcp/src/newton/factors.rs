//! Factorisations of the matrices of free sets.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::ReborrowMut;
use faer::{Mat, MatMut, Par, Spec};
use lcp_linalg::{Cholesky, Columns, SparseLu, has_pivots, solve_unit_lower, solve_upper};

use crate::Matrix;
use crate::divide::block;
use crate::matrix::{Column, Storage};
use crate::scaling::{equilibrate, power_of_two};
use crate::vector::SMALL;

/// Factors of `M_FF`, dense or sparse like `M`: Cholesky factors if the matrix is symmetric and positive definite, else
/// LU. The memory of dense factors is kept.
pub(super) struct FreeFactors {
    is_symmetric: bool,
    /// Whether the factors belong to the pairs in `free`.
    is_known: bool,
    free: Vec<usize>,
    right: Vec<f64>,
    kind: Kind,
    /// Number of factorisations so far.
    pub(super) count: usize,
}

enum Kind {
    Dense(Box<DenseFactors>),
    Sparse(Option<Inverse>),
}

/// Overwrites a right-hand side with the solution.
type Inverse = Box<dyn Fn(&mut [f64]) + Send + Sync>;

struct DenseFactors {
    /// Units of rows and columns of the last LU, which bring the largest entries near one.
    units: (Vec<f64>, Vec<f64>),
    factors: Mat<f64>,
    is_cholesky: bool,
    /// The row at every place, and the place of every row.
    rows: [Vec<usize>; 2],
    sorted: Vec<f64>,
    stack: MemBuffer,
}

impl FreeFactors {
    pub(super) fn new(m: &Matrix) -> Self {
        let is_symmetric = m.check_symmetric("M").is_ok();
        let kind =
            if m.is_sparse() { Kind::Sparse(None) } else { Kind::Dense(DenseFactors::new(m)) };
        let (free, right) = (Vec::new(), Vec::new());
        Self { is_symmetric, is_known: false, free, right, kind, count: 0 }
    }

    /// Factorises the matrix of some pairs, unless the present factors are those; `false` if the matrix is singular to
    /// working precision.
    pub(super) fn factorise(&mut self, m: &Matrix, is_free: &[bool]) -> bool {
        let free = || (0..is_free.len()).filter(|&i| is_free[i]);
        if self.is_known && free().eq(self.free.iter().copied()) {
            return true;
        }
        self.free.clear();
        self.free.extend(free());
        self.count += 1;
        let Self { kind, free, is_symmetric, count, .. } = self;
        self.is_known = match kind {
            Kind::Dense(dense) => {
                let found = is_symmetric.then(|| dense.cholesky(m, free)).flatten();
                *count += usize::from(*is_symmetric && found.is_none());
                found.unwrap_or_else(|| dense.lu(m, free))
            }
            Kind::Sparse(solve) => {
                let block = block(m, free, free);
                let found = is_symmetric.then(|| cholesky(&block)).flatten();
                *count += usize::from(*is_symmetric && found.is_none());
                let (is_regular, found) = found.unwrap_or_else(|| (true, lu(&block)));
                *solve = found;
                is_regular && solve.is_some()
            }
        };
        self.is_known
    }

    /// Subtracts the solution for the free rows of `rest` from `z`.
    pub(super) fn subtract(&mut self, rest: &[f64], z: &mut [f64]) {
        let Self { free, right, kind, .. } = self;
        right.clear();
        right.extend(free.iter().map(|&i| rest[i]));
        match kind {
            Kind::Dense(dense) => dense.solve(free, right),
            Kind::Sparse(Some(solve)) => solve(right),
            Kind::Sparse(None) => {}
        }
        free.iter().zip(right).for_each(|(&i, x)| z[i] -= *x);
    }
}

impl DenseFactors {
    fn new(m: &Matrix) -> Box<Self> {
        let n = m.ncols();
        let scratch = cholesky_in_place_scratch::<f64>(n, Par::Seq, Spec::default())
            .or(lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Spec::default()));
        Box::new(Self {
            units: (vec![1.0; n], vec![1.0; n]),
            factors: Mat::zeros(n, n),
            is_cholesky: false,
            rows: [vec![0; n], vec![0; n]],
            sorted: Vec::with_capacity(n),
            stack: MemBuffer::new(scratch),
        })
    }

    /// Whether no pivot vanishes; `None` if the matrix is not positive definite.
    fn cholesky(&mut self, m: &Matrix, free: &[usize]) -> Option<bool> {
        let k = free.len();
        let mut block = self.factors.submatrix_mut(0, 0, k, k);
        for (b, &j) in free.iter().enumerate() {
            free.iter().enumerate().for_each(|(a, &i)| block[(a, b)] = m[(i, j)]);
        }
        let (stack, spec) = (MemStack::new(&mut self.stack), Spec::default());
        cholesky_in_place(block, LltRegularization::default(), Par::Seq, stack, spec).ok()?;
        self.is_cholesky = true;
        let mut pivots = free.iter().enumerate().map(|(a, &i)| (self.factors[(a, a)], m[(i, i)]));
        Some(pivots.all(|(root, entry)| root * root > SMALL * entry))
    }

    /// Whether no pivot vanishes.
    fn lu(&mut self, m: &Matrix, free: &[usize]) -> bool {
        let (row, col) = &mut self.units;
        let k = free.len();
        let largest = |max: f64, v: f64| max.max(v.abs());
        let unit = |largest: f64| if largest > 0.0 { power_of_two(1.0 / largest) } else { 1.0 };
        for &i in free {
            row[i] = unit(free.iter().map(|&j| m[(i, j)]).fold(0.0, largest));
        }
        let mut block = self.factors.submatrix_mut(0, 0, k, k);
        for (b, &j) in free.iter().enumerate() {
            col[j] = unit(free.iter().map(|&i| row[i] * m[(i, j)]).fold(0.0, largest));
            for (a, &i) in free.iter().enumerate() {
                block[(a, b)] = row[i] * m[(i, j)] * col[j];
            }
        }
        let (stack, spec) = (MemStack::new(&mut self.stack), Spec::default());
        let [rows, places] = self.rows.each_mut().map(|it| &mut it[..k]);
        lu_in_place(block, rows, places, Par::Seq, stack, spec);
        self.is_cholesky = false;
        has_pivots(self.factors.submatrix(0, 0, k, k))
    }

    fn solve(&mut self, free: &[usize], x: &mut [f64]) {
        let Self { units: (row, col), factors, rows: [rows, _], sorted, .. } = self;
        let k = free.len();
        let factors = factors.submatrix(0, 0, k, k);
        if self.is_cholesky {
            let mut x = MatMut::from_column_major_slice_mut(x, k, 1);
            solve_lower_triangular_in_place(factors, x.rb_mut(), Par::Seq);
            solve_upper(factors.transpose(), x);
            return;
        }
        sorted.clear();
        sorted.extend(rows[..k].iter().map(|&a| row[free[a]] * x[a]));
        let mut right = MatMut::from_column_major_slice_mut(sorted, k, 1);
        solve_unit_lower(factors, right.rb_mut());
        solve_upper(factors, right);
        x.iter_mut().zip(sorted).zip(free).for_each(|((x, v), &i)| *x = col[i] * *v);
    }
}

/// Whether no pivot of a sparse symmetric matrix vanishes, with its factors; `None` if the matrix is not positive
/// definite, or memory does not suffice.
fn cholesky(block: &Matrix) -> Option<(bool, Option<Inverse>)> {
    let Storage::Sparse(sparse) = block.storage() else { return None };
    let mut factors = Cholesky::new(sparse.symbolic()).ok()?;
    factors.factorise(sparse.as_ref())?;
    let pivots = factors.pivots();
    let mut regular = pivots.iter().enumerate().map(|(k, v)| *v > SMALL * block[(k, k)]);
    let is_regular = regular.all(|is| is);
    let solve: Inverse = Box::new(move |x| factors.solve(x));
    pivots.iter().all(|pivot| *pivot > 0.0).then_some((is_regular, Some(solve)))
}

/// Solves by LU factors of a sparse matrix with entries near one; `None` if the matrix is singular.
fn lu(block: &Matrix) -> Option<Inverse> {
    let n = block.ncols();
    let columns: Vec<Column<'_>> = (0..n).map(|k| block.slice(k)).collect();
    let (rows, cols) = equilibrate(n, &columns);
    let mut scaled = Columns::default();
    for (column, unit) in columns.iter().zip(&cols) {
        column.for_each(|i, v| scaled.push(i, rows[i] * v * unit));
        scaled.close();
    }
    let (factors, replaced) = SparseLu::new(&scaled);
    let multiply = |x: &mut [f64], by: &[f64]| x.iter_mut().zip(by).for_each(|(x, by)| *x *= by);
    let solve: Inverse = Box::new(move |x| {
        multiply(x, &rows);
        factors.solve(x, &mut Vec::new());
        multiply(x, &cols);
    });
    replaced.is_empty().then_some(solve)
}
