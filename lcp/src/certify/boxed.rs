//! Points `(z, w)` of standard, mixed and boxed problems.

use super::ledger::{Digits, Entry, Ledger, Precision, Rows};
use super::{Residuals, weights};
use crate::extended::Extended;
use crate::matrix::Column;
use crate::{BoxedLcp, Lcp, Matrix, MixedLcp};

impl Lcp {
    /// Residuals of `(z, w)`, dimensionless, from the data as given: rows are `w - M z - q`. See
    /// [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        BoxedJudge::of_standard(self).residuals(z, w, Precision::Exact)
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
    /// Residuals of `(z, w)`, dimensionless, from the data as given: rows are `w - M z - q`, and the pairs are
    /// the distance of `z` to its lower bound with the positive part of `w`, and that to its upper bound with
    /// the negative part. See [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        BoxedJudge::of_boxed(self).residuals(z, w, Precision::Exact)
    }
}

/// A problem in `(z, w)` with the weights of its rows.
pub(crate) struct BoxedJudge<'a> {
    m: &'a Matrix,
    q: &'a [f64],
    /// Lower and upper bounds; none are `0` and `inf`.
    bounds: Option<(&'a [f64], &'a [f64])>,
    weights: Vec<f64>,
    /// Terms of a row at most.
    length: f64,
}

impl<'a> BoxedJudge<'a> {
    pub(crate) fn of_standard(problem: &'a Lcp) -> Self {
        Self::new(problem.m(), problem.q(), None)
    }

    pub(crate) fn of_boxed(problem: &'a BoxedLcp) -> Self {
        let bounds = (problem.lower(), problem.upper());
        Self::new(problem.m(), problem.q(), Some(bounds))
    }

    fn new(m: &'a Matrix, q: &'a [f64], bounds: Option<(&'a [f64], &'a [f64])>) -> Self {
        let n = q.len();
        // Bounds that keep a variable from zero are loads, too.
        let mut loads: Vec<f64> = q.iter().map(|q| q.abs()).collect();
        for (j, (lower, upper)) in bounds.into_iter().flat_map(|(l, u)| l.iter().zip(u)).enumerate()
        {
            let nearest = lower.max(0.0) - upper.min(0.0);
            if nearest != 0.0 {
                m.slice(j).for_each(|i, v| loads[i] += (v * nearest).abs());
            }
        }
        let columns: Vec<Column<'_>> = (0..n).map(|j| m.slice(j)).collect();
        let weights = weights::weights(&columns, &loads);
        Self { m, q, bounds, weights, length: n as f64 + 2.0 }
    }

    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub(crate) fn residuals(&self, z: &[f64], w: &[f64], precision: Precision) -> Residuals {
        let n = self.q.len();
        assert!(z.len() == n && w.len() == n, "one entry for every variable");
        if z.iter().chain(w).any(|v| !v.is_finite()) {
            return Residuals::infinite();
        }
        let ledger = self.ledger(z, w);
        if precision == Precision::Exact && ledger.is_hidden(self.length) {
            let extended = |v: &[f64]| v.iter().copied().map(Extended::from).collect::<Vec<_>>();
            return self.residuals_of(&extended(z), &extended(w));
        }
        ledger.finish(self.length, precision)
    }

    /// The same of a point of twice the digits.
    pub(crate) fn residuals_of(&self, z: &[Extended], w: &[Extended]) -> Residuals {
        self.ledger(z, w).finish(self.length, Precision::Exact)
    }

    fn ledger<X: Digits>(&self, z: &[X], w: &[X]) -> Ledger<'_> {
        let mut rows = Rows::<X>::new(self.q.iter().map(|q| (-q, q.abs())));
        for (j, &z) in z.iter().enumerate().filter(|(_, z)| z.rounded() != 0.0) {
            self.m.slice(j).for_each(|i, v| rows.add(i, -v, z));
        }
        w.iter().enumerate().for_each(|(i, w)| rows.add(i, 1.0, *w));
        let mut ledger = Ledger::new(rows, &self.weights);
        for (j, (z, w)) in z.iter().zip(w).enumerate() {
            self.conditions(j, (z.rounded(), w.rounded()), &mut ledger);
        }
        ledger
    }

    fn conditions(&self, j: usize, (z, w): (f64, f64), ledger: &mut Ledger<'_>) {
        let of_z = |visit: &mut dyn FnMut(usize, f64)| self.m.slice(j).for_each(visit);
        let of_w = |visit: &mut dyn FnMut(usize, f64)| visit(j, 1.0);
        let (lower, upper) =
            self.bounds.map_or((0.0, f64::INFINITY), |(lower, upper)| (lower[j], upper[j]));
        for (distance, w) in [(z - lower, w.max(0.0)), (upper - z, (-w).max(0.0))] {
            let w = Entry { value: w, column: &of_w };
            if distance.is_finite() {
                ledger.pair(&Entry { value: distance, column: &of_z }, &w);
            } else {
                ledger.zero(&w);
            }
        }
    }
}
