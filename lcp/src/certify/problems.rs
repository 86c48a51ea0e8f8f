//! Problems with a matrix: the general form, variables between bounds, and forces at contacts.

use super::Residuals;
use super::judge::{Conditions, Entry, JudgedRows, Precision, RowJudge};
use super::weights::Couplings;
use crate::extended::extended;
use crate::matrix::Column;
use crate::scaling::equilibrate;
use crate::{BoxedLcp, ContactForces, Friction2d, HorizontalLcp, Lcp, Matrix, MixedLcp, Side};

impl HorizontalLcp {
    /// Residuals of a point, dimensionless, from the data as given; [`Residuals::worst`] decides.
    ///
    /// The residual `r_i = (A t + B y - c)_i` of row `i` is measured by the terms of that row, `(|A||t| + |B||y| +
    /// |c|)_i`, and so is the effect on its rows of a component that violates its sign, or is the smaller one of a pair
    /// whose variables are both positive. The units of rows and variables do not matter. The residual `loads` compares
    /// `r_i` with the largest right-hand side of the connected part of the row.
    ///
    /// A NaN in the point makes the residuals infinite, and so do terms that are far beyond the range of numbers.
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::{HorizontalLcp, Lcp};
    /// // w = z - 2 in the first row, in units that make it 1e14 times as stiff as the second
    /// let lcp = Lcp::new(mat![[1e14, 0.0], [0.0, 1.0]], vec![-2.0, -1.0])?;
    /// let problem = HorizontalLcp::from(lcp);
    /// assert_eq!(problem.residuals(&[2e-14, 1.0], &[0.0, 0.0]).worst(), 0.0);
    /// assert_eq!(problem.residuals(&[0.0, 1.0], &[0.0, 0.0]).worst(), 1.0);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair.
    pub fn residuals(&self, t: &[f64], y: &[f64]) -> Residuals {
        let n = self.order();
        assert!(t.len() == n && y.len() == n, "a point has one entry for every pair");
        GeneralJudge::new(self).residuals(&[t, y], Precision::Rounded)
    }
}

impl Lcp {
    /// Residuals of `(z, w)`, dimensionless, from the data as given: rows are `w - M z - q`. See
    /// [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        assert!(z.len() == self.order() && w.len() == self.order(), "one entry for every variable");
        let rows = AffineRows { m: self.m(), law: Law::Signs };
        rows.judge(self.q(), sizes(self.q())).residuals(&[z, w], Precision::Rounded)
    }
}

impl MixedLcp {
    /// Residuals of `(z, w)`, dimensionless, from the data as given: rows are `w - M z - q`, and the `w` of a
    /// free variable must be zero. See [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        self.boxed().residuals(z, w)
    }
}

impl BoxedLcp {
    /// Residuals of `(z, w)`, dimensionless, from the data as given: rows are `w - M z - q`, and the pairs are the
    /// distance of `z` to its lower bound with the positive part of `w`, and the distance to its upper bound with the
    /// negative part. See [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        assert!(z.len() == self.order() && w.len() == self.order(), "one entry for every variable");
        BoxedJudge::of_boxed(self).residuals(&[z, w], Precision::Rounded)
    }
}

impl Friction2d {
    /// Residuals of forces, dimensionless, from the data as given. The velocities `v = W r + q` follow from the forces,
    /// so that no equation is left; pairs are the normal force with the normal velocity, and the two distances
    /// `mu r_N + r_T` and `mu r_N - r_T` to the borders of the friction cone with the sliding forwards and backwards.
    /// See [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::{Friction2d, Lemke, Solver};
    /// let friction = Friction2d::new(mat![[1.0, 0.0], [0.0, 1.0]], vec![-2.0, -3.0], vec![0.5])?;
    /// let solution = Solver::<Friction2d>::solve(&Lemke::default(), &friction)?;
    /// let mut forces = friction.forces(&solution.t);
    /// assert_eq!(friction.residuals(&forces).worst(), 0.0);
    /// forces.tangential[0] = 1.1;
    /// assert!(friction.residuals(&forces).worst() > 0.01);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is not one normal and one tangential force for every contact.
    pub fn residuals(&self, forces: &ContactForces) -> Residuals {
        let ContactForces { normal, tangential } = forces;
        let contacts = self.contacts();
        assert!(normal.len() == contacts && tangential.len() == contacts, "two forces a contact");
        let forces: Vec<f64> = normal.iter().zip(tangential).flat_map(|(n, t)| [*n, *t]).collect();
        let rows = AffineRows { m: self.w(), law: Law::Friction(self.mu()) };
        rows.judge(self.q(), sizes(self.q())).residuals_of(&[&extended(&forces)])
    }
}

fn sizes(v: &[f64]) -> Vec<f64> {
    v.iter().map(|v| v.abs()).collect()
}

impl<R: JudgedRows> RowJudge<R> {
    /// A judge of the columns of a matrix, and of loads that are the sizes of the right-hand sides.
    fn of_columns(rows: R, columns: &[Column<'_>], c: Vec<f64>, loads: Vec<f64>) -> Self {
        let (row, col) = equilibrate(c.len(), columns);
        Self::of_couplings(rows, c, loads, &Couplings::of(columns, &row, &col))
    }

    /// A judge with the given couplings of rows; a row with any load counts in full.
    fn of_couplings(rows: R, c: Vec<f64>, mut loads: Vec<f64>, couplings: &Couplings) -> Self {
        let mut weights = Vec::new();
        couplings.weigh(loads.iter().copied(), &mut Vec::new(), |_, weight| weights.push(weight));
        loads.iter_mut().filter(|load| **load != 0.0).for_each(|load| *load = 1.0);
        Self { rows, sizes: sizes(&c), c, sources: loads, weights }
    }
}

/// A judge of points `(t, y)` of the general form.
pub(crate) type GeneralJudge<'a> = RowJudge<&'a HorizontalLcp>;

impl<'a> GeneralJudge<'a> {
    pub(crate) fn new(problem: &'a HorizontalLcp) -> Self {
        Self::with_right_hand_side(problem, problem.c().to_vec(), sizes(problem.c()))
    }

    /// A judge for another right-hand side, with the sizes of its terms.
    pub(crate) fn with_right_hand_side(
        problem: &'a HorizontalLcp,
        c: Vec<f64>,
        sizes: Vec<f64>,
    ) -> Self {
        let judge = Self::of_columns(problem, &problem.columns(), c, sizes.clone());
        Self { sizes, ..judge }
    }

    /// A judge with the factors that equilibrate the rows and all columns, of `A` and then of `B`.
    pub(crate) fn with_factors(problem: &'a HorizontalLcp, row: &[f64], col: &[f64]) -> Self {
        let loads = sizes(problem.c());
        let couplings = Couplings::of(&problem.columns(), row, col);
        Self::of_couplings(problem, problem.c().to_vec(), loads, &couplings)
    }
}

impl JudgedRows for &HorizontalLcp {
    fn variables(&self) -> usize {
        2 * self.order()
    }

    fn longest(&self) -> usize {
        2 * self.order() + 1
    }

    fn for_each_entry(&self, variable: usize, visit: impl FnMut(usize, f64)) {
        let column = match variable.checked_sub(self.order()) {
            None => self.column(variable, Side::T),
            Some(pair) => self.column(pair, Side::Y),
        };
        column.for_each(visit);
    }

    fn conditions(&self, x: &[f64], _: f64, out: &mut Conditions<'_, Self>) {
        let (t, y) = x.split_at(self.order());
        for (pair, (&t, &y)) in t.iter().zip(y).enumerate() {
            out.pair(Entry::new(pair, t), Entry::new(self.order() + pair, y));
        }
    }
}

/// A problem in `(z, w)`, or in forces and velocities, with the rows `M z - w = -q`.
pub(crate) struct AffineRows<'a> {
    m: &'a Matrix,
    law: Law<'a>,
}

/// The conditions on `z` and `w`.
enum Law<'a> {
    /// The condition that `z` and `w` are nonnegative.
    Signs,
    /// The conditions of the bounds of a problem.
    Bounds(&'a BoxedLcp),
    /// The conditions of a normal and a tangential component for every coefficient of friction.
    Friction(&'a [f64]),
}

/// A judge of points `(z, w)`.
pub(crate) type BoxedJudge<'a> = RowJudge<AffineRows<'a>>;

impl<'a> BoxedJudge<'a> {
    pub(crate) fn of_boxed(problem: &'a BoxedLcp) -> Self {
        AffineRows { m: problem.m(), law: Law::Bounds(problem) }.judge(problem.q(), problem.loads())
    }
}

impl AffineRows<'_> {
    fn judge(self, q: &[f64], loads: Vec<f64>) -> RowJudge<Self> {
        let columns: Vec<Column<'_>> = (0..q.len()).map(|j| self.m.slice(j)).collect();
        RowJudge::of_columns(self, &columns, q.iter().map(|q| -q).collect(), loads)
    }
}

impl JudgedRows for AffineRows<'_> {
    fn variables(&self) -> usize {
        2 * self.m.ncols()
    }

    fn longest(&self) -> usize {
        self.m.ncols() + 2
    }

    fn for_each_entry(&self, variable: usize, mut visit: impl FnMut(usize, f64)) {
        match variable.checked_sub(self.m.ncols()) {
            None => self.m.slice(variable).for_each(visit),
            Some(row) => visit(row, -1.0),
        }
    }

    fn conditions(&self, x: &[f64], unit: f64, out: &mut Conditions<'_, Self>) {
        let n = self.m.ncols();
        let (of_z, of_w) = (|j: usize| Entry::new(j, x[j]), |j: usize| Entry::new(n + j, x[n + j]));
        match self.law {
            Law::Signs => (0..n).for_each(|j| out.pair(of_z(j), of_w(j))),
            Law::Bounds(boxed) => {
                for (j, (z, w)) in x[..n].iter().zip(&x[n..]).enumerate() {
                    let [lower, upper] = [boxed.lower()[j], boxed.upper()[j]].map(|it| it * unit);
                    for (distance, w) in [(z - lower, w.max(0.0)), (upper - z, (-w).max(0.0))] {
                        let w = Entry::new(n + j, w);
                        if distance.is_finite() {
                            out.pair(Entry::new(j, distance), w);
                        } else {
                            out.zero(w);
                        }
                    }
                }
            }
            Law::Friction(mu) => {
                for (i, &mu) in mu.iter().enumerate() {
                    let [normal, tangential] = [2 * i, 2 * i + 1];
                    out.pair(of_z(normal), of_w(normal));
                    out.friction(mu * x[normal], of_z(tangential), of_w(tangential));
                }
            }
        }
    }
}
