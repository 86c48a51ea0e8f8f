//! The condensed tableau, with pivots kept as factors and applied in blocks.
//!
//! A pivot on entry `(r, s)` of `T` is one rank-1 change of the whole matrix. Done at once it moves
//! the matrix through memory for every pivot. Here up to [`BLOCK`] pivots are held as
//! `T = stored + U V`; a pivot then needs one column and one row of `T`, each a product with the
//! thin factors, and the block is applied by one matrix product.

use faer::Mat;

use crate::linear::add_product;

/// Pivots held back before they are applied.
pub(crate) const BLOCK: usize = 48;

/// `T = stored + U V`.
#[derive(Debug, Clone)]
pub(super) struct Tableau {
    stored: Mat<f64>,
    u: Mat<f64>,
    v: Mat<f64>,
    held: usize,
}

impl Tableau {
    pub(super) fn new(t: Mat<f64>) -> Self {
        let (u, v) = (Mat::zeros(t.nrows(), BLOCK), Mat::zeros(BLOCK, t.ncols()));
        Self { stored: t, u, v, held: 0 }
    }

    /// Whether the next pivot needs the held ones applied first.
    pub(super) fn is_full(&self) -> bool {
        self.held == BLOCK
    }

    /// One column of `T`.
    pub(super) fn column(&self, s: usize, out: &mut [f64]) {
        out.copy_from_slice(self.stored.col_as_slice(s));
        let v = self.v.col_as_slice(s);
        for (k, &factor) in v[..self.held].iter().enumerate() {
            if factor != 0.0 {
                for (out, u) in out.iter_mut().zip(self.u.col_as_slice(k)) {
                    *out += factor * u;
                }
            }
        }
    }

    /// One row of `T`.
    pub(super) fn row(&self, r: usize, out: &mut [f64]) {
        let mut u = [0.0; BLOCK];
        for (k, u) in u[..self.held].iter_mut().enumerate() {
            *u = self.u[(r, k)];
        }
        for (j, out) in out.iter_mut().enumerate() {
            *out = self.stored[(r, j)] + dot(&u[..self.held], &self.v.col_as_slice(j)[..self.held]);
        }
    }

    /// One entry of `T`.
    pub(super) fn entry(&self, r: usize, s: usize) -> f64 {
        let v = self.v.col_as_slice(s);
        let held = (0..self.held).map(|k| self.u[(r, k)] * v[k]).sum::<f64>();
        self.stored[(r, s)] + held
    }

    /// Exchanges the basic variable of row `r` with the nonbasic one of column `s`, given that
    /// column of `T`. Row and column are cleared before the rank-1 term is added: subtracting them
    /// from themselves would leave their rounding errors behind.
    pub(super) fn pivot(&mut self, r: usize, s: usize, column: &[f64], row: &mut [f64]) {
        if self.is_full() {
            self.apply();
        }
        self.row(r, row);
        row[s] = 1.0;
        for (j, &v) in row.iter().enumerate() {
            self.v[(self.held, j)] = v;
            self.stored[(r, j)] = 0.0;
        }
        self.stored.col_as_slice_mut(s).fill(0.0);
        for k in 0..self.held {
            self.u[(r, k)] = 0.0;
            self.v[(k, s)] = 0.0;
        }
        let inverse = 1.0 / column[r];
        let u = self.u.col_as_slice_mut(self.held);
        for (u, a) in u.iter_mut().zip(column) {
            *u = -a * inverse;
        }
        u[r] = inverse;
        self.held += 1;
    }

    /// Applies the held pivots to the stored matrix.
    pub(super) fn apply(&mut self) {
        let u = self.u.subcols(0, self.held);
        let v = self.v.subrows(0, self.held);
        add_product(self.stored.as_mut(), 1.0, u, v);
        self.held = 0;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pivoting twice on the same place undoes the exchange.
    #[test]
    fn a_pivot_is_its_own_inverse() {
        let n = 7;
        let t = Mat::from_fn(n, n + 1, |i, j| ((3 * i + 5 * j * j + i * j) % 11) as f64 - 4.5);
        let mut tableau = Tableau::new(t.clone());
        let (mut column, mut row) = (vec![0.0; n], vec![0.0; n + 1]);
        for _ in 0..2 * BLOCK {
            for (r, s) in [(2, 3), (2, 3), (5, 0), (5, 0)] {
                tableau.column(s, &mut column);
                tableau.pivot(r, s, &column, &mut row);
            }
        }
        for i in 0..n {
            for j in 0..=n {
                assert!((tableau.entry(i, j) - t[(i, j)]).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn a_pivot_matches_the_textbook_formula() {
        let t = Mat::from_fn(3, 4, |i, j| (i + 2 * j) as f64 + 1.0);
        let mut tableau = Tableau::new(t.clone());
        let (mut column, mut row) = (vec![0.0; 3], vec![0.0; 4]);
        tableau.column(2, &mut column);
        tableau.pivot(1, 2, &column, &mut row);
        let p = t[(1, 2)];
        for i in 0..3 {
            for j in 0..4 {
                let expected = match (i == 1, j == 2) {
                    (true, true) => 1.0 / p,
                    (true, false) => t[(1, j)] / p,
                    (false, true) => -t[(i, 2)] / p,
                    (false, false) => t[(i, j)] - t[(i, 2)] * t[(1, j)] / p,
                };
                assert!((tableau.entry(i, j) - expected).abs() < 1e-14);
            }
        }
    }
}
