//! The step from a complementary basis to the problem `w + T z = q` that a path follows.

mod flip;

use faer::Mat;
use lcp_linalg::{Columns, Lu, SparseLu, inverse_norm};

use crate::certify::GeneralJudge;
use crate::matrix::Column;
use crate::scaling::{equilibrate, equilibrate_computed};
use crate::vector::{SMALL, max_abs};
use crate::{Basis, HorizontalLcp, Side};

use super::constants::VANISHING;
use super::dense::Dense;
use super::kernel::{Kernel, Var};
use super::sparse::{Sparse, SparseStart};

/// The problem with equilibrated rows and columns: `row * A * t_factor`, `row * B * y_factor`.
pub(super) struct Equilibrated<'a> {
    pub(super) problem: &'a HorizontalLcp,
    pub(super) row: Vec<f64>,
    t_factor: Vec<f64>,
    y_factor: Vec<f64>,
    /// The positive `r` with `B_j = -r A_j` of every free pair: one unit of `y` is `r` units of `-t`.
    pub(super) opposite: Vec<Option<f64>>,
    pub(super) judge: GeneralJudge<'a>,
}

impl<'a> Equilibrated<'a> {
    pub(super) fn new(problem: &'a HorizontalLcp) -> Self {
        let n = problem.order();
        let (row, factors) = equilibrate(n, &problem.columns());
        let (t_factor, y_factor) = (factors[..n].to_vec(), factors[n..].to_vec());
        let opposite = (0..n).map(|pair| problem.opposite(pair)).collect();
        let judge = GeneralJudge::with_factors(problem, &row, &factors);
        Self { problem, row, t_factor, y_factor, opposite, judge }
    }

    pub(super) fn order(&self) -> usize {
        self.row.len()
    }

    /// Value in the problem's units of one unit of a scaled variable.
    pub(super) fn factor(&self, pair: usize, side: Side) -> f64 {
        side.of(&self.t_factor, &self.y_factor)[pair]
    }

    /// Adds an equilibrated column, times a factor.
    pub(super) fn add_column(&self, pair: usize, side: Side, factor: f64, out: &mut [f64]) {
        let factor = factor * self.factor(pair, side);
        match self.problem.column(pair, side) {
            Column::Dense(values) => {
                let scaled = values.iter().zip(&self.row).map(|(v, row)| v * row);
                out.iter_mut().zip(scaled).for_each(|(out, v)| *out += factor * v);
            }
            sparse @ Column::Sparse { .. } => {
                sparse.for_each(|i, v| out[i] += factor * (v * self.row[i]));
            }
        }
    }

    /// Equilibrated columns, side by side.
    pub(super) fn columns(&self, picked: &[(usize, Side)]) -> Mat<f64> {
        let mut m = Mat::zeros(self.order(), picked.len());
        for (k, &(pair, side)) in picked.iter().enumerate() {
            self.add_column(pair, side, 1.0, m.col_as_slice_mut(k));
        }
        m
    }

    /// The columns without zeros; `None` is the right-hand side.
    pub(super) fn sparse_columns(
        &self,
        picked: impl IntoIterator<Item = Option<(usize, Side)>>,
    ) -> Columns {
        let mut columns = Columns::default();
        for column in picked {
            if let Some((pair, side)) = column {
                let factor = self.factor(pair, side);
                self.problem.column(pair, side).for_each(|i, v| {
                    if v != 0.0 {
                        columns.push(i, factor * (v * self.row[i]));
                    }
                });
            } else {
                let right = self.right_hand_side().into_iter().enumerate();
                right.filter(|(_, v)| *v != 0.0).for_each(|(i, v)| columns.push(i, v));
            }
            columns.close();
        }
        columns
    }

    pub(super) fn right_hand_side(&self) -> Vec<f64> {
        self.problem.c().iter().zip(&self.row).map(|(c, row)| c * row).collect()
    }

    /// The equilibrated diagonal of a side, if all its columns are zero elsewhere.
    pub(super) fn diagonal(&self, side: impl Fn(usize) -> Side) -> Option<Vec<f64>> {
        (0..self.order())
            .map(|j| match self.problem.column(j, side(j)).single() {
                Some((i, v)) if i == j => Some(v * self.row[i] * self.factor(j, side(j))),
                _ => None,
            })
            .collect()
    }

    /// `w + T z = q` for a basis, or `None` if the basis is singular to working precision.
    pub(super) fn start(&self, basis: &Basis) -> Option<Start> {
        if self.problem.is_sparse() { self.sparse_start(basis) } else { self.dense_start(basis) }
    }

    fn dense_start(&self, basis: &Basis) -> Option<Start> {
        let n = self.order();
        let side = |j: usize| basis.sides()[j];
        let others: Vec<_> = (0..n).map(|j| (j, side(j).complement())).collect();
        let mut t = self.columns(&others);
        let mut q = self.right_hand_side();
        let (mut rows, mut cols) = (vec![1.0; n], vec![1.0; n]);
        if let Some(diagonal) = self.diagonal(side) {
            // Such columns are equilibrated already: their entries are near one, if not one.
            let is_identity = diagonal.iter().all(|d| d.total_cmp(&1.0).is_eq());
            for j in (0..n).filter(|_| !is_identity) {
                t.col_as_slice_mut(j).iter_mut().zip(&diagonal).for_each(|(v, d)| *v /= d);
            }
            q.iter_mut().zip(&diagonal).for_each(|(v, d)| *v /= d);
        } else {
            let picked: Vec<_> = (0..n).map(|j| (j, side(j))).collect();
            let lu = Lu::new(self.columns(&picked).as_ref())?;
            lu.solve_in_place(t.as_mut());
            lu.solve_vector(&mut q);
            drop_rounding(&mut t);
            if !t.is_all_finite() || t.norm_max() > 1.0 / VANISHING {
                return None;
            }
            let columns: Vec<_> = (0..n).map(|j| Column::Dense(t.col_as_slice(j))).collect();
            (rows, cols) = equilibrate_computed(n, &columns);
            for (j, col) in cols.iter().enumerate() {
                let column = t.col_as_slice_mut(j);
                column.iter_mut().zip(&rows).for_each(|(v, row)| *v *= row * col);
            }
            q.iter_mut().zip(&rows).for_each(|(q, r)| *q *= r);
        }
        for j in 0..n {
            rows[j] /= self.factor(j, side(j));
            cols[j] *= self.factor(j, side(j).complement());
        }
        Start::new(self, basis, q, StartData::Dense(t), [rows, cols])
    }

    fn sparse_start(&self, basis: &Basis) -> Option<Start> {
        let n = self.order();
        let own = basis.sides().iter().copied().enumerate();
        let others = own.clone().map(|(j, side)| (j, side.complement()));
        let (lu, replaced) = SparseLu::new(&self.sparse_columns(own.clone().map(Some)));
        let mut work = Vec::new();
        let norm = inverse_norm(n, |x, is_transposed| {
            if is_transposed { lu.solve_transpose(x, &mut work) } else { lu.solve(x, &mut work) }
        });
        if !replaced.is_empty() || norm.is_nan() || norm > 1.0 / VANISHING {
            return None;
        }
        let right = self.right_hand_side();
        let mut q = right.clone();
        lu.solve(&mut q, &mut work);
        let rows = own.clone().map(|(j, side)| 1.0 / self.factor(j, side)).collect();
        let cols = others.clone().map(|(j, side)| self.factor(j, side)).collect();
        let columns = self.sparse_columns(own.chain(others).map(Some));
        let data = StartData::Sparse(Box::new(SparseStart { columns, right, lu }));
        Start::new(self, basis, q, data, [rows, cols])
    }
}

/// Sets to zero the rounding errors in the solution of an equilibrated system: a row of only such errors would be
/// scaled up to coefficients.
fn drop_rounding(t: &mut Mat<f64>) {
    for j in 0..t.ncols() {
        let column = t.col_as_slice_mut(j);
        let least = SMALL * max_abs(column).max(1.0);
        column.iter_mut().filter(|v| v.abs() < least).for_each(|v| *v = 0.0);
    }
}

/// `w + T z = q`, equilibrated.
#[derive(Debug)]
pub(super) struct Start {
    /// The start basis: `w_i` is its side of pair `i`.
    pub(super) basis: Basis,
    free: Vec<bool>,
    /// Values of the start basis in units of `size`, the largest one.
    pub(super) q: Vec<f64>,
    pub(super) size: f64,
    /// Value of `w_i` in the problem's units: `size * w_i / row_factor[i]`.
    pub(super) row_factor: Vec<f64>,
    /// Value of `z_i` in the problem's units: `size * z_i * col_factor[i]`.
    pub(super) col_factor: Vec<f64>,
    data: StartData,
}

/// `T`, or the data that define it.
#[derive(Debug)]
enum StartData {
    Dense(Mat<f64>),
    Sparse(Box<SparseStart>),
}

impl Start {
    /// Makes a start from the values of the basis, which become multiples of the largest one, and the factors of rows
    /// and columns; `None` for values that are not finite.
    fn new(
        problem: &Equilibrated<'_>,
        basis: &Basis,
        mut q: Vec<f64>,
        mut data: StartData,
        [row_factor, col_factor]: [Vec<f64>; 2],
    ) -> Option<Self> {
        if q.iter().any(|q| !q.is_finite()) {
            return None;
        }
        let largest = max_abs(&q);
        let size = if largest > 0.0 { largest } else { 1.0 };
        let right = match &mut data {
            StartData::Sparse(data) => &mut data.right[..],
            StartData::Dense(_) => &mut [],
        };
        q.iter_mut().chain(right).for_each(|value| *value /= size);
        let free = problem.opposite.iter().map(Option::is_some).collect();
        Some(Self { basis: basis.clone(), free, q, size, row_factor, col_factor, data })
    }

    /// Whether the pair consists of the two parts of a free variable.
    pub(super) fn is_free(&self, pair: usize) -> bool {
        self.free[pair]
    }

    /// The start with free variables as two parts that are bounded like all others, so that a change of
    /// sign is a pivot.
    pub(super) fn bounded(mut self) -> Self {
        self.free.fill(false);
        self
    }

    /// Pair and side of a variable; `None` for the artificial one.
    pub(super) fn variable(&self, var: Var) -> Option<(usize, Side)> {
        let n = self.q.len();
        let side = *self.basis.sides().get(var % n.max(1)).filter(|_| var < 2 * n)?;
        Some((var % n, if var < n { side } else { side.complement() }))
    }

    /// `(t, y)` from values of all `w` and `z` of a path.
    pub(super) fn in_problem_units(
        &self,
        problem: &Equilibrated<'_>,
        along: &[f64],
    ) -> (Vec<f64>, Vec<f64>) {
        let n = self.q.len();
        let pair = |k: usize| {
            let w = self.size * along[k] / self.row_factor[k];
            let z = self.size * along[n + k] * self.col_factor[k];
            let (t, y) = self.basis.sides()[k].of((w, z), (z, w));
            // A free variable is put on the side of its sign.
            problem.opposite[k].map_or((t, y), |ratio| {
                let net = t - ratio * y;
                (net.max(0.0), (-net / ratio).max(0.0))
            })
        };
        (0..n).map(pair).unzip()
    }

    /// The complementary basis in which these `z` are basic.
    pub(super) fn basis_with(&self, z_is_basic: &[bool]) -> Basis {
        let sides = self.basis.sides().iter().zip(z_is_basic);
        Basis::new(sides.map(|(side, &z)| if z { side.complement() } else { *side }).collect())
    }

    /// The columns of `w + T z - d z0 = q` before the first pivot, `covering` being `d`.
    pub(super) fn kernel<'a>(&'a self, covering: &'a [f64]) -> Box<dyn Kernel + 'a> {
        match &self.data {
            StartData::Dense(t) => Box::new(Dense::new(t.as_ref(), covering, &self.q)),
            StartData::Sparse(data) => Box::new(Sparse::new(data, covering)),
        }
    }

    /// Whether all `z`, equal and large, make every `w` positive, so that the linear conditions have a solution. The
    /// result is `false` for sparse problems, without a test.
    pub(super) fn is_feasible_far_out(&self) -> bool {
        let StartData::Dense(t) = &self.data else { return false };
        let mut sums = vec![0.0; self.q.len()];
        for j in 0..t.ncols() {
            sums.iter_mut().zip(t.col_as_slice(j)).for_each(|(sum, v)| *sum += v);
        }
        let noise = SMALL * sums.len() as f64;
        sums.iter().zip(&self.free).all(|(sum, is_free)| *is_free || *sum < -noise)
    }
}
