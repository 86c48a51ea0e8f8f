//! The dense kernel: a condensed tableau.

use faer::{Mat, MatRef};

use super::kernel::{Kernel, Var};
use super::tableau::Tableau;
use crate::linear::{Lu, add_product};

pub(super) struct Dense<'a> {
    /// `T` of the start.
    start: MatRef<'a, f64>,
    covering: &'a [f64],
    q: &'a [f64],
    tableau: Tableau,
    /// Column of every variable, where it is nonbasic.
    col_of: Vec<usize>,
}

impl<'a> Dense<'a> {
    pub(super) fn new(start: MatRef<'a, f64>, covering: &'a [f64], q: &'a [f64]) -> Self {
        let n = q.len();
        let t = Mat::from_fn(n, n + 1, |i, j| if j < n { start[(i, j)] } else { -covering[i] });
        let col_of = (0..n).map(|_| usize::MAX).chain(0..=n).collect();
        Self { start, covering, q, tableau: Tableau::new(t), col_of }
    }

    fn order(&self) -> usize {
        self.q.len()
    }

    /// The nonbasic variables in the order of their columns.
    fn nonbasic(&self, basic: &[Var]) -> Vec<Var> {
        let n = self.order();
        let mut is_basic = vec![false; 2 * n + 1];
        for &var in basic {
            is_basic[var] = true;
        }
        let mut nonbasic = vec![0; n + 1];
        (0..=2 * n).filter(|&var| !is_basic[var]).for_each(|var| nonbasic[self.col_of[var]] = var);
        nonbasic
    }
}

impl Kernel for Dense<'_> {
    fn right_hand_side(&self) -> &[f64] {
        self.q
    }

    fn add_start_column(&self, var: Var, factor: f64, out: &mut [f64]) {
        let n = self.order();
        if var < n {
            out[var] += factor;
        } else if var < 2 * n {
            let column = self.start.col(var - n).iter();
            out.iter_mut().zip(column).for_each(|(out, v)| *out += factor * v);
        } else {
            out.iter_mut().zip(self.covering).for_each(|(out, d)| *out -= factor * d);
        }
    }

    fn column(&mut self, var: Var, out: &mut [f64]) {
        self.tableau.column(self.col_of[var], out);
    }

    fn exchange(&mut self, row: usize, entering: Var, leaving: Var, column: &[f64]) {
        let col = self.col_of[entering];
        self.tableau.pivot(row, col, column);
        self.col_of[leaving] = col;
    }

    fn row(&self, row: usize) -> Vec<f64> {
        self.tableau.row(row)
    }

    fn entry(&self, row: usize, factors: &[f64], var: Var) -> f64 {
        self.tableau.entry(row, factors, self.col_of[var])
    }

    fn parting(&self) -> Option<Vec<f64>> {
        None
    }

    fn is_due(&self) -> bool {
        self.tableau.is_full()
    }

    fn apply(&mut self) -> bool {
        self.tableau.apply();
        true
    }

    /// With the `p` rows whose `w` is nonbasic and the `p` other basic columns: one LU of order `p`
    /// and products.
    fn rebuild(&mut self, basic: &[Var], values: &mut [f64]) -> bool {
        let n = self.order();
        let z_rows: Vec<usize> = (0..n).filter(|&i| basic[i] >= n).collect();
        let w_rows: Vec<usize> = (0..n).filter(|&i| basic[i] < n).collect();
        let w_index: Vec<usize> = w_rows.iter().map(|&i| basic[i]).collect();
        let mut is_left = vec![true; n];
        for &k in &w_index {
            is_left[k] = false;
        }
        let left: Vec<usize> = (0..n).filter(|&k| is_left[k]).collect();

        let mut columns = Mat::zeros(n, z_rows.len());
        for (k, &row) in z_rows.iter().enumerate() {
            self.add_start_column(basic[row], 1.0, columns.col_as_slice_mut(k));
        }
        let Some(lu) = Lu::new(rows_of(columns.as_ref(), &left).as_ref()) else { return false };
        let mut right = Mat::zeros(n, n + 2);
        for (col, &var) in self.nonbasic(basic).iter().enumerate() {
            self.add_start_column(var, 1.0, right.col_as_slice_mut(col));
        }
        right.col_as_slice_mut(n + 1).copy_from_slice(self.q);
        let mut solved = rows_of(right.as_ref(), &left);
        lu.solve_in_place(solved.as_mut());
        let mut rest = rows_of(right.as_ref(), &w_index);
        let coupling = rows_of(columns.as_ref(), &w_index);
        add_product(rest.as_mut(), -1.0, coupling.as_ref(), solved.as_ref());
        if !solved.is_all_finite() || !rest.is_all_finite() {
            return false;
        }
        let mut t = right;
        for j in 0..n + 2 {
            let column = t.col_as_slice_mut(j);
            z_rows.iter().zip(solved.col_as_slice(j)).for_each(|(&i, &v)| column[i] = v);
            w_rows.iter().zip(rest.col_as_slice(j)).for_each(|(&i, &v)| column[i] = v);
        }
        values.copy_from_slice(t.col_as_slice(n + 1));
        t.truncate(n, n + 1);
        self.tableau = Tableau::new(t);
        true
    }
}

fn rows_of(m: MatRef<'_, f64>, rows: &[usize]) -> Mat<f64> {
    Mat::from_fn(rows.len(), m.ncols(), |i, j| m[(rows[i], j)])
}
