//! The judge of points: sums of rows, the conditions on variables, and the resulting residuals.

use std::ops::{AddAssign, Mul};

use super::Residuals;
use super::constants::{INTO_RANGE, MILLIONTH, ROUNDING};
use super::significance::{Term, significance};
use crate::extended::{Extended, extended};
use crate::vector::SMALL;

/// The rows of a problem, `sum_j a_ij x_j = c_i`, and the conditions on their variables.
pub(crate) trait JudgedRows {
    /// Number of variables.
    fn variables(&self) -> usize;

    /// Largest number of terms of a row.
    fn longest(&self) -> usize;

    /// Calls `visit` with row and coefficient of every entry of a variable.
    fn for_each_entry(&self, variable: usize, visit: impl FnMut(usize, f64));

    /// Passes the conditions at a point that is multiplied by `unit` to `out`.
    fn conditions(&self, x: &[f64], unit: f64, out: &mut Conditions<'_, Self>)
    where
        Self: Sized;
}

/// A problem with the measures of its rows.
pub(crate) struct RowJudge<R> {
    pub(super) rows: R,
    /// The right-hand sides.
    pub(super) c: Vec<f64>,
    /// The sizes of the terms of the right-hand sides.
    pub(super) sizes: Vec<f64>,
    /// The weight of every row by its right-hand side, between zero and one.
    pub(super) sources: Vec<f64>,
    /// One over the loads that act on every row.
    pub(super) weights: Vec<f64>,
}

/// The arithmetic in which the rows of a point are computed, and the part of the loads that rounding may excuse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Precision {
    /// `f64`, less the possible rounding errors of the sums, for points on the way; rows that matter to no load count
    /// like all others.
    Quick,
    /// Twice the digits if that may matter, less the rounding error of a point that is exact except for the last digit
    /// of its numbers, for answers.
    Rounded,
    /// Twice the digits if that may matter, for points about to be called solved and for points with such digits.
    Exact,
}

/// Numbers in which rows are summed.
trait Digits: Copy + From<f64> + Into<f64> + Mul<f64, Output = Self> + AddAssign {}

impl Digits for f64 {}

impl Digits for Extended {}

/// A point with the sums of its rows.
struct RowSums {
    x: Vec<f64>,
    /// The factor by which the point is multiplied.
    unit: f64,
    /// The residual of every row.
    rest: Vec<f64>,
    /// The sum of the sizes of the terms of a row.
    terms: Vec<f64>,
}

impl<R: JudgedRows> RowJudge<R> {
    /// Residuals of a point, given by all its variables part by part. If the last parts are missing, their variables
    /// follow from the last rows, in which each has the coefficient minus one.
    pub(crate) fn residuals(&self, parts: &[&[f64]], precision: Precision) -> Residuals {
        in_range(parts, |x, unit| {
            let mut point = self.at(x, unit);
            let is_hidden = |i| self.noise() * self.share_of_loads(&point, i) > SMALL;
            if precision != Precision::Quick && (0..self.c.len()).any(is_hidden) {
                point = self.at(&extended(x), unit);
            }
            self.judged(&point, precision)
        })
    }

    /// Residuals of a double-double point.
    pub(crate) fn residuals_of(&self, parts: &[&[Extended]]) -> Residuals {
        in_range(parts, |x, unit| self.judged(&self.at(x, unit), Precision::Exact))
    }

    fn at<X: Digits>(&self, x: &[X], unit: f64) -> RowSums {
        let mut rest: Vec<X> = self.c.iter().map(|c| X::from(-c * unit)).collect();
        let mut terms: Vec<f64> = self.sizes.iter().map(|size| size * unit).collect();
        let mut rounded: Vec<f64> = x.iter().map(|x| (*x).into()).collect();
        for (j, (x, size)) in x.iter().zip(&rounded).enumerate().filter(|(_, (_, x))| **x != 0.0) {
            self.rows.for_each_entry(j, |i, v| {
                rest[i] += *x * v;
                terms[i] += (v * size).abs();
            });
        }
        let mut rest: Vec<f64> = rest.into_iter().map(Into::into).collect();
        let following = rest.len() + rounded.len() - self.rows.variables();
        rounded.extend_from_slice(&rest[following..]);
        rest[following..].fill(0.0);
        RowSums { x: rounded, unit, rest, terms }
    }

    /// The rounding errors of a sum in `f64`, relative to its terms.
    fn noise(&self) -> f64 {
        self.rows.longest() as f64 * f64::EPSILON
    }

    /// One over the loads that act on a row, in units of a point.
    fn weight(&self, unit: f64, i: usize) -> f64 {
        (self.weights[i] / unit).min(f64::MAX)
    }

    /// The terms of a row in units of the loads that act on it.
    fn share_of_loads(&self, point: &RowSums, i: usize) -> f64 {
        point.terms[i] * self.weight(point.unit, i)
    }

    /// All terms at a point that are not zero.
    fn terms(&self, x: &[f64]) -> Vec<Term> {
        let mut terms = Vec::new();
        for (variable, x) in x.iter().enumerate().filter(|(_, x)| **x != 0.0) {
            self.rows.for_each_entry(variable, |row, v| {
                if v * x != 0.0 {
                    terms.push(Term { row, variable, size: (v * x).abs() });
                }
            });
        }
        terms
    }

    /// The residuals of a point. Rows that do not matter to the loads are identified only if the point seems to be
    /// wrong in them.
    fn judged(&self, point: &RowSums, precision: Precision) -> Residuals {
        let strict = Conditions::residuals(self, point, Vec::new(), precision);
        let apparent = strict.equation.max(strict.natural);
        if precision == Precision::Quick || apparent <= strict.loads.max(SMALL) {
            return strict;
        }
        let burden = |i| match point.terms[i] {
            0.0 => 0.0,
            _ if self.weights[i] > 0.0 => self.share_of_loads(point, i).min(1.0),
            _ => 1.0,
        };
        let counts = significance(&self.terms(&point.x), point.x.len(), &self.sources, burden);
        Conditions::residuals(self, point, counts, precision)
    }
}

/// The residuals of a point; those of small multiples of it if a sum of terms leaves the range of numbers.
fn in_range<X: Digits>(parts: &[&[X]], residuals: impl Fn(&[X], f64) -> Residuals) -> Residuals {
    let mut x = parts.concat();
    if x.iter().any(|x| !Into::<f64>::into(*x).is_finite()) {
        return Residuals::infinite();
    }
    let found = residuals(&x, 1.0);
    if found.worst().is_finite() {
        return found;
    }
    for x in &mut x {
        *x = *x * INTO_RANGE;
    }
    residuals(&x, INTO_RANGE)
}

/// A variable of a pair, with a value that may differ from its own.
#[derive(Clone, Copy)]
pub(crate) struct Entry {
    variable: usize,
    value: f64,
}

impl Entry {
    pub(super) fn new(variable: usize, value: f64) -> Self {
        Self { variable, value }
    }
}

/// The residuals of a point while its conditions are visited.
pub(crate) struct Conditions<'a, R> {
    judge: &'a RowJudge<R>,
    point: &'a RowSums,
    /// The weight of every row; empty if all weights are one.
    significance: Vec<f64>,
    /// The sizes that are added to a row by the changes that make the point feasible and complementary; empty without
    /// such changes.
    changes: Vec<f64>,
    residuals: Residuals,
}

impl<'a, R: JudgedRows> Conditions<'a, R> {
    fn residuals(
        judge: &'a RowJudge<R>,
        point: &'a RowSums,
        significance: Vec<f64>,
        precision: Precision,
    ) -> Residuals {
        let (changes, residuals) = (Vec::new(), Residuals::default());
        let mut all = Self { judge, point, significance, changes, residuals };
        let shares = point.rest.iter().enumerate().map(|(i, v)| all.share(i, *v));
        all.residuals.equation = shares.fold(0.0, f64::max);
        judge.rows.conditions(&point.x, point.unit, &mut all);
        all.finished(precision)
    }

    /// The weight of a change of a row.
    fn share(&self, i: usize, v: f64) -> f64 {
        self.significance.get(i).unwrap_or(&1.0) * ratio(v, self.point.terms[i])
    }

    /// `t >= 0`, `y >= 0`, one of them zero.
    pub(super) fn pair(&mut self, t: Entry, y: Entry) {
        for entry in [t, y] {
            if entry.value < 0.0 {
                self.zero(entry);
            }
        }
        if t.value > 0.0 && y.value > 0.0 {
            // The smaller variable is determined by the loads, or by the terms if there are no loads.
            let by_loads = self.burden(t).total_cmp(&self.burden(y));
            let smaller = by_loads.then_with(|| self.effect(t).total_cmp(&self.effect(y)));
            let effect = self.removed(if smaller.is_le() { t } else { y });
            self.residuals.complementarity = self.residuals.complementarity.max(effect);
        }
    }

    /// A tangential force within the bound of Coulomb's law, and the slip that it opposes: the distances of the force to
    /// the two borders, with the slip forwards and backwards.
    pub(super) fn friction(&mut self, bound: f64, force: Entry, slip: Entry) {
        for sign in [1.0, -1.0] {
            let distance = bound.max(0.0) + sign * force.value;
            let slip = Entry { value: (sign * slip.value).max(0.0), ..slip };
            self.pair(Entry { value: distance, ..force }, slip);
        }
    }

    /// A variable that must be zero.
    pub(super) fn zero(&mut self, entry: Entry) {
        if entry.value != 0.0 {
            let effect = self.removed(entry);
            self.residuals.feasibility = self.residuals.feasibility.max(effect);
        }
    }

    /// The effect of a change to zero, which is added to the changes of the rows.
    fn removed(&mut self, Entry { variable, value }: Entry) -> f64 {
        self.changes.resize(self.point.rest.len(), 0.0);
        let changes = &mut self.changes;
        self.judge.rows.for_each_entry(variable, |i, v| changes[i] += (v * value).abs());
        self.effect(Entry { variable, value })
    }

    /// The largest share of a variable in the terms of a row; one for a variable without rows.
    fn effect(&self, entry: Entry) -> f64 {
        self.largest(entry, |i, v| self.share(i, v)).unwrap_or(1.0)
    }

    /// The largest term of a variable in units of the loads; infinite for a variable without rows.
    fn burden(&self, entry: Entry) -> f64 {
        let burden = |i, v: f64| v.abs() * self.judge.weight(self.point.unit, i);
        self.largest(entry, burden).unwrap_or(f64::INFINITY)
    }

    /// The largest share of the terms of a variable in its rows.
    fn largest(
        &self,
        Entry { variable, value }: Entry,
        part: impl Fn(usize, f64) -> f64,
    ) -> Option<f64> {
        let mut largest: Option<f64> = None;
        self.judge.rows.for_each_entry(variable, |i, v| {
            if v != 0.0 {
                let part = part(i, v * value);
                largest = Some(largest.map_or(part, |largest| largest.max(part)));
            }
        });
        largest
    }

    fn finished(self, precision: Precision) -> Residuals {
        let Self { judge, point, changes, mut residuals, .. } = self;
        let (noise, most) = match precision {
            Precision::Quick => (judge.noise(), f64::INFINITY),
            Precision::Rounded => (ROUNDING, MILLIONTH),
            Precision::Exact => (0.0, 0.0),
        };
        for (i, rest) in point.rest.iter().enumerate() {
            let weight = judge.weight(point.unit, i);
            let rounding = (noise * point.terms[i] * weight).min(most);
            let left = (rest.abs() * weight - rounding).max(0.0);
            let left = left + changes.get(i).unwrap_or(&0.0) * weight;
            // A NaN counts as an infinite residual.
            residuals.loads = if left.is_nan() { f64::INFINITY } else { residuals.loads.max(left) };
        }
        residuals.natural = residuals.feasibility.max(residuals.complementarity);
        residuals
    }
}

/// A value relative to the terms of a row. Terms beyond the range of numbers give no information, so that the ratio
/// must not become small.
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
