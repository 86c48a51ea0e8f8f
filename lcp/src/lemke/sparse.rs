//! The sparse kernel: a sparse LU factorisation of one basis, and a dense one, of small order, of the
//! changes by later pivots (the Schur complement method; Bisschop and Meeraus 1977, 1980).
//!
//! Let `B0` be the factorised basis, `N` the columns that entered since, and `R` the rows whose
//! variable they replaced. A column `a` in terms of the present basis is `s` in the rows `R` and `x`
//! elsewhere:
//!
//! ```text
//! B0 x + N s = a,  x_R = 0    =>    S s = (B0^-1 a)_R,   x = B0^-1 (a - N s),   S = (B0^-1 N)_R
//! ```
//!
//! So a pivot costs a few sparse solves whatever the number of earlier pivots, no dense data of the
//! order of the problem are kept except a few vectors, and errors do not accumulate from one pivot to
//! the next. The artificial variable, whose column is dense, is always one of `N`, never of `B0`.

use std::borrow::Cow;

use faer::Mat;
use lcp_linalg::{Columns, Lu, SparseLu};

use super::constants::VANISHING;
use super::kernel::{Kernel, Var};
use crate::random::SplitMix;
use crate::vector::max_abs;

/// `W w + Z z = right` in the equilibrated rows of the problem, with the start basis `W`.
#[derive(Debug)]
pub(super) struct SparseStart {
    /// `[W Z]`.
    pub(super) columns: Columns,
    pub(super) right: Vec<f64>,
    /// Factors of `W`.
    pub(super) lu: SparseLu,
}

/// A factorised basis with the pivots done since.
pub(super) struct Sparse<'a> {
    start: &'a SparseStart,
    /// The column of the artificial variable.
    artificial: Vec<f64>,
    /// The vector that breaks ties.
    parting: Vec<f64>,
    factored: Factored<'a>,
    /// Pivots since the factorisation, and their limit.
    pivots: usize,
    limit: usize,
    /// The last column computed, in terms of `B0`.
    last: Vec<f64>,
    work: Vec<f64>,
}

/// `B0`, `N` and `R`.
struct Factored<'a> {
    lu: Cow<'a, SparseLu>,
    /// Rows `R` with their variables `N`.
    changed: Vec<(usize, Var)>,
    /// Position of a row in `changed`.
    place: Vec<Option<usize>>,
    /// `S`, column by column.
    schur: Vec<Vec<f64>>,
    /// `None` if `S` is singular.
    schur_lu: Option<Lu>,
}

impl<'a> Sparse<'a> {
    pub(super) fn new(start: &'a SparseStart, covering: &[f64]) -> Self {
        let n = covering.len();
        let mut artificial = vec![0.0; n];
        for (k, &d) in covering.iter().enumerate().filter(|(_, d)| **d != 0.0) {
            start.columns.add_to(k, -d, &mut artificial);
        }
        // The last row of a tie leaves in the first pivot: its part is the smallest.
        let mut parting = vec![0.0; n];
        let mut random = SplitMix::new(n as u64);
        for (k, &d) in covering.iter().enumerate() {
            let part = d * (1.0 + ((n - k) as f64 + random.next_f64()) / n as f64);
            start.columns.add_to(k, part, &mut parting);
        }
        let factored = Factored::new(Cow::Borrowed(&start.lu));
        Self {
            start,
            artificial,
            parting,
            pivots: 0,
            limit: pivot_limit(factored.lu.stored()),
            factored,
            last: Vec::new(),
            work: Vec::new(),
        }
    }

    fn order(&self) -> usize {
        self.artificial.len()
    }

    /// Replaces the column in `out` by `B^-1 column`; returns `(B0^-1 column)`.
    fn solve(&self, factored: &Factored<'_>, out: &mut [f64], work: &mut Vec<f64>) -> Vec<f64> {
        let mut in_base = out.to_vec();
        factored.lu.solve(&mut in_base, work);
        if factored.changed.is_empty() {
            out.copy_from_slice(&in_base);
            return in_base;
        }
        let mut s: Vec<f64> = factored.changed.iter().map(|&(row, _)| in_base[row]).collect();
        factored.solve_schur(&mut s, false);
        for (&(_, var), &s) in factored.changed.iter().zip(&s).filter(|(_, s)| **s != 0.0) {
            self.add_start_column(var, -s, out);
        }
        factored.lu.solve(out, work);
        factored.changed.iter().zip(s).for_each(|(&(row, _), s)| out[row] = s);
        in_base
    }

    fn start_dot(&self, var: Var, x: &[f64]) -> f64 {
        if var < 2 * self.order() {
            self.start.columns.dot(var, x)
        } else {
            self.artificial.iter().zip(x).map(|(a, x)| a * x).sum()
        }
    }

    /// The factors of a basis, with its values, refined once; `None` if the basis is singular.
    fn factorise(&mut self, basic: &[Var]) -> Option<(Factored<'a>, Vec<f64>)> {
        let n = self.order();
        let artificial_row = basic.iter().position(|&var| var == 2 * n);
        let mut columns = Columns::default();
        for &var in basic {
            if var < 2 * n {
                self.start.columns.entries(var).for_each(|(i, v)| columns.push(i, v));
            }
            columns.close();
        }
        let (lu, replaced) = SparseLu::new(&columns);
        // A unit column holds the place of the artificial variable.
        if replaced.len() > 1 || replaced.first().map(|it| it.0) != artificial_row {
            return None;
        }
        let mut factored = Factored::new(Cow::Owned(lu));
        if let Some(row) = artificial_row {
            let mut column = self.artificial.clone();
            factored.lu.solve(&mut column, &mut self.work);
            factored.change(row, 2 * n, &column);
        }
        let mut work = std::mem::take(&mut self.work);
        let mut values = self.start.right.clone();
        self.solve(&factored, &mut values, &mut work);
        let mut residual = self.residual(basic, &values);
        self.solve(&factored, &mut residual, &mut work);
        values.iter_mut().zip(&residual).for_each(|(value, step)| *value += step);
        self.work = work;
        let error = max_abs(&self.residual(basic, &values));
        let size = max_abs(&values).max(max_abs(&self.start.right));
        // This form of the condition refuses a NaN.
        (size.is_finite() && error <= VANISHING * size).then_some((factored, values))
    }

    fn residual(&self, basic: &[Var], values: &[f64]) -> Vec<f64> {
        let mut residual = self.start.right.clone();
        for (&var, &value) in basic.iter().zip(values).filter(|(_, value)| **value != 0.0) {
            self.add_start_column(var, -value, &mut residual);
        }
        residual
    }
}

impl<'a> Factored<'a> {
    fn new(lu: Cow<'a, SparseLu>) -> Self {
        let place = vec![None; lu.order()];
        Self { lu, changed: Vec::new(), place, schur: Vec::new(), schur_lu: None }
    }

    /// Puts a variable, whose column in terms of `B0` is given, into a row. If that row is new to `R`
    /// its entries in the other columns of `S` are stored already.
    fn change(&mut self, row: usize, var: Var, in_base: &[f64]) {
        let k = *self.place[row].get_or_insert(self.changed.len());
        if k == self.changed.len() {
            self.changed.push((row, var));
            self.schur.push(Vec::new());
        }
        self.changed[k].1 = var;
        self.schur[k] = self.changed.iter().map(|&(row, _)| in_base[row]).collect();
        let order = self.changed.len();
        let schur = Mat::from_fn(order, order, |i, j| self.schur[j][i]);
        self.schur_lu = Lu::new(schur.as_ref());
    }

    /// Solves with `S`, or with its transpose. The result for a singular `S` is NaN.
    fn solve_schur(&self, x: &mut [f64], is_transposed: bool) {
        match &self.schur_lu {
            Some(lu) if is_transposed => lu.solve_transpose_vector(x),
            Some(lu) => lu.solve_vector(x),
            None => x.fill(f64::NAN),
        }
    }
}

impl Kernel for Sparse<'_> {
    fn right_hand_side(&self) -> &[f64] {
        &self.start.right
    }

    fn add_start_column(&self, var: Var, factor: f64, out: &mut [f64]) {
        if var < 2 * self.order() {
            self.start.columns.add_to(var, factor, out);
        } else {
            out.iter_mut().zip(&self.artificial).for_each(|(out, a)| *out += factor * a);
        }
    }

    fn column(&mut self, var: Var, out: &mut [f64]) {
        out.fill(0.0);
        self.add_start_column(var, 1.0, out);
        let mut work = std::mem::take(&mut self.work);
        let in_base = self.solve(&self.factored, out, &mut work);
        self.work = work;
        self.last = in_base;
    }

    fn exchange(&mut self, row: usize, entering: Var, _leaving: Var, _column: &[f64]) {
        if self.factored.place[row].is_none() {
            let mut unit = vec![0.0; self.order()];
            unit[row] = 1.0;
            self.factored.lu.solve_transpose(&mut unit, &mut self.work);
            for k in 0..self.factored.changed.len() {
                let entry = self.start_dot(self.factored.changed[k].1, &unit);
                self.factored.schur[k].push(entry);
            }
        }
        self.factored.change(row, entering, &self.last);
        self.pivots += 1;
    }

    /// `B^-T e_row` in the rows of the problem.
    fn row(&self, row: usize) -> Vec<f64> {
        let Factored { lu, changed, place, .. } = &self.factored;
        let mut out = vec![0.0; self.order()];
        let mut work = Vec::new();
        let mut v = vec![0.0; changed.len()];
        if let Some(k) = place[row] {
            v[k] = -1.0;
        } else {
            out[row] = 1.0;
            if !changed.is_empty() {
                let mut in_base = out.clone();
                lu.solve_transpose(&mut in_base, &mut work);
                let entries = changed.iter().map(|&(_, var)| self.start_dot(var, &in_base));
                v.iter_mut().zip(entries).for_each(|(v, entry)| *v = entry);
            }
        }
        self.factored.solve_schur(&mut v, true);
        changed.iter().zip(v).for_each(|(&(row, _), v)| out[row] -= v);
        lu.solve_transpose(&mut out, &mut work);
        out
    }

    fn entry(&self, _row: usize, factors: &[f64], var: Var) -> f64 {
        self.start_dot(var, factors)
    }

    fn parting(&self) -> Option<Vec<f64>> {
        let mut out = self.parting.clone();
        self.solve(&self.factored, &mut out, &mut Vec::new());
        Some(out)
    }

    fn is_due(&self) -> bool {
        let is_singular = self.factored.schur_lu.is_none() && !self.factored.changed.is_empty();
        self.pivots >= self.limit || is_singular
    }

    fn apply(&mut self) -> bool {
        self.pivots == 0
    }

    fn rebuild(&mut self, basic: &[Var], values: &mut [f64]) -> bool {
        let Some((factored, new_values)) = self.factorise(basic) else { return false };
        values.copy_from_slice(&new_values);
        self.factored = factored;
        self.pivots = 0;
        self.limit = pivot_limit(self.factored.lu.stored());
        true
    }
}

/// Pivots between two factorisations. A factorisation with `m` nonzeros takes the time of some `500 m`
/// flops, and `k` pivots take factorisations of `S` of together `k^4 / 6` flops: the sum per pivot is
/// least near the fourth root of `1000 m`, and flat around it.
fn pivot_limit(stored: usize) -> usize {
    stored.saturating_mul(1000).isqrt().isqrt().clamp(16, 256)
}
