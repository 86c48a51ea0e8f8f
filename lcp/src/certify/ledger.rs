//! Rows at a point: what is left of each, the sizes of its terms, and what violated conditions add.

use super::Residuals;
use crate::extended::Extended;

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

/// How exactly the rows of a point are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Precision {
    /// In `f64`, less the rounding errors that this may have: of points on the way.
    Quick,
    /// With twice the digits where that may matter: of answers.
    Exact,
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

    pub(super) fn add(&mut self, row: usize, v: f64, x: X) {
        X::add_product(&mut self.rest[row], v, x);
        self.terms[row] += (v * x.rounded()).abs();
    }
}

/// Terms smaller than this part of the loads are measured by that: in a row that vanishes at the solution all terms are
/// errors of an iteration, or of rounding.
const FLOOR: f64 = 1.0 / (1 << 10) as f64;

/// The residuals of a point while its conditions are gone through.
pub(super) struct Ledger<'a> {
    /// What is left of every row.
    rest: Vec<f64>,
    terms: Vec<f64>,
    /// One over the loads.
    weights: &'a [f64],
    /// What the changes that make the point feasible and complementary add to it; empty where there are none.
    changes: Vec<f64>,
    residuals: Residuals,
}

/// A variable of a pair: its value, and the coefficients that it has in the rows.
pub(super) struct Entry<'a> {
    pub(super) value: f64,
    pub(super) column: &'a dyn Fn(&mut dyn FnMut(usize, f64)),
}

impl<'a> Ledger<'a> {
    /// `weights` are one over the loads.
    pub(super) fn new<X: Digits>(rows: Rows<X>, weights: &'a [f64]) -> Self {
        let Rows { rest, terms } = rows;
        let rest = rest.into_iter().map(Digits::rounded).collect();
        let mut ledger =
            Self { rest, terms, weights, changes: Vec::new(), residuals: Residuals::default() };
        ledger.residuals.equation = (0..ledger.rest.len())
            .fold(0.0, |worst: f64, i| worst.max(ratio(ledger.rest[i], ledger.size(i))));
        ledger
    }

    /// What a row is measured by.
    fn size(&self, i: usize) -> f64 {
        let floor = if self.weights[i] > 0.0 { FLOOR / self.weights[i] } else { 0.0 };
        self.terms[i].max(floor)
    }

    /// `t >= 0`, `y >= 0`, one of them zero.
    pub(super) fn pair(&mut self, t: &Entry<'_>, y: &Entry<'_>) {
        for entry in [t, y] {
            if entry.value < 0.0 {
                let effect = self.effect(entry);
                self.residuals.feasibility = self.residuals.feasibility.max(effect);
                self.change(entry);
            }
        }
        if t.value > 0.0 && y.value > 0.0 {
            let (of_t, of_y) = (self.effect(t), self.effect(y));
            let least = of_t.min(of_y);
            self.residuals.complementarity = self.residuals.complementarity.max(least);
            self.change(if of_t <= of_y { t } else { y });
        }
    }

    /// A variable that must be zero.
    pub(super) fn zero(&mut self, entry: &Entry<'_>) {
        if entry.value != 0.0 {
            let effect = self.effect(entry);
            self.residuals.feasibility = self.residuals.feasibility.max(effect);
            self.change(entry);
        }
    }

    /// The largest part of the terms of a row that a variable is. One without any row counts by itself.
    fn effect(&self, entry: &Entry<'_>) -> f64 {
        let mut effect: Option<f64> = None;
        (entry.column)(&mut |i, v| {
            if v != 0.0 {
                let part = ratio(v * entry.value, self.size(i));
                effect = Some(effect.map_or(part, |effect| effect.max(part)));
            }
        });
        effect.unwrap_or(1.0)
    }

    fn change(&mut self, entry: &Entry<'_>) {
        if self.changes.is_empty() {
            self.changes = vec![0.0; self.rest.len()];
        }
        (entry.column)(&mut |i, v| self.changes[i] += (v * entry.value).abs());
    }

    /// Whether rounding errors of the terms are not small against the loads.
    pub(super) fn is_hidden(&self, length: f64) -> bool {
        const SMALL: f64 = 1e-13;
        let mut rows = self.terms.iter().zip(self.weights);
        rows.any(|(terms, weight)| length * f64::EPSILON * terms * weight > SMALL)
    }

    /// The residuals. In rows of up to so many terms that were
    /// summed in `f64` rounding errors are left out.
    pub(super) fn finish(self, length: f64, precision: Precision) -> Residuals {
        let Self { rest, terms, weights, changes, mut residuals } = self;
        let noise = match precision {
            Precision::Quick => length * f64::EPSILON,
            Precision::Exact => 0.0,
        };
        for (i, (rest, weight)) in rest.iter().zip(weights).enumerate() {
            let left = (rest.abs() - noise * terms[i]).max(0.0);
            let left = (left + changes.get(i).unwrap_or(&0.0)) * weight;
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
