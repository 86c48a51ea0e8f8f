//! Factorisations of the matrices of free sets.

use faer::Mat;
use faer::sparse::{SparseColMat, SymbolicSparseColMat};

use crate::Matrix;
use crate::linear::{Lu, factorise_cholesky, solve_cholesky};
use crate::matrix::Column;
use crate::scaling::equilibrate;
use crate::sparse::{Cholesky, Columns, Growing, SparseLu, Turn, elimination_order, row_counts};
use crate::vector::SMALL;

const NONE: usize = usize::MAX;

/// Factors of `M_FF`, dense or sparse like `M`: those of Cholesky where the matrix is symmetric and positive definite, else LU.
pub(super) struct Factors<'a> {
    m: &'a Matrix,
    is_symmetric: bool,
    /// Made when a matrix is not positive definite.
    general: Option<General>,
    /// The free pairs, and the number of every pair among them.
    free: Vec<usize>,
    number: Vec<usize>,
    kind: Kind,
    /// How many factorisations there were.
    pub(super) count: usize,
}

enum Kind {
    None,
    DenseCholesky(Mat<f64>),
    SparseCholesky(Cholesky),
    DenseLu(Lu),
    SparseLu(SparseLu),
}

impl<'a> Factors<'a> {
    pub(super) fn new(m: &'a Matrix) -> Self {
        Self {
            m,
            is_symmetric: m.check_symmetric("M").is_ok(),
            general: None,
            free: Vec::new(),
            number: vec![NONE; m.ncols()],
            kind: Kind::None,
            count: 0,
        }
    }

    /// Factorises the matrix of some pairs, at least one; `false` where it is singular to working precision.
    pub(super) fn factorise(&mut self, is_free: &[bool]) -> bool {
        self.free = (0..is_free.len()).filter(|&i| is_free[i]).collect();
        self.number.fill(NONE);
        self.free.iter().enumerate().for_each(|(k, &i)| self.number[i] = k);
        if self.is_symmetric {
            self.count += 1;
            if let Some(pivots) = self.cholesky() {
                let mut pivots = self.free.iter().zip(pivots);
                return pivots.all(|(&i, pivot)| pivot > SMALL * self.m[(i, i)]);
            }
        }
        self.count += 1;
        self.lu()
    }

    /// The pivots; `None` where the matrix is not positive definite, or memory does not suffice.
    fn cholesky(&mut self) -> Option<Vec<f64>> {
        let pivots = if self.m.is_sparse() {
            let lower = self.lower();
            let mut factors = Cholesky::new(lower.symbolic()).ok()?;
            factors.factorise(lower.as_ref())?;
            let pivots = factors.pivots();
            self.kind = Kind::SparseCholesky(factors);
            pivots
        } else {
            let mut factor = Mat::zeros(self.free.len(), self.free.len());
            for (k, &j) in self.free.iter().enumerate() {
                picked(self.m.slice(j), &self.free[k..], &mut factor.col_as_slice_mut(k)[k..]);
            }
            if !factorise_cholesky(factor.as_mut()) {
                return None;
            }
            let pivots = (0..self.free.len()).map(|k| factor[(k, k)] * factor[(k, k)]).collect();
            self.kind = Kind::DenseCholesky(factor);
            pivots
        };
        pivots.iter().all(|pivot| *pivot > 0.0).then_some(pivots)
    }

    /// The lower triangle.
    fn lower(&self) -> SparseColMat<usize, f64> {
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for (k, &j) in self.free.iter().enumerate() {
            self.m.slice(j).for_each(|i, v| {
                let number = self.number[i];
                if number != NONE && number >= k {
                    rows.push(number);
                    values.push(v);
                }
            });
            starts.push(rows.len());
        }
        let order = self.free.len();
        let pattern = SymbolicSparseColMat::new_checked(order, order, starts, None, rows);
        SparseColMat::new(pattern, values)
    }

    fn lu(&mut self) -> bool {
        let Self { m, general, free, number, .. } = self;
        let general = general.get_or_insert_with(|| General::new(m));
        let factors = if m.is_sparse() {
            general.sparse(free, number).map(Kind::SparseLu)
        } else {
            general.dense(m, free).map(Kind::DenseLu)
        };
        let is_regular = factors.is_some();
        self.kind = factors.unwrap_or(Kind::None);
        is_regular
    }

    /// Overwrites a right-hand side, zero for pairs that are not free, with the solution for the last factorisation.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let mut packed: Vec<f64> = self.free.iter().map(|&i| x[i]).collect();
        match (&self.kind, &self.general) {
            (Kind::DenseCholesky(factor), _) => solve_cholesky(factor.as_ref(), &mut packed),
            (Kind::SparseCholesky(factors), _) => factors.solve(&mut packed),
            (Kind::DenseLu(factors), Some(general)) => {
                general.scaled(&self.free, &mut packed, |x| factors.solve_vector(x));
            }
            (Kind::SparseLu(factors), Some(general)) => {
                general.scaled(&self.free, &mut packed, |x| factors.solve(x, &mut Vec::new()));
            }
            _ => {}
        }
        self.free.iter().zip(packed).for_each(|(&i, v)| x[i] = v);
    }
}

/// What LU factorisations need of the whole matrix.
struct General {
    /// Factors of rows and columns, powers of two, that bring the entries near one.
    rows: Vec<f64>,
    cols: Vec<f64>,
    /// A sparse matrix with these factors, and the order of its columns.
    columns: Columns,
    order: Vec<Turn>,
}

impl General {
    fn new(m: &Matrix) -> Self {
        let n = m.ncols();
        let (rows, cols) = equilibrate(n, &(0..n).map(|j| m.slice(j)).collect::<Vec<_>>());
        let mut columns = Columns::default();
        let mut order = Vec::new();
        if m.is_sparse() {
            for j in 0..n {
                m.slice(j).for_each(|i, v| {
                    if v != 0.0 {
                        columns.push(i, rows[i] * v * cols[j]);
                    }
                });
                columns.close();
            }
            order = elimination_order(n, &columns);
        }
        Self { rows, cols, columns, order }
    }

    fn dense(&self, m: &Matrix, free: &[usize]) -> Option<Lu> {
        let mut block = Mat::zeros(free.len(), free.len());
        for (k, &j) in free.iter().enumerate() {
            let column = block.col_as_slice_mut(k);
            picked(m.slice(j), free, column);
            column.iter_mut().zip(free).for_each(|(v, &i)| *v = self.rows[i] * *v * self.cols[j]);
        }
        Lu::new(block.as_ref())
    }

    /// In the order of the whole matrix. Dependent columns are found one by one.
    fn sparse(&self, free: &[usize], number: &[usize]) -> Option<SparseLu> {
        let mut block = Columns::default();
        for &j in free {
            let entries = self.columns.entries(j).filter(|(i, _)| number[*i] != NONE);
            entries.for_each(|(i, v)| block.push(number[i], v));
            block.close();
        }
        let mut growing = Growing::new(row_counts(free.len(), &block));
        let mut turns = self.order.iter().filter(|turn| number[turn.column] != NONE);
        let is_regular = turns.all(|turn| {
            let column = number[turn.column];
            let row = turn.row.map(|row| number[row]).filter(|row| *row != NONE);
            growing.offer(column, &block, Turn { column, row }, SMALL)
        });
        is_regular.then(|| growing.finish().0)
    }

    /// Solves a system of the free pairs by the factors of the scaled matrix.
    fn scaled(&self, free: &[usize], x: &mut [f64], solve: impl FnOnce(&mut [f64])) {
        x.iter_mut().zip(free).for_each(|(v, &i)| *v *= self.rows[i]);
        solve(x);
        x.iter_mut().zip(free).for_each(|(v, &i)| *v *= self.cols[i]);
    }
}

/// The entries of a column in some rows.
fn picked(column: Column<'_>, rows: &[usize], out: &mut [f64]) {
    if let Column::Dense(values) = column {
        out.iter_mut().zip(rows).for_each(|(out, &i)| *out = values[i]);
    }
}
