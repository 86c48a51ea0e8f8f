//! One complementary path: from a start basis and a covering vector to a complementary basis, a
//! ray or a limit.
//!
//! The start basis turns the general problem into `w + T z = q` with the basic variable `w_i` and
//! the nonbasic `z_i` of every pair; the artificial variable adds the column `-d`:
//! `w + T z - d z0 = q`.

use std::collections::HashSet;

use faer::{Mat, MatRef};

use super::ratio::leaving_row;
use super::tableau::Tableau;
use crate::linear::{Lu, add_product, all_finite};
use crate::problem::max_abs;
use crate::random::SplitMix;
use crate::{AttemptEnd, Basis, Side};

/// Drift of the basic values, or of a column, against the start data above which the tableau is
/// rebuilt, relative to their size.
const DRIFT: f64 = 1e-10;
/// Size of the perturbation that parts ties, relative to the largest entry of `q`.
const PERTURBATION: f64 = 1e-8;
/// Below this multiple of its first value the artificial variable is zero.
const ARTIFICIAL_ZERO: f64 = 1e-10;

/// `w + T z = q`, equilibrated.
#[derive(Debug, Clone)]
pub(super) struct StartTableau {
    /// The start basis: `w_i` is its side of pair `i`.
    pub(super) basis: Basis,
    pub(super) t: Mat<f64>,
    pub(super) q: Vec<f64>,
    /// Value of `w_i` in the problem's units: `w_i / row_factor[i]`.
    pub(super) row_factor: Vec<f64>,
    /// Value of `z_i` in the problem's units: `z_i * col_factor[i]`.
    pub(super) col_factor: Vec<f64>,
}

/// A variable: `w_k` is `k`, `z_k` is `n + k`, the artificial one `2 n`.
type Var = usize;

#[derive(Debug, Clone, Copy)]
enum Place {
    Row(usize),
    Col(usize),
}

/// Limits and the observer's answer.
pub(super) struct Limits<'a> {
    pub(super) max_pivots: usize,
    pub(super) keep_going: &'a mut dyn FnMut(usize) -> bool,
}

/// The state of a path.
pub(super) struct Path<'a> {
    start: &'a StartTableau,
    covering: Vec<f64>,
    /// `q` of the start, perturbed where that was asked for.
    q: Vec<f64>,
    tableau: Tableau,
    /// Values of the basic variables, row by row.
    pub(super) values: Vec<f64>,
    basic: Vec<Var>,
    nonbasic: Vec<Var>,
    place: Vec<Place>,
    /// First value of the artificial variable.
    pub(super) artificial_start: f64,
    scale: f64,
    pub(super) pivots: usize,
    pub(super) refactorisations: usize,
    visited: HashSet<u64>,
    signature: u64,
    column: Vec<f64>,
    row: Vec<f64>,
    /// The variable that nothing blocked, at a ray.
    unblocked: Var,
    /// Pivots at the last rebuilding of the tableau.
    rebuilt_at: Option<usize>,
}

impl<'a> Path<'a> {
    /// `perturbation` is a seed: with it every entry of `q` grows by a small random amount, so that
    /// basic values do not become zero together. The final basis is judged by the data as given.
    pub(super) fn new(
        start: &'a StartTableau,
        covering: Vec<f64>,
        perturbation: Option<u64>,
    ) -> Self {
        let n = start.q.len();
        let mut q = start.q.clone();
        if let Some(seed) = perturbation {
            let mut random = SplitMix::new(seed);
            for q in &mut q {
                *q += PERTURBATION * (0.5 + random.next_f64());
            }
        }
        let t = Mat::from_fn(n, n + 1, |i, j| if j < n { start.t[(i, j)] } else { -covering[i] });
        let place = (0..n).map(Place::Row).chain((0..=n).map(Place::Col)).collect();
        Self {
            start,
            covering,
            tableau: Tableau::new(t),
            values: q.clone(),
            basic: (0..n).collect(),
            nonbasic: (n..=2 * n).collect(),
            place,
            artificial_start: 0.0,
            scale: max_abs(&q),
            q,
            pivots: 0,
            refactorisations: 0,
            visited: HashSet::new(),
            signature: (0..n).map(key).fold(0, |a, b| a ^ b),
            column: vec![0.0; n],
            row: vec![0.0; n + 1],
            unblocked: 2 * n,
            rebuilt_at: None,
        }
    }

    fn order(&self) -> usize {
        self.values.len()
    }

    fn artificial(&self) -> Var {
        2 * self.order()
    }

    /// The row in which the artificial variable is basic.
    pub(super) fn artificial_row(&self) -> Option<usize> {
        match self.place[self.artificial()] {
            Place::Row(row) => Some(row),
            Place::Col(_) => None,
        }
    }

    /// Size of the basic values, against which a tie is judged.
    pub(super) fn value_scale(&self) -> f64 {
        self.scale
    }

    /// Entry `(row, k)` of the inverse of the present basis.
    pub(super) fn inverse_entry(&self, row: usize, k: usize) -> f64 {
        match self.place[k] {
            Place::Row(at) => f64::from(u8::from(at == row)),
            Place::Col(col) => self.tableau.entry(row, col),
        }
    }

    /// Follows the path to its end.
    pub(super) fn run(&mut self, limits: &mut Limits<'_>) -> AttemptEnd {
        let n = self.order();
        let Some(first) = self.first_row() else { return AttemptEnd::Complementary };
        self.tableau.column(n, &mut self.column);
        self.artificial_start = self.values[first] / self.column[first];
        let mut entering = self.exchange(first, n);
        loop {
            if entering == self.artificial() {
                return AttemptEnd::Complementary;
            }
            if self.pivots >= limits.max_pivots {
                return AttemptEnd::PivotLimit;
            }
            if self.tableau.is_full() {
                if !(limits.keep_going)(self.pivots) {
                    return AttemptEnd::Cancelled;
                }
                self.tableau.apply();
                if self.has_drifted() && !self.refactorise() {
                    return AttemptEnd::Singular;
                }
            }
            let entering_col = self.col_of(entering);
            let mut column = std::mem::take(&mut self.column);
            self.tableau.column(entering_col, &mut column);
            let leaving = leaving_row(self, &column);
            self.column = column;
            match leaving {
                Some(row) => {
                    // The rule is deterministic: a basis that came back comes back for ever.
                    if !self.visited.insert(self.signature) {
                        return AttemptEnd::Cycle;
                    }
                    entering = self.exchange(row, entering_col);
                }
                // What looks like a ray may be drift: only a column that the data confirm counts.
                None if self.is_true_column(entering_col, &self.column) => {
                    return self.at_ray(entering_col);
                }
                None if self.rebuilt_at == Some(self.pivots) => return AttemptEnd::Singular,
                None if !self.refactorise() => return AttemptEnd::Singular,
                None => {}
            }
        }
    }

    /// The row that the artificial variable takes: the most negative value for its covering, the
    /// last of equal ones, which keeps the rows lexicographically positive.
    fn first_row(&self) -> Option<usize> {
        let mut worst = None;
        let mut ratio = 0.0;
        for (i, (&q, &d)) in self.values.iter().zip(&self.covering).enumerate() {
            if q < 0.0 && q / d <= ratio {
                (worst, ratio) = (Some(i), q / d);
            }
        }
        worst
    }

    /// Exchanges the basic variable of `row` with the nonbasic one of `col`, whose column of the
    /// tableau is in `self.column`. Returns the variable that has to enter next: the complement of
    /// the one that left.
    fn exchange(&mut self, row: usize, col: usize) -> Var {
        let step = self.values[row] / self.column[row];
        for (value, a) in self.values.iter_mut().zip(&self.column) {
            *value -= step * a;
        }
        self.values[row] = step;
        self.tableau.pivot(row, col, &self.column, &mut self.row);
        let (entered, left) = (self.nonbasic[col], self.basic[row]);
        self.basic[row] = entered;
        self.nonbasic[col] = left;
        self.place[entered] = Place::Row(row);
        self.place[left] = Place::Col(col);
        self.signature ^= key(entered) ^ key(left);
        self.pivots += 1;
        self.scale = max_abs(&self.values);
        self.complement(left)
    }

    fn complement(&self, var: Var) -> Var {
        let n = self.order();
        if var == 2 * n {
            var
        } else if var < n {
            var + n
        } else {
            var - n
        }
    }

    fn col_of(&self, var: Var) -> usize {
        match self.place[var] {
            Place::Col(col) => col,
            Place::Row(_) => unreachable!("the complement of a leaving variable is nonbasic"),
        }
    }

    /// A column that nothing blocks is a ray only when the artificial variable is not already
    /// zero: then the basis solves the problem, and it leaves on its own row.
    fn at_ray(&mut self, col: usize) -> AttemptEnd {
        if let Some(row) = self.artificial_row()
            && self.values[row] <= ARTIFICIAL_ZERO * self.artificial_start
            && self.column[row].abs() > 0.0
        {
            self.exchange(row, col);
            return AttemptEnd::Complementary;
        }
        self.unblocked = self.nonbasic[col];
        AttemptEnd::Ray
    }

    /// The complementary basis, once the artificial variable has left.
    pub(super) fn basis(&self) -> Basis {
        let n = self.order();
        let sides =
            self.start.basis.sides().iter().enumerate().map(|(k, side)| match self.place[n + k] {
                Place::Row(_) => side.complement(),
                Place::Col(_) => *side,
            });
        Basis::new(sides.collect())
    }

    /// The covering vector in units of the basic variables of the start basis.
    pub(super) fn covering(&self) -> impl Iterator<Item = f64> {
        self.covering.iter().zip(&self.start.row_factor).map(|(d, row)| d / row)
    }

    /// The direction of the ray, `(w, z, z0)`, in the units of the problem.
    pub(super) fn ray(&self) -> (Vec<f64>, Vec<f64>, f64) {
        let n = self.order();
        let mut direction = vec![0.0; 2 * n + 1];
        for (&var, a) in self.basic.iter().zip(&self.column) {
            direction[var] = (-a).max(0.0);
        }
        direction[self.unblocked] = 1.0;
        let mut dw = direction[..n].to_vec();
        let mut dz = direction[n..2 * n].to_vec();
        dw.iter_mut().zip(&self.start.row_factor).for_each(|(w, r)| *w /= r);
        dz.iter_mut().zip(&self.start.col_factor).for_each(|(z, c)| *z *= c);
        (dw, dz, direction[2 * n])
    }

    /// Column of a variable in the start data.
    fn add_start_column(&self, var: Var, factor: f64, out: &mut [f64]) {
        let n = self.order();
        if var < n {
            out[var] += factor;
        } else if var < 2 * n {
            let column = self.start.t.col_as_slice(var - n);
            out.iter_mut().zip(column).for_each(|(out, v)| *out += factor * v);
        } else {
            out.iter_mut().zip(&self.covering).for_each(|(out, d)| *out -= factor * d);
        }
    }

    /// Compares the basic values, and one column of the tableau, with the start data.
    fn has_drifted(&self) -> bool {
        let mut residual: Vec<f64> = self.q.iter().map(|q| -q).collect();
        self.add_basis_product(&self.values, &mut residual);
        if !is_small(&residual, self.scale.max(1.0)) {
            return true;
        }
        let probe = self.pivots % (self.order() + 1);
        let mut column = vec![0.0; self.order()];
        self.tableau.column(probe, &mut column);
        !self.is_true_column(probe, &column)
    }

    /// Whether a column of the tableau, times the basis, is what it was in the start data.
    fn is_true_column(&self, col: usize, column: &[f64]) -> bool {
        let mut residual = vec![0.0; self.order()];
        self.add_start_column(self.nonbasic[col], -1.0, &mut residual);
        self.add_basis_product(column, &mut residual);
        is_small(&residual, max_abs(column).max(1.0))
    }

    fn add_basis_product(&self, factors: &[f64], out: &mut [f64]) {
        for (&var, &factor) in self.basic.iter().zip(factors) {
            if factor != 0.0 {
                self.add_start_column(var, factor, out);
            }
        }
    }

    /// Rebuilds the tableau and the values from the start data: with the `p` rows whose `w` is
    /// nonbasic and the `p` other basic columns, one LU of order `p` and products.
    fn refactorise(&mut self) -> bool {
        self.refactorisations += 1;
        self.rebuilt_at = Some(self.pivots);
        let n = self.order();
        let left: Vec<usize> = (0..n).filter(|&k| matches!(self.place[k], Place::Col(_))).collect();
        let z_rows: Vec<usize> = (0..n).filter(|&i| self.basic[i] >= n).collect();
        let w_rows: Vec<usize> = (0..n).filter(|&i| self.basic[i] < n).collect();
        let columns = self.start_columns(&z_rows);
        let rows_of = |m: MatRef<'_, f64>, rows: &[usize]| {
            Mat::from_fn(rows.len(), m.ncols(), |i, j| m[(rows[i], j)])
        };
        let Some(lu) = Lu::new(rows_of(columns.as_ref(), &left).as_ref()) else { return false };

        let right = self.start_right_hand_sides();
        let mut solved = rows_of(right.as_ref(), &left);
        lu.solve_in_place(solved.as_mut());
        let w_index: Vec<usize> = w_rows.iter().map(|&i| self.basic[i]).collect();
        let mut rest = rows_of(right.as_ref(), &w_index);
        let coupling = rows_of(columns.as_ref(), &w_index);
        add_product(rest.as_mut(), -1.0, coupling.as_ref(), solved.as_ref());
        if !all_finite(&solved) || !all_finite(&rest) {
            return false;
        }
        let mut t = Mat::zeros(n, n + 2);
        for j in 0..n + 2 {
            z_rows.iter().enumerate().for_each(|(k, &i)| t[(i, j)] = solved[(k, j)]);
            w_rows.iter().enumerate().for_each(|(k, &i)| t[(i, j)] = rest[(k, j)]);
        }
        self.values.copy_from_slice(t.col_as_slice(n + 1));
        self.scale = max_abs(&self.values);
        t.truncate(n, n + 1);
        self.tableau = Tableau::new(t);
        true
    }

    fn start_columns(&self, rows: &[usize]) -> Mat<f64> {
        let mut columns = Mat::zeros(self.order(), rows.len());
        for (k, &row) in rows.iter().enumerate() {
            self.add_start_column(self.basic[row], 1.0, columns.col_as_slice_mut(k));
        }
        columns
    }

    /// The nonbasic columns and `q`, in the start data.
    fn start_right_hand_sides(&self) -> Mat<f64> {
        let n = self.order();
        let mut right = Mat::zeros(n, n + 2);
        for (col, &var) in self.nonbasic.iter().enumerate() {
            self.add_start_column(var, 1.0, right.col_as_slice_mut(col));
        }
        right.col_as_slice_mut(n + 1).copy_from_slice(&self.q);
        right
    }
}

/// Whether all entries are rounding errors of the given size; a NaN is not.
fn is_small(residual: &[f64], size: f64) -> bool {
    residual.iter().all(|r| r.abs() <= DRIFT * size)
}

/// A fixed pseudo-random key for every variable: the exclusive or over a basis is its signature.
fn key(var: Var) -> u64 {
    SplitMix::new(var as u64).next_u64()
}

impl StartTableau {
    /// Side of the problem on which `z_k` of a pair lies.
    pub(super) fn nonbasic_side(&self, pair: usize) -> Side {
        self.basis.sides()[pair].complement()
    }
}
