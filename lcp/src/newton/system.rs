//! The points that belong to free sets.

use super::factors::FreeFactors;
use crate::certify::{Couplings, ratio};
use crate::random::SplitMix;
use crate::vector::{HALF_DIGITS, REFINEMENTS, ROUNDING, SMALL, max_abs};
use crate::{Lcp, Matrix, Residuals};

/// A complementary point: `z` is free for some pairs, `w` for the others.
#[derive(Debug, Clone, Default)]
pub(crate) struct FreePoint {
    pub(crate) is_free: Vec<bool>,
    pub(crate) z: Vec<f64>,
    pub(crate) w: Vec<f64>,
    /// The sums of the sizes of the terms of `M z + q`.
    pub(super) sizes: Vec<f64>,
    /// Pairs with a negative variable, in ascending order.
    pub(crate) violated: Vec<usize>,
    /// The most negative variable, in units of the largest of its vector.
    pub(crate) residual: f64,
    /// The hash of the free set.
    pub(super) hash: u64,
}

/// Whether no entry off the diagonal is positive.
pub(crate) fn is_z_matrix(m: &Matrix) -> bool {
    (0..m.ncols()).all(|j| m.column(j).all(|(i, v)| i == j || v <= 0.0))
}

/// A factorisation for the free sets of problems of one matrix.
pub(crate) struct System {
    pub(super) is_z_matrix: bool,
    diagonal: Vec<f64>,
    factors: FreeFactors,
}

impl System {
    pub(crate) fn new(m: &Matrix) -> Self {
        let diagonal = (0..m.ncols()).map(|i| m[(i, i)]).collect();
        Self { is_z_matrix: is_z_matrix(m), diagonal, factors: FreeFactors::new(m) }
    }

    /// Number of factorisations so far.
    pub(crate) fn factorisations(&self) -> usize {
        self.factors.count
    }

    /// The point after the exchange of the first `count` pairs with a negative variable.
    pub(super) fn exchanged(
        &mut self,
        lcp: &Lcp,
        point: &FreePoint,
        count: usize,
    ) -> Option<FreePoint> {
        let mut next = point.clone();
        next.exchange(count);
        self.solve(lcp, &mut next).then_some(next)
    }

    /// The point without the free variables that may be zero. If both variables of a pair vanish, `z` is only noise,
    /// which leaves a residual in rows with nothing larger. `None` if there are no such variables.
    pub(super) fn without_noise(&mut self, lcp: &Lcp, point: &FreePoint) -> Option<FreePoint> {
        let roots = self.diagonal.iter().zip(&point.z).map(|(d, z)| d.sqrt() * z.abs());
        let size: Vec<f64> = roots.collect();
        let noise = SMALL * max_abs(&size);
        let pairs = point.is_free.iter().zip(&size);
        let is_kept: Vec<bool> = pairs.map(|(is_free, size)| *is_free && *size > noise).collect();
        if is_kept == point.is_free { None } else { self.point(lcp, is_kept) }
    }

    /// The point of a free set; `None` if its matrix is singular to working precision.
    pub(super) fn point(&mut self, lcp: &Lcp, is_free: Vec<bool>) -> Option<FreePoint> {
        let mut point = FreePoint::of(is_free);
        self.solve(lcp, &mut point).then_some(point)
    }

    /// Computes the point of its free set, `M_FF z_F = -q_F`; `false` if the equations cannot be solved.
    pub(crate) fn solve(&mut self, lcp: &Lcp, point: &mut FreePoint) -> bool {
        point.z.clear();
        point.z.resize(point.is_free.len(), 0.0);
        point.multiply(lcp);
        if point.is_free.contains(&true) {
            if !self.factors.factorise(lcp.m(), &point.is_free) {
                return false;
            }
            let mut last = f64::INFINITY;
            for _ in 0..=REFINEMENTS {
                self.factors.subtract(&point.w, &mut point.z);
                point.multiply(lcp);
                let error = point.error();
                if error > 0.5 * last || error <= f64::EPSILON {
                    break;
                }
                last = error;
            }
            if point.error() > HALF_DIGITS || point.is_in_kernel(lcp.q()) {
                return false;
            }
        }
        point.judge(&self.diagonal);
        true
    }
}

impl FreePoint {
    /// A point of a free set, before its equations are solved.
    pub(crate) fn of(is_free: Vec<bool>) -> Self {
        Self { is_free, ..Self::default() }
    }

    /// Exchanges the first `count` pairs with a negative variable.
    pub(crate) fn exchange(&mut self, count: usize) {
        let Self { is_free, violated, .. } = self;
        violated.iter().take(count).for_each(|&i| is_free[i] = !is_free[i]);
    }

    /// `w = M z + q`, with the sums of the sizes of its terms.
    fn multiply(&mut self, lcp: &Lcp) {
        let Self { z, w, sizes, .. } = self;
        w.clear();
        w.extend_from_slice(lcp.q());
        sizes.clear();
        sizes.extend(lcp.q().iter().map(|q| q.abs()));
        for (j, &z) in z.iter().enumerate().filter(|(_, z)| **z != 0.0) {
            lcp.m().slice(j).add_with_sizes(z, w, sizes);
        }
    }

    /// The largest `|w_i|` of a free pair, relative to its terms; not finite if a `w` is not.
    fn error(&self) -> f64 {
        let mut worst = 0.0_f64;
        for ((w, size), is_free) in self.w.iter().zip(&self.sizes).zip(&self.is_free) {
            if !w.is_finite() || !size.is_finite() {
                return f64::INFINITY;
            }
            if *is_free && *size > 0.0 {
                worst = worst.max(w.abs() / size);
            }
        }
        worst
    }

    /// Whether `q` has no share in the equations of a solution: the solution is then in the kernel of `M_FF`, in which
    /// a factorisation does not always find a vanishing pivot.
    fn is_in_kernel(&self, q: &[f64]) -> bool {
        let rows = q.iter().zip(&self.sizes).zip(&self.is_free).filter(|(_, is_free)| **is_free);
        let mut rows = rows.map(|((q, size), _)| (q.abs(), *size));
        rows.clone().any(|(q, _)| q != 0.0) && rows.all(|(q, size)| q <= SMALL * size)
    }

    /// Finds the negative variables; those that may be rounding errors become zero.
    fn judge(&mut self, diagonal: &[f64]) {
        let Self { is_free, z, w, sizes, violated, hash, .. } = self;
        violated.clear();
        *hash = 0;
        for i in 0..z.len() {
            let value = if is_free[i] {
                *hash ^= SplitMix::new(i as u64).next_u64();
                w[i] = 0.0;
                // A row without a diagonal entry shows no rounding error of its `z`.
                z[i] * if diagonal[i] == 0.0 { f64::INFINITY } else { diagonal[i].abs() }
            } else {
                w[i]
            };
            if value < -ROUNDING * sizes[i] {
                violated.push(i);
            } else if value < 0.0 {
                (z[i], w[i]) = (0.0, 0.0);
            }
        }
        let (z_max, w_max) = (max_abs(z), max_abs(w));
        self.residual = violated.iter().fold(0.0_f64, |worst, &i| {
            worst.max(if is_free[i] { -z[i] / z_max } else { -w[i] / w_max })
        });
    }

    /// Bounds of the residuals if no variable is negative: the residuals of all rows, plus the largest parts of them
    /// that rounding may hide in sums of products. `image` is memory.
    pub(crate) fn residuals(
        &self,
        lcp: &Lcp,
        couplings: &Couplings,
        image: &mut Self,
    ) -> Residuals {
        image.z.clone_from(&self.z);
        image.multiply(lcp);
        let Self { z: felt, w: image, sizes, .. } = image;
        let noise = (lcp.order() + 2) as f64 * f64::EPSILON;
        if self.z.iter().chain(&self.w).any(|v| v.is_nan() || *v < 0.0) {
            return Residuals::infinite();
        }
        let mut residuals = Residuals::default();
        couplings.weigh(lcp.q().iter().map(|q| q.abs()), felt, |i, weight| {
            let (rest, terms) = (image[i] - self.w[i], sizes[i] + self.w[i]);
            let hidden = noise * terms;
            residuals.equation = residuals.equation.max(ratio(rest, terms) + noise);
            residuals.loads = residuals.loads.max((rest.abs() + hidden) * weight);
        });
        residuals
    }
}
