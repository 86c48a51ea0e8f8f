//! Rows at a point: what is left of each, the sizes of its terms, and what violated conditions add.

use std::borrow::Cow;

use super::Residuals;
use super::constants::{LARGEST_ROUNDING, MINOR, ROUNDING, SMALL};
use super::significance::{Terms, significance};
use crate::extended::Extended;
use crate::matrix::Column;

/// Numbers in which rows are summed.
pub(crate) trait Digits: Copy {
    /// Adds `v x` to a sum.
    fn add_product(sum: &mut Self, v: f64, x: Self);

    /// From a number of the data.
    fn of(v: f64) -> Self;

    /// The nearest `f64`.
    fn rounded(self) -> f64;
}

impl Digits for f64 {
    fn add_product(sum: &mut Self, v: f64, x: Self) {
        *sum += v * x;
    }

    fn of(v: f64) -> Self {
        v
    }

    fn rounded(self) -> f64 {
        self
    }
}

impl Digits for Extended {
    fn add_product(sum: &mut Self, v: f64, x: Self) {
        *sum += x * v;
    }

    fn of(v: f64) -> Self {
        v.into()
    }

    fn rounded(self) -> f64 {
        Extended::rounded(self)
    }
}

/// How exactly the rows of a point are computed, and what of the loads rounding may excuse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Precision {
    /// In `f64`, less the rounding errors that the sums may have; rows that matter to no load count like all others: of
    /// points on the way.
    Quick,
    /// In `f64`, less these rounding errors: of points that are given up.
    Usual,
    /// With twice the digits where that may matter, less the rounding error of a point that is exact but for the
    /// last digit of its numbers: of answers.
    Rounded,
    /// The same where only what is left of the loads is asked for: all rows count.
    RoundedLoads,
    /// With twice the digits: of points about to be called solved, and of those that have these digits.
    Exact,
}

impl Precision {
    /// Whether rows are summed in `f64`, however large their terms are.
    fn is_usual(self) -> bool {
        matches!(self, Self::Quick | Self::Usual)
    }

    /// Whether rows that matter to no load are told from the others.
    fn tells_rows(self) -> bool {
        !matches!(self, Self::Quick | Self::RoundedLoads)
    }
}

/// Rows at a point.
pub(super) struct Rows<X> {
    pub(super) rest: Vec<X>,
    pub(super) terms: Vec<f64>,
}

impl<X: Digits> Rows<X> {
    /// With a first term of every row, and its size.
    pub(super) fn new(first: impl Iterator<Item = (f64, f64)>) -> Self {
        let (rest, terms) = first.map(|(v, size)| (X::of(v), size)).unzip();
        Self { rest, terms }
    }

    /// What is left, rounded, and the terms.
    pub(super) fn rounded(self) -> (Vec<f64>, Vec<f64>) {
        (self.rest.into_iter().map(Digits::rounded).collect(), self.terms)
    }

    pub(super) fn add(&mut self, row: usize, v: f64, x: X) {
        X::add_product(&mut self.rest[row], v, x);
        self.terms[row] += (v * x.rounded()).abs();
    }
}

/// What rows are measured by.
#[derive(Clone, Copy)]
pub(super) struct Measure<'a> {
    /// One over the loads that every row feels.
    pub(super) weights: &'a [f64],
    /// Terms of a row at most.
    pub(super) length: f64,
}

/// The residuals of a point while its conditions are gone through.
pub(super) struct RowResiduals<'a> {
    /// What is left of every row.
    rest: &'a [f64],
    terms: &'a [f64],
    /// One over the loads that every row feels.
    weights: &'a [f64],
    /// What every row counts; all of them one where it is empty.
    significance: Vec<f64>,
    /// What the changes that make the point feasible and complementary add to it; empty where there are none.
    changes: Vec<f64>,
    residuals: Residuals,
}

/// A point whose rows and conditions can be gone through.
pub(super) trait Point: Terms {
    /// What is left of the rows, and their terms.
    fn rows(&self) -> (Cow<'_, [f64]>, Cow<'_, [f64]>);

    /// What the right-hand side of every row makes it count, between zero and one.
    fn sources(&self) -> Vec<f64>;

    /// Goes through the conditions on the variables.
    fn conditions(&self, out: &mut RowResiduals<'_>);
}

/// The residuals of a point, or the `refined` ones of the same with twice the digits where the rounding errors of its
/// terms are not small against the loads.
pub(super) fn residuals_or_refined(
    point: &impl Point,
    measure: Measure<'_>,
    precision: Precision,
    refined: impl FnOnce() -> Residuals,
) -> Residuals {
    let (rest, terms) = point.rows();
    let mut sizes = terms.iter().zip(measure.weights);
    let is_hidden = |(terms, weight)| measure.length * f64::EPSILON * terms * weight > SMALL;
    if !precision.is_usual() && sizes.any(is_hidden) {
        return refined();
    }
    residuals_of_rows(point, &rest, &terms, measure, precision)
}

/// The residuals of a point.
pub(super) fn residuals(
    point: &impl Point,
    measure: Measure<'_>,
    precision: Precision,
) -> Residuals {
    let (rest, terms) = point.rows();
    residuals_of_rows(point, &rest, &terms, measure, precision)
}

/// Rows that do not matter to the loads are told only where something in them seems to be wrong.
fn residuals_of_rows(
    point: &impl Point,
    rest: &[f64],
    terms: &[f64],
    measure: Measure<'_>,
    precision: Precision,
) -> Residuals {
    let residuals = |significance| {
        let mut out = RowResiduals::new(rest, terms, measure.weights, significance);
        point.conditions(&mut out);
        out.finished(measure.length, precision)
    };
    let strict = residuals(Vec::new());
    let Residuals { equation, natural, loads, .. } = strict;
    let apparent = equation.max(natural);
    if !precision.tells_rows() || apparent <= SMALL || loads > MINOR * apparent {
        return strict;
    }
    residuals(significance(terms, &point.sources(), measure.weights, point))
}

/// Rows with a right-hand side count in full.
pub(super) fn in_full(loads: &[f64]) -> Vec<f64> {
    loads.iter().map(|load| if *load == 0.0 { 0.0 } else { 1.0 }).collect()
}

/// The coefficients that a variable has in the rows.
pub(super) trait Coefficients: Copy {
    /// Shows row and value of each.
    fn for_each(self, visit: impl FnMut(usize, f64));
}

impl Coefficients for Column<'_> {
    fn for_each(self, visit: impl FnMut(usize, f64)) {
        Column::for_each(self, visit);
    }
}

impl Coefficients for &[(usize, f64)] {
    fn for_each(self, mut visit: impl FnMut(usize, f64)) {
        for (i, v) in self {
            visit(*i, *v);
        }
    }
}

/// One in a single row.
#[derive(Clone, Copy)]
pub(super) struct InRow(pub(super) usize);

impl Coefficients for InRow {
    fn for_each(self, mut visit: impl FnMut(usize, f64)) {
        visit(self.0, 1.0);
    }
}

/// A variable of a pair: its value, and the coefficients that it has in the rows.
#[derive(Clone, Copy)]
pub(super) struct Entry<C> {
    pub(super) value: f64,
    pub(super) column: C,
}

impl<'a> RowResiduals<'a> {
    fn new(rest: &'a [f64], terms: &'a [f64], weights: &'a [f64], significance: Vec<f64>) -> Self {
        let residuals = Residuals::default();
        let mut out = Self { rest, terms, weights, significance, changes: Vec::new(), residuals };
        let shares = rest.iter().enumerate().map(|(i, v)| out.share(i, *v));
        out.residuals.equation = shares.fold(0.0, f64::max);
        out
    }

    /// What a change of a row counts.
    fn share(&self, i: usize, v: f64) -> f64 {
        self.significance.get(i).unwrap_or(&1.0) * ratio(v, self.terms[i])
    }

    /// `t >= 0`, `y >= 0`, one of them zero.
    pub(super) fn pair(&mut self, t: Entry<impl Coefficients>, y: Entry<impl Coefficients>) {
        self.not_negative(t);
        self.not_negative(y);
        if t.value > 0.0 && y.value > 0.0 {
            // Which one is the smaller is told by the loads, and by the terms where there are none.
            let by_loads = self.burden(t).total_cmp(&self.burden(y));
            let smaller = by_loads.then_with(|| self.effect(t).total_cmp(&self.effect(y)));
            let effect = if smaller.is_le() { self.removed(t) } else { self.removed(y) };
            self.residuals.complementarity = self.residuals.complementarity.max(effect);
        }
    }

    fn not_negative(&mut self, entry: Entry<impl Coefficients>) {
        if entry.value < 0.0 {
            self.zero(entry);
        }
    }

    /// A variable that must be zero.
    pub(super) fn zero(&mut self, entry: Entry<impl Coefficients>) {
        if entry.value != 0.0 {
            let effect = self.removed(entry);
            self.residuals.feasibility = self.residuals.feasibility.max(effect);
        }
    }

    /// The effect of a change to zero, which is noted.
    fn removed(&mut self, entry: Entry<impl Coefficients>) -> f64 {
        if self.changes.is_empty() {
            self.changes = vec![0.0; self.rest.len()];
        }
        entry.column.for_each(|i, v| self.changes[i] += (v * entry.value).abs());
        self.effect(entry)
    }

    /// The largest part of the terms of a row that a variable is. One without any row counts by itself.
    fn effect(&self, entry: Entry<impl Coefficients>) -> f64 {
        let mut effect: Option<f64> = None;
        entry.column.for_each(|i, v| {
            if v != 0.0 {
                let part = self.share(i, v * entry.value);
                effect = Some(effect.map_or(part, |effect| effect.max(part)));
            }
        });
        effect.unwrap_or(1.0)
    }

    /// The same in units of the loads.
    fn burden(&self, entry: Entry<impl Coefficients>) -> f64 {
        let mut burden = 0.0_f64;
        let weighed = |i: usize, v: f64| (v * entry.value).abs() * self.weights[i];
        entry.column.for_each(|i, v| burden = burden.max(weighed(i, v)));
        burden
    }

    /// The residuals. In rows of up to so many terms that were summed in `f64` rounding errors are left out.
    fn finished(&self, length: f64, precision: Precision) -> Residuals {
        let Self { rest, terms, weights, changes, .. } = self;
        let mut residuals = self.residuals;
        let noise = match precision {
            Precision::Quick | Precision::Usual => length * f64::EPSILON,
            Precision::Rounded | Precision::RoundedLoads => ROUNDING,
            Precision::Exact => 0.0,
        };
        let most = if precision.is_usual() { f64::INFINITY } else { LARGEST_ROUNDING };
        for (i, (rest, weight)) in rest.iter().zip(*weights).enumerate() {
            let rounding = (noise * terms[i] * weight).min(most);
            let left = (rest.abs() * weight - rounding).max(0.0);
            let left = left + changes.get(i).unwrap_or(&0.0) * weight;
            // A NaN is no small residual.
            residuals.loads = if left.is_nan() { f64::INFINITY } else { residuals.loads.max(left) };
        }
        residuals.natural = residuals.feasibility.max(residuals.complementarity);
        residuals
    }
}

/// A part of the terms of a row. Terms beyond the range of numbers say nothing, which is no small part.
pub(crate) fn ratio(v: f64, terms: f64) -> f64 {
    if !(v.is_finite() && terms.is_finite()) {
        f64::INFINITY
    } else if v == 0.0 {
        0.0
    } else if terms > 0.0 {
        v.abs() / terms
    } else {
        1.0
    }
}
