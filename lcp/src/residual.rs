//! The one measure of a point, used by every method before it says solved.

use crate::problem::max_abs;
use crate::{HorizontalLcp, Side};

/// The one measure of a point `(t, y)`: dimensionless, from the original data.
///
/// See [`HorizontalLcp::residuals`] for the definitions.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Residuals {
    /// Largest row-wise relative residual of `A t + B y = c`.
    #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinity"))]
    pub equation: f64,
    /// Most negative component of `t` and of `y`, each relative to the largest of its vector.
    #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinity"))]
    pub feasibility: f64,
    /// Largest `min(t_i / max t, y_i / max y)` over the pairs.
    #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinity"))]
    pub complementarity: f64,
    /// Largest `|min(t_i / max t, y_i / max y)|`: feasibility and complementarity in one number.
    #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinity"))]
    pub natural: f64,
}

impl Residuals {
    /// The largest of the residuals.
    pub fn worst(&self) -> f64 {
        self.equation.max(self.feasibility).max(self.complementarity)
    }

    /// Of a point that is not a number.
    pub(crate) fn infinite() -> Self {
        let inf = f64::INFINITY;
        Self { equation: inf, feasibility: inf, complementarity: inf, natural: inf }
    }
}

impl HorizontalLcp {
    /// Residuals of a point, dimensionless, from the original data.
    ///
    /// * equation: `|A t + B y - c|_i / (|A||t| + |B||y| + |c|)_i`, the largest over the rows.
    ///   A row whose terms are all at the rounding level of the point would divide noise by noise,
    ///   so the denominator is at least 2^-10 of the largest term that the row could have,
    ///   `max|A_i| max|t|` or `max|B_i| max|y|`.
    /// * feasibility, complementarity and natural: `t` is measured in units of `max t` and `y` in
    ///   units of `max y`.
    ///
    /// A NaN in the point makes the residuals infinite, and so do terms that overflow.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair.
    pub fn residuals(&self, t: &[f64], y: &[f64]) -> Residuals {
        let c: Vec<(f64, f64)> = self.c().iter().map(|c| (*c, c.abs())).collect();
        self.residuals_with(&c, t, y)
    }

    /// The same for another right-hand side, of which every entry comes with the size of its terms.
    pub(crate) fn residuals_with(&self, c: &[(f64, f64)], t: &[f64], y: &[f64]) -> Residuals {
        let n = self.order();
        assert!(t.len() == n && y.len() == n, "a point has one entry for every pair");
        if t.iter().chain(y).any(|v| !v.is_finite()) {
            return Residuals::infinite();
        }
        let (t_max, y_max) = (max_abs(t), max_abs(y));
        let (feasibility, complementarity, natural) = pair_residuals(t, y, t_max, y_max);
        let equation = self.equation_residual(c, (t, t_max), (y, y_max));
        Residuals { equation, feasibility, complementarity, natural }
    }

    /// Each vector with its largest entry.
    fn equation_residual(&self, c: &[(f64, f64)], t: (&[f64], f64), y: (&[f64], f64)) -> f64 {
        const FLOOR: f64 = 1.0 / (1 << 10) as f64;
        let n = self.order();
        let (mut sum, mut size): (Vec<f64>, Vec<f64>) =
            c.iter().map(|(c, size)| (-c, size)).unzip();
        let mut largest = vec![0.0_f64; n];
        for (side, (x, x_max)) in [(Side::T, t), (Side::Y, y)] {
            for (pair, &x) in x.iter().enumerate() {
                self.column(pair, side).for_each(|i, v| {
                    sum[i] += v * x;
                    size[i] += (v * x).abs();
                    largest[i] = largest[i].max(v.abs() * x_max);
                });
            }
        }
        (0..n).fold(0.0, |worst: f64, i| {
            let denominator = size[i].max(FLOOR * largest[i]);
            worst.max(ratio(sum[i], denominator))
        })
    }
}

/// What a row lacks, relative to its terms. Terms beyond the range of numbers say nothing, which is no
/// small residual.
pub(crate) fn ratio(lack: f64, terms: f64) -> f64 {
    if !(lack.is_finite() && terms.is_finite()) {
        f64::INFINITY
    } else if terms > 0.0 {
        lack.abs() / terms
    } else {
        0.0
    }
}

fn pair_residuals(t: &[f64], y: &[f64], t_max: f64, y_max: f64) -> (f64, f64, f64) {
    let relative = |v: f64, max: f64| if max > 0.0 { v / max } else { 0.0 };
    let mut residuals = (0.0_f64, 0.0_f64, 0.0_f64);
    for (&t, &y) in t.iter().zip(y) {
        let (t, y) = (relative(t, t_max), relative(y, y_max));
        let least = t.min(y);
        residuals.0 = residuals.0.max(-least + 0.0);
        residuals.1 = residuals.1.max(least);
        residuals.2 = residuals.2.max(least.abs());
    }
    residuals
}
