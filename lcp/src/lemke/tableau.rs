//! The condensed tableau, with pivots held back and applied in blocks.
//!
//! A pivot on entry `(r, s)` of `T` is a rank-1 change of the whole matrix, which passes through memory for every
//! pivot if the change is made at once. Lemke's method only needs the entering column. So up to a block of pivots
//! are held as columns `u_k`: a column of `T` is the stored one with the held pivots done on it, one after the other
//! (`x_r -> 0`, `x -> x + x_r u_k`), and a full block is applied to all columns by one matrix product.

use faer::{Mat, MatMut, MatRef};
use lcp_linalg::{add_product, solve_unit_lower};

/// `T` after the held pivots.
#[derive(Debug, Clone)]
pub(super) struct Tableau {
    stored: Mat<f64>,
    u: Mat<f64>,
    /// The held pivots, in order.
    held: Vec<Held>,
    /// The rows of the held pivots, each once.
    rows: Vec<PivotRow>,
    /// Column `i` is row `rows[i]` of `u`.
    u_rows: Mat<f64>,
    /// The number of the first held pivot that still has to be done on every column.
    since: Vec<usize>,
    /// Memory for the factors of the pivots of one column.
    factors: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Held {
    /// Position in `Tableau::rows`.
    at: usize,
    /// The held pivot before it in the same row.
    before: Option<usize>,
}

#[derive(Debug, Clone, Copy)]
struct PivotRow {
    row: usize,
    /// The last held pivot in the row.
    last: usize,
}

impl Tableau {
    pub(super) fn new(t: Mat<f64>) -> Self {
        let block = block(t.nrows());
        Self {
            u: Mat::zeros(t.nrows(), block),
            held: Vec::with_capacity(block),
            rows: Vec::with_capacity(block),
            u_rows: Mat::zeros(block, block),
            since: vec![0; t.ncols()],
            factors: vec![0.0; block],
            stored: t,
        }
    }

    /// Whether the next pivot needs the held ones applied first.
    pub(super) fn is_full(&self) -> bool {
        self.held.len() == self.u.ncols()
    }

    /// One column of `T`: the stored one plus the columns `u_k`, times the factors of the pivots.
    pub(super) fn column(&mut self, s: usize, out: &mut [f64]) {
        let (n, held, since) = (out.len(), self.held.len(), self.since[s]);
        out.copy_from_slice(self.stored.col_as_slice(s));
        if since == held {
            return;
        }
        let v = &mut self.factors;
        v[..since].fill(0.0);
        for k in since..held {
            let Held { at, before } = self.held[k];
            let first = before.map_or(since, |before| before.max(since));
            let u = &self.u_rows.col_as_slice(at)[first..k];
            let stored =
                if before.is_none_or(|it| it < since) { out[self.rows[at].row] } else { 0.0 };
            v[k] = stored + dot(u, &v[first..k]);
        }
        let right = MatRef::from_column_major_slice(&v[since..held], held - since, 1);
        let left = self.u.subcols(since, held - since);
        add_product(MatMut::from_column_major_slice_mut(out, n, 1), 1.0, left, right);
        // Subtracting a pivot row from itself would leave rounding errors.
        for (i, pivot_row) in self.rows.iter().enumerate().filter(|(_, it)| it.last >= since) {
            let u = &self.u_rows.col_as_slice(i)[pivot_row.last..held];
            out[pivot_row.row] = dot(u, &v[pivot_row.last..held]);
        }
    }

    /// One row of `T`, as factors of the stored pivot rows (a row without a pivot is added) and the entries in the
    /// columns that the held pivots exchanged: the held pivots, transposed, in the opposite order.
    pub(super) fn row(&self, r: usize) -> Vec<f64> {
        let count = self.rows.len();
        let mut factors = vec![0.0; count + self.held.len()];
        let pivoted = self.rows.iter().position(|it| it.row == r);
        if let Some(at) = pivoted {
            factors[at] = 1.0;
        }
        for (k, Held { at, .. }) in self.held.iter().enumerate().rev() {
            let own = if pivoted.is_none() { self.u[(r, k)] } else { 0.0 };
            let met = factors[..count].iter().enumerate().map(|(i, it)| it * self.u_rows[(k, i)]);
            let value = own + met.sum::<f64>();
            factors[count + k] = value;
            factors[*at] = value;
        }
        factors
    }

    /// The entry of row `r`, with these factors, in column `s`.
    pub(super) fn entry(&self, r: usize, factors: &[f64], s: usize) -> f64 {
        if self.since[s] > 0 {
            return factors[self.rows.len() + self.since[s] - 1];
        }
        let column = self.stored.col_as_slice(s);
        let is_pivoted = self.rows.iter().any(|it| it.row == r);
        let own = if is_pivoted { 0.0 } else { column[r] };
        let pivoted = self.rows.iter().zip(factors).map(|(it, factor)| factor * column[it.row]);
        own + pivoted.sum::<f64>()
    }

    /// Exchanges the basic variable of row `r` with the nonbasic one of column `s`, given that
    /// column of `T`. The column of the variable that left is `u` itself.
    pub(super) fn pivot(&mut self, r: usize, s: usize, column: &[f64]) {
        if self.is_full() {
            self.apply();
        }
        let k = self.held.len();
        let inverse = 1.0 / column[r];
        let u = self.u.col_as_slice_mut(k);
        u.iter_mut().zip(column).for_each(|(u, a)| *u = -a * inverse);
        u[r] = inverse;
        self.stored.col_as_slice_mut(s).copy_from_slice(self.u.col_as_slice(k));
        self.since[s] = k + 1;
        let known = self.rows.iter().position(|it| it.row == r);
        let before = known.map(|at| self.rows[at].last);
        let at = known.unwrap_or(self.rows.len());
        if known.is_some() {
            self.rows[at].last = k;
        } else {
            self.rows.push(PivotRow { row: r, last: k });
            let column = self.u_rows.col_as_slice_mut(at);
            column[..k].iter_mut().enumerate().for_each(|(j, u)| *u = self.u[(r, j)]);
        }
        self.held.push(Held { at, before });
        for (i, pivot_row) in self.rows.iter().enumerate() {
            self.u_rows[(k, i)] = self.u[(pivot_row.row, k)];
        }
    }

    /// Applies the held pivots to the stored matrix: `stored + U V`. `V` are the factors in the recurrence of
    /// [`column`](Self::column), a triangular system for all columns.
    pub(super) fn apply(&mut self) {
        let held = self.held.len();
        let columns = self.stored.ncols();
        let mut v = Mat::zeros(held, columns);
        for (s, &since) in self.since.iter().enumerate() {
            let (v, column) = (v.col_as_slice_mut(s), self.stored.col_as_slice(s));
            for (k, Held { at, before }) in self.held.iter().enumerate().skip(since) {
                if before.is_none_or(|before| before < since) {
                    v[k] = column[self.rows[*at].row];
                }
            }
        }
        let recurrence = Mat::from_fn(held, held, |k, j| {
            let Held { at, before } = self.held[k];
            let is_met = j < k && before.is_none_or(|before| j >= before);
            if is_met { -self.u_rows[(j, at)] } else { 0.0 }
        });
        solve_unit_lower(recurrence.as_ref(), v.as_mut());
        let last = Mat::from_fn(self.rows.len(), held, |i, k| {
            if k >= self.rows[i].last { self.u_rows[(k, i)] } else { 0.0 }
        });
        let mut pivot_rows = Mat::zeros(self.rows.len(), columns);
        add_product(pivot_rows.as_mut(), 1.0, last.as_ref(), v.as_ref());
        let u = self.u.subcols(0, held);
        add_product(self.stored.as_mut(), 1.0, u, v.as_ref());
        for (s, since) in self.since.iter_mut().enumerate() {
            let since = std::mem::take(since);
            let (column, values) = (self.stored.col_as_slice_mut(s), pivot_rows.col_as_slice(s));
            for (pivot_row, value) in self.rows.iter().zip(values) {
                if pivot_row.last >= since {
                    column[pivot_row.row] = *value;
                }
            }
        }
        self.held.clear();
        self.rows.clear();
    }
}

/// Number of pivots held back: with more, the product moves less memory for each, and a column costs more.
fn block(n: usize) -> usize {
    (n / 16).clamp(16, 96)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(tableau: &Tableau, i: usize, j: usize) -> f64 {
        tableau.entry(i, &tableau.row(i), j)
    }

    /// Two pivots on the same place cancel.
    #[test]
    fn a_pivot_is_its_own_inverse() {
        let n = 7;
        let t = Mat::from_fn(n, n + 1, |i, j| ((3 * i + 5 * j * j + i * j) % 11) as f64 - 4.5);
        let mut tableau = Tableau::new(t.clone());
        let mut column = vec![0.0; n];
        for _ in 0..2 * block(n) {
            for (r, s) in [(2, 3), (2, 3), (5, 0), (5, 0)] {
                tableau.column(s, &mut column);
                tableau.pivot(r, s, &column);
            }
        }
        for i in 0..n {
            for j in 0..=n {
                assert!((entry(&tableau, i, j) - t[(i, j)]).abs() < 1e-11);
            }
        }
    }

    /// One pivot, held and applied, by columns and by rows.
    #[test]
    fn a_pivot_matches_the_textbook_formula() {
        let t = Mat::from_fn(3, 4, |i, j| (i + 2 * j) as f64 + 1.0);
        let mut tableau = Tableau::new(t.clone());
        let mut column = vec![0.0; 3];
        tableau.column(2, &mut column);
        tableau.pivot(1, 2, &column);
        let p = t[(1, 2)];
        for _ in 0..2 {
            for j in 0..4 {
                tableau.column(j, &mut column);
                for i in 0..3 {
                    let expected = match (i == 1, j == 2) {
                        (true, true) => 1.0 / p,
                        (true, false) => t[(1, j)] / p,
                        (false, true) => -t[(i, 2)] / p,
                        (false, false) => t[(i, j)] - t[(i, 2)] * t[(1, j)] / p,
                    };
                    assert!((column[i] - expected).abs() < 1e-14);
                    assert!((entry(&tableau, i, j) - expected).abs() < 1e-14);
                }
            }
            tableau.apply();
        }
    }
}
