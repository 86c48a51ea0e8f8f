//! The dense kernel: a condensed tableau.

use faer::{Mat, MatRef};
use lcp_linalg::Lu;

use super::kernel::{Kernel, Var};
use super::tableau::Tableau;

pub(super) struct Dense<'a> {
    /// `T` of the start.
    start: MatRef<'a, f64>,
    covering: &'a [f64],
    q: &'a [f64],
    tableau: Tableau,
    /// Column of every nonbasic variable.
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

    fn rebuild(&mut self, basic: &[Var], values: &mut [f64]) -> bool {
        let n = self.order();
        let columns_of = |vars: &[Var]| {
            let mut columns = Mat::zeros(n, vars.len());
            for (k, &var) in vars.iter().enumerate() {
                self.add_start_column(var, 1.0, columns.col_as_slice_mut(k));
            }
            columns
        };
        let Some(lu) = Lu::new(columns_of(basic).as_ref()) else { return false };
        let mut t = columns_of(&self.nonbasic(basic));
        lu.solve_in_place(t.as_mut());
        let mut solved = self.q.to_vec();
        lu.solve_vector(&mut solved);
        if !t.is_all_finite() || solved.iter().any(|value| !value.is_finite()) {
            return false;
        }
        values.copy_from_slice(&solved);
        self.tableau = Tableau::new(t);
        true
    }
}
