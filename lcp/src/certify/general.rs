//! Points of the general form.

use std::borrow::Cow;

use super::Residuals;
use super::constants::INTO_RANGE;
use super::rows::{self, Digits, Entry, Measure, Point, Precision, RowResiduals, Rows};
use super::significance::{Term, Terms, terms_of};
use super::weights::{self, into_range, weights_in_range};
use crate::extended::{Extended, extended};
use crate::matrix::Column;
use crate::scaling::equilibrate;
use crate::{HorizontalLcp, Side};

impl HorizontalLcp {
    /// Residuals of a point, dimensionless, from the data as given; [`Residuals::worst`] decides.
    ///
    /// What is left of row `i`, `r_i = (A t + B y - c)_i`, is measured by the terms of that row,
    /// `(|A||t| + |B||y| + |c|)_i`, and so is what a component changes in its rows that violates its sign, or is the
    /// smaller one of a pair whose variables are both positive. No unit matters, neither of a row nor of a
    /// variable. In addition `loads` compares what is left with the largest right-hand side of the connected
    /// part of the row.
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
        GeneralJudge::new(self).residuals(t, y, Precision::Rounded)
    }
}

/// A general problem with the weights of its rows.
pub(crate) struct GeneralJudge<'a> {
    problem: &'a HorizontalLcp,
    /// The right-hand side, every entry with the size of its terms.
    c: Vec<(f64, f64)>,
    weights: Vec<f64>,
    /// Terms of a row at most.
    length: f64,
}

impl<'a> GeneralJudge<'a> {
    pub(crate) fn new(problem: &'a HorizontalLcp) -> Self {
        Self::with_right_hand_side(problem, right_hand_side(problem))
    }

    /// For another right-hand side, of which every entry comes with the size of its terms.
    pub(crate) fn with_right_hand_side(problem: &'a HorizontalLcp, c: Vec<(f64, f64)>) -> Self {
        let (row, col) = equilibrate(problem.order(), &problem.columns());
        Self::with_factors(problem, c, &row, &col)
    }

    /// With the factors that equilibrate the rows and all columns, of `A` and then of `B`.
    pub(crate) fn with_factors(
        problem: &'a HorizontalLcp,
        c: Vec<(f64, f64)>,
        row: &[f64],
        col: &[f64],
    ) -> Self {
        let loads: Vec<f64> = c.iter().map(|(_, size)| *size).collect();
        let weights = weights::weights_of(&problem.columns(), &loads, row, col);
        let length = 2.0 * problem.order() as f64 + 1.0;
        Self { problem, c, weights, length }
    }

    /// # Panics
    /// If `t` or `y` does not have one entry for every pair.
    pub(crate) fn residuals(&self, t: &[f64], y: &[f64], precision: Precision) -> Residuals {
        let n = self.problem.order();
        assert!(t.len() == n && y.len() == n, "a point has one entry for every pair");
        if t.iter().chain(y).any(|v| !v.is_finite()) {
            return Residuals::infinite();
        }
        let residuals = self.in_range(t, y, precision);
        if residuals.worst().is_finite() {
            return residuals;
        }
        let c = self.c.iter().map(|(c, size)| (c * INTO_RANGE, size * INTO_RANGE)).collect();
        let judge = Self { c, weights: weights_in_range(&self.weights), ..*self };
        judge.in_range(&into_range(t), &into_range(y), precision)
    }

    /// The same unless a sum of terms leaves the range of numbers.
    fn in_range(&self, t: &[f64], y: &[f64], precision: Precision) -> Residuals {
        let measure = self.measure();
        rows::residuals_or_refined(&self.at(t, y), measure, precision, || {
            rows::residuals(&self.at(&extended(t), &extended(y)), measure, precision)
        })
    }

    /// The same of a point of twice the digits.
    pub(crate) fn residuals_of(&self, t: &[Extended], y: &[Extended]) -> Residuals {
        rows::residuals(&self.at(t, y), self.measure(), Precision::Exact)
    }

    fn measure(&self) -> Measure<'_> {
        Measure { weights: &self.weights, length: self.length }
    }

    fn at<'b, X: Digits>(&'b self, t: &'b [X], y: &'b [X]) -> JudgedPoint<'b, X> {
        JudgedPoint { judge: self, t, y }
    }
}

/// A point.
struct JudgedPoint<'a, X> {
    judge: &'a GeneralJudge<'a>,
    t: &'a [X],
    y: &'a [X],
}

impl<X: Digits> JudgedPoint<'_, X> {
    /// Every variable that is not zero, with its number and its column.
    fn variables(&self) -> impl Iterator<Item = (usize, X, Column<'_>)> {
        let sides = [(Side::T, self.t), (Side::Y, self.y)];
        sides.into_iter().flat_map(move |(side, x)| {
            let n = x.len();
            let first = if side == Side::T { 0 } else { n };
            let nonzero = x.iter().enumerate().filter(|(_, x)| x.rounded() != 0.0);
            nonzero.map(move |(k, x)| (first + k, *x, self.judge.problem.column(k, side)))
        })
    }
}

impl<X: Digits> Terms for JudgedPoint<'_, X> {
    fn for_each_term(&self, mut visit: impl FnMut(Term)) {
        for (variable, x, column) in self.variables() {
            terms_of(&mut visit, variable, x.rounded(), column);
        }
    }
}

impl<X: Digits> Point for JudgedPoint<'_, X> {
    fn rows(&self) -> (Cow<'_, [f64]>, Cow<'_, [f64]>) {
        let mut rows = Rows::<X>::new(self.judge.c.iter().map(|(c, size)| (-c, *size)));
        self.variables().for_each(|(_, x, column)| column.for_each(|i, v| rows.add(i, v, x)));
        let (rest, terms) = rows.rounded();
        (rest.into(), terms.into())
    }

    fn sources(&self) -> Vec<f64> {
        let loads: Vec<f64> = self.judge.c.iter().map(|(c, _)| *c).collect();
        rows::in_full(&loads)
    }

    fn conditions(&self, out: &mut RowResiduals<'_>) {
        let problem = self.judge.problem;
        for (pair, (t, y)) in self.t.iter().zip(self.y).enumerate() {
            let [of_t, of_y] = [Side::T, Side::Y].map(|side| problem.column(pair, side));
            out.pair(
                Entry { value: t.rounded(), column: of_t },
                Entry { value: y.rounded(), column: of_y },
            );
        }
    }
}

/// Every entry with its size.
pub(crate) fn right_hand_side(problem: &HorizontalLcp) -> Vec<(f64, f64)> {
    problem.c().iter().map(|c| (*c, c.abs())).collect()
}
