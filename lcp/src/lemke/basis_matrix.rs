//! The matrix of a complementary basis, factorised.

use faer::Mat;
use lcp_linalg::{Columns, Lu, SparseLu, inverse_norm};

use super::constants::{LEVEL, SAMPLES};
use super::start::Equilibrated;
use crate::random::SplitMix;
use crate::vector::max_abs;
use crate::{Basis, Side};

/// The equilibrated matrix of a basis.
pub(super) enum BasisMatrix {
    Dense(Bordered),
    Sparse { columns: Columns, lu: SparseLu },
}

/// Columns with one entry only, such as all those of `y` in the standard form, are solved by
/// substitution; only the others are factorised.
pub(super) struct Bordered {
    singles: Vec<Single>,
    /// Positions of the other columns, which fill the rows that are left.
    core: Vec<usize>,
    core_rows: Vec<usize>,
    /// The other columns, all rows.
    columns: Mat<f64>,
    lu: Lu,
}

struct Single {
    position: usize,
    row: usize,
    value: f64,
}

impl BasisMatrix {
    /// The factorised matrix of a basis; `None` if it is singular to working precision.
    pub(super) fn new(problem: &Equilibrated<'_>, basis: &Basis) -> Option<Self> {
        let columns: Vec<_> = basis.sides().iter().copied().enumerate().map(Some).collect();
        Self::from_columns(problem, &columns)
    }

    /// The matrix of any columns, one per row; a column `None` is the right-hand side.
    pub(super) fn from_columns(
        problem: &Equilibrated<'_>,
        columns: &[Option<(usize, Side)>],
    ) -> Option<Self> {
        if problem.problem.is_sparse() {
            let sparse = problem.sparse_columns(columns.iter().copied());
            let (lu, replaced) = SparseLu::new(&sparse);
            return replaced.is_empty().then_some(Self::Sparse { columns: sparse, lu });
        }
        Bordered::new(problem, columns).map(Self::Dense)
    }

    fn order(&self) -> usize {
        match self {
            Self::Dense(it) => it.singles.len() + it.core.len(),
            Self::Sparse { lu, .. } => lu.order(),
        }
    }

    pub(super) fn solve(&self, x: &mut [f64]) {
        match self {
            Self::Dense(it) => it.solve(x),
            Self::Sparse { lu, .. } => lu.solve(x, &mut Vec::new()),
        }
    }

    pub(super) fn solve_transpose(&self, x: &mut [f64]) {
        match self {
            Self::Dense(it) => it.solve_transpose(x),
            Self::Sparse { lu, .. } => lu.solve_transpose(x, &mut Vec::new()),
        }
    }

    /// Calls `f` with `(position, row, entry)` for all entries.
    fn for_each(&self, mut f: impl FnMut(usize, usize, f64)) {
        match self {
            Self::Dense(it) => it.for_each(&mut f),
            Self::Sparse { columns, .. } => {
                (0..columns.len()).for_each(|j| columns.entries(j).for_each(|(i, v)| f(j, i, v)));
            }
        }
    }

    /// `right - M (x + low)` with twice the working precision (Ogita, Rump and Oishi 2005).
    pub(super) fn residual(&self, right: &[f64], x: &[f64], low: &[f64]) -> Vec<f64> {
        let mut high = right.to_vec();
        let mut error = vec![0.0; right.len()];
        let mut add = |i: usize, a: f64, b: f64| {
            let product = a * b;
            let product_error = a.mul_add(b, -product);
            let sum = high[i] + product;
            let part = sum - high[i];
            error[i] += (high[i] - (sum - part)) + (product - part) + product_error;
            high[i] = sum;
        };
        self.for_each(|j, i, v| {
            add(i, -v, x[j]);
            if low[j] != 0.0 {
                add(i, -v, low[j]);
            }
        });
        high.iter().zip(&error).map(|(high, error)| high + error).collect()
    }

    /// Row `position` of the inverse, refined, with zeros in place of rounding errors.
    pub(super) fn inverse_row(&self, position: usize) -> Vec<f64> {
        let n = self.order();
        let mut y = vec![0.0; n];
        y[position] = 1.0;
        self.solve_transpose(&mut y);
        let (mut step, mut sizes) = (vec![0.0; n], vec![0.0; n]);
        step[position] = 1.0;
        self.for_each(|j, i, v| {
            step[j] -= v * y[i];
            sizes[j] += (v * y[i]).abs();
        });
        self.solve_transpose(&mut step);
        let errors = sampled(&sizes, |sample| self.solve_transpose(sample));
        // Numbers of this size are zero, whatever the sampled errors.
        let least = f64::EPSILON * f64::EPSILON * max_abs(&y);
        let refined = y.iter().zip(&step).map(|(y, step)| y + step);
        refined
            .zip(errors)
            .map(|(y, error)| if y.abs() > error.max(least) { y } else { 0.0 })
            .collect()
    }

    /// Estimate of the condition number in the 1-norm.
    pub(super) fn condition(&self) -> f64 {
        let n = self.order();
        if n == 0 {
            return 1.0;
        }
        let mut sums = vec![0.0; n];
        self.for_each(|j, _, v| sums[j] += v.abs());
        let norm =
            inverse_norm(
                n,
                |x, is_transposed| {
                    if is_transposed { self.solve_transpose(x) } else { self.solve(x) }
                },
            );
        norm * max_abs(&sums)
    }
}

impl Bordered {
    fn new(problem: &Equilibrated<'_>, columns: &[Option<(usize, Side)>]) -> Option<Self> {
        let n = problem.order();
        let mut taken = vec![false; n];
        let (mut singles, mut core) = (Vec::new(), Vec::new());
        for (position, &column) in columns.iter().enumerate() {
            let single = column.and_then(|(pair, side)| {
                let (row, value) = problem.problem.column(pair, side).single()?;
                Some((row, value * problem.row[row] * problem.factor(pair, side)))
            });
            match single {
                Some((row, value)) if !taken[row] => {
                    taken[row] = true;
                    singles.push(Single { position, row, value });
                }
                _ => core.push(position),
            }
        }
        let mut picked = Mat::zeros(n, core.len());
        for (k, &position) in core.iter().enumerate() {
            let out = picked.col_as_slice_mut(k);
            match columns[position] {
                Some((pair, side)) => problem.add_column(pair, side, 1.0, out),
                None => out.copy_from_slice(&problem.right_hand_side()),
            }
        }
        let columns = picked;
        let core_rows: Vec<usize> = (0..n).filter(|&i| !taken[i]).collect();
        let square = Mat::from_fn(core.len(), core.len(), |i, j| columns[(core_rows[i], j)]);
        let lu = Lu::new(square.as_ref())?;
        Some(Self { singles, core, core_rows, columns, lu })
    }

    fn solve(&self, x: &mut [f64]) {
        let mut inner: Vec<f64> = self.core_rows.iter().map(|&i| x[i]).collect();
        self.lu.solve_vector(&mut inner);
        let mut rest = x.to_vec();
        for (j, value) in inner.iter().enumerate() {
            let column = self.columns.col_as_slice(j);
            rest.iter_mut().zip(column).for_each(|(rest, a)| *rest -= a * value);
        }
        self.core.iter().zip(&inner).for_each(|(&j, &value)| x[j] = value);
        self.singles.iter().for_each(|single| x[single.position] = rest[single.row] / single.value);
    }

    fn solve_transpose(&self, x: &mut [f64]) {
        let mut out = vec![0.0; x.len()];
        self.singles.iter().for_each(|single| out[single.row] = x[single.position] / single.value);
        let right = self.core.iter().enumerate().map(|(j, &position)| {
            let column = self.columns.col_as_slice(j);
            x[position] - column.iter().zip(&out).map(|(a, y)| a * y).sum::<f64>()
        });
        let mut inner: Vec<f64> = right.collect();
        self.lu.solve_transpose_vector(&mut inner);
        self.core_rows.iter().zip(&inner).for_each(|(&i, &value)| out[i] = value);
        x.copy_from_slice(&out);
    }

    fn for_each(&self, f: &mut impl FnMut(usize, usize, f64)) {
        for (j, &position) in self.core.iter().enumerate() {
            let column = self.columns.col_as_slice(j);
            column.iter().enumerate().for_each(|(i, &v)| f(position, i, v));
        }
        self.singles.iter().for_each(|single| f(single.position, single.row, single.value));
    }
}

/// Solutions for random right-hand sides of rounding size: the largest of each entry. Sizes are random
/// too, since errors that differ only in sign cancel now and then.
fn sampled(sizes: &[f64], solve: impl Fn(&mut [f64])) -> Vec<f64> {
    let mut errors = vec![0.0_f64; sizes.len()];
    for seed in 0..SAMPLES {
        let mut random = SplitMix::new(seed);
        let draw = |size: &f64| LEVEL * size * (2.0 * random.next_f64() - 1.0);
        let mut sample: Vec<f64> = sizes.iter().map(draw).collect();
        solve(&mut sample);
        errors.iter_mut().zip(sample).for_each(|(error, it)| *error = error.max(it.abs()));
    }
    errors
}
