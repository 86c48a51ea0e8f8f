//! Points `(z, w)` of standard, mixed and boxed problems.

use std::borrow::Cow;

use super::Residuals;
use super::rows::{self, Digits, Entry, InRow, Measure, Point, Precision, RowResiduals, Rows};
use super::significance::{Term, Terms, terms_of};
use super::weights::{self, into_range, weights_in_range};
use crate::extended::{Extended, extended};
use crate::matrix::Column;
use crate::{BoxedLcp, Lcp, Matrix, MixedLcp};

impl Lcp {
    /// Residuals of `(z, w)`, dimensionless, from the data as given: rows are `w - M z - q`. See
    /// [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        BoxedJudge::of_standard(self).residuals(z, w, Precision::Rounded)
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
        BoxedJudge::of_boxed(self).residuals(z, w, Precision::Rounded)
    }
}

/// Lower and upper bounds of all variables.
#[derive(Clone, Copy)]
struct Bounds<'a> {
    lower: &'a [f64],
    upper: &'a [f64],
}

/// A problem in `(z, w)` with the weights of its rows.
pub(crate) struct BoxedJudge<'a> {
    m: &'a Matrix,
    q: &'a [f64],
    /// Lower and upper bounds; none are `0` and `inf`.
    bounds: Option<Bounds<'a>>,
    /// The sizes of the right-hand sides, with those of the bounds.
    loads: Vec<f64>,
    weights: Vec<f64>,
    /// Terms of a row at most.
    length: f64,
}

impl<'a> BoxedJudge<'a> {
    pub(crate) fn of_standard(problem: &'a Lcp) -> Self {
        let loads = problem.q().iter().map(|q| q.abs()).collect();
        Self::new(problem.m(), problem.q(), loads, None)
    }

    pub(crate) fn of_boxed(problem: &'a BoxedLcp) -> Self {
        let bounds = Bounds { lower: problem.lower(), upper: problem.upper() };
        Self::new(problem.m(), problem.q(), problem.loads(), Some(bounds))
    }

    fn new(m: &'a Matrix, q: &'a [f64], loads: Vec<f64>, bounds: Option<Bounds<'a>>) -> Self {
        let n = q.len();
        let columns: Vec<Column<'_>> = (0..n).map(|j| m.slice(j)).collect();
        let weights = weights::weights(&columns, &loads);
        Self { m, q, bounds, loads, weights, length: n as f64 + 2.0 }
    }

    /// # Panics
    /// If `z` or `w` does not have `n` entries.
    pub(crate) fn residuals(&self, z: &[f64], w: &[f64], precision: Precision) -> Residuals {
        let n = self.q.len();
        assert!(z.len() == n && w.len() == n, "one entry for every variable");
        if z.iter().chain(w).any(|v| !v.is_finite()) {
            return Residuals::infinite();
        }
        let residuals = self.in_range(z, w, precision);
        if residuals.worst().is_finite() {
            return residuals;
        }
        let q = into_range(self.q);
        let bounds = self.bounds.map(|it| (into_range(it.lower), into_range(it.upper)));
        let judge = BoxedJudge {
            m: self.m,
            q: &q,
            bounds: bounds.as_ref().map(|(lower, upper)| Bounds { lower, upper }),
            loads: into_range(&self.loads),
            weights: weights_in_range(&self.weights),
            length: self.length,
        };
        judge.in_range(&into_range(z), &into_range(w), precision)
    }

    /// The same unless a sum of terms leaves the range of numbers.
    fn in_range(&self, z: &[f64], w: &[f64], precision: Precision) -> Residuals {
        rows::residuals_or_refined(&self.at(z, w), self.measure(), precision, || {
            rows::residuals(&self.at(&extended(z), &extended(w)), self.measure(), precision)
        })
    }

    /// The same of a point of twice the digits.
    pub(crate) fn residuals_of(&self, z: &[Extended], w: &[Extended]) -> Residuals {
        rows::residuals(&self.at(z, w), self.measure(), Precision::Exact)
    }

    fn measure(&self) -> Measure<'_> {
        Measure { weights: &self.weights, length: self.length }
    }

    fn at<'b, X: Digits>(&'b self, z: &'b [X], w: &'b [X]) -> JudgedPoint<'b, X> {
        JudgedPoint { judge: self, z, w }
    }

    fn conditions_of(&self, j: usize, z: f64, w: f64, out: &mut RowResiduals<'_>) {
        let (lower, upper) =
            self.bounds.map_or((0.0, f64::INFINITY), |it| (it.lower[j], it.upper[j]));
        for (distance, w) in [(z - lower, w.max(0.0)), (upper - z, (-w).max(0.0))] {
            let w = Entry { value: w, column: InRow(j) };
            if distance.is_finite() {
                out.pair(Entry { value: distance, column: self.m.slice(j) }, w);
            } else {
                out.zero(w);
            }
        }
    }
}

/// A point.
struct JudgedPoint<'a, X> {
    judge: &'a BoxedJudge<'a>,
    z: &'a [X],
    w: &'a [X],
}

impl<X: Digits> Terms for JudgedPoint<'_, X> {
    fn for_each_term(&self, mut visit: impl FnMut(Term)) {
        let n = self.z.len();
        for (i, w) in self.w.iter().enumerate().filter(|(_, w)| w.rounded() != 0.0) {
            visit(Term { row: i, variable: n + i, value: w.rounded() });
        }
        for (variable, z) in self.z.iter().enumerate() {
            terms_of(&mut visit, variable, z.rounded(), self.judge.m.slice(variable));
        }
    }
}

impl<X: Digits> Point for JudgedPoint<'_, X> {
    fn rows(&self) -> (Cow<'_, [f64]>, Cow<'_, [f64]>) {
        let mut rows = Rows::<X>::new(self.judge.q.iter().map(|q| (-q, q.abs())));
        for (j, &z) in self.z.iter().enumerate().filter(|(_, z)| z.rounded() != 0.0) {
            self.judge.m.slice(j).for_each(|i, v| rows.add(i, -v, z));
        }
        self.w.iter().enumerate().for_each(|(i, w)| rows.add(i, 1.0, *w));
        let (rest, terms) = rows.rounded();
        (rest.into(), terms.into())
    }

    fn sources(&self) -> Vec<f64> {
        rows::in_full(&self.judge.loads)
    }

    fn conditions(&self, out: &mut RowResiduals<'_>) {
        for (j, (z, w)) in self.z.iter().zip(self.w).enumerate() {
            self.judge.conditions_of(j, z.rounded(), w.rounded(), out);
        }
    }
}
