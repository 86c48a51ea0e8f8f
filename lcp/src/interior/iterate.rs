//! Interior points of the cone.

use super::step::longest;
use crate::problem::ContactStatus;
use crate::solve::StepKind;
use crate::states::Springs;
use crate::vector::HALF_DIGITS;

/// A point with all forces inside their cones and all gaps open; or a step between two of them.
#[derive(Debug, Clone)]
pub(super) struct Iterate {
    pub(super) u: Vec<f64>,
    pub(super) points: Vec<Pairs>,
}

/// A step, the largest part of it that stays in the interior, and its kind.
pub(super) struct Direction {
    pub(super) step: Iterate,
    pub(super) alpha: f64,
    pub(super) kind: StepKind,
}

/// The variables of a contact point; the variables of friction are zero without friction.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pairs {
    /// The coefficient of friction, which belongs to the point.
    pub(super) mu: f64,
    pub(super) t_n: f64,
    pub(super) t_t: f64,
    pub(super) gap: f64,
    pub(super) slip_plus: f64,
    pub(super) slip_minus: f64,
}

impl Pairs {
    /// `(t, y)` of the pairs: one without friction, else three.
    pub(super) fn pairs(self) -> impl Iterator<Item = (f64, f64)> {
        let (plus, minus) = self.reserves();
        let all = [(self.t_n, self.gap), (plus, self.slip_plus), (minus, self.slip_minus)];
        all.into_iter().take(if self.mu > 0.0 { 3 } else { 1 })
    }

    fn plus(&self, step: &Self, alpha: f64) -> Self {
        Self {
            mu: self.mu,
            t_n: self.t_n + alpha * step.t_n,
            t_t: self.t_t + alpha * step.t_t,
            gap: self.gap + alpha * step.gap,
            slip_plus: self.slip_plus + alpha * step.slip_plus,
            slip_minus: self.slip_minus + alpha * step.slip_minus,
        }
    }

    /// `mu t_n + t_t` and `mu t_n - t_t`.
    pub(super) fn reserves(&self) -> (f64, f64) {
        (self.mu * self.t_n + self.t_t, self.mu * self.t_n - self.t_t)
    }

    /// Slips to either side, each relative to the remaining reserve of the friction that resists it.
    fn ratios(&self) -> (f64, f64) {
        let (plus, minus) = self.reserves();
        (self.slip_plus / plus, self.slip_minus / minus)
    }

    /// The springs by which Newton's method replaces the contact, with a proximal term of half the digits, which does
    /// not change the limit of the iteration.
    pub(super) fn springs(&self, compliance: [f64; 2]) -> Springs {
        let nn = 1.0 / (self.gap / self.t_n + compliance[0] + HALF_DIGITS);
        if self.mu == 0.0 {
            return Springs { nn, ..Springs::default() };
        }
        let (plus, minus) = self.ratios();
        let tt = 1.0 / (plus + minus + compliance[1] + HALF_DIGITS);
        Springs { nn, tn: -self.mu * (plus - minus) * tt * nn, tt }
    }

    /// The step of all variables from the step of the forces and the changes of gap and slip by the displacements. Each
    /// pair uses the one of the two equations for `dy`, compatibility and `y dt + t dy = target`, that keeps the
    /// digits: the second if `t` is the larger one.
    pub(super) fn change(&self, [t_n, t_t]: [f64; 2], opened: [f64; 2], target: &[f64; 3]) -> Self {
        let mu = self.mu;
        let gap =
            if self.t_n > self.gap { (target[0] - self.gap * t_n) / self.t_n } else { opened[0] };
        if mu == 0.0 {
            return Self { t_n, gap, ..Self::default() };
        }
        let (plus, minus) = self.reserves();
        let slip_plus = (target[1] - self.slip_plus * (mu * t_n + t_t)) / plus;
        let slip_minus = (target[2] - self.slip_minus * (mu * t_n - t_t)) / minus;
        let (slip_plus, slip_minus) = match self.ratios() {
            (plus, minus) if plus.max(minus) < 1.0 => (slip_plus, slip_minus),
            (plus, minus) if plus > minus => (slip_minus + opened[1], slip_minus),
            _ => (slip_plus, slip_plus - opened[1]),
        };
        Self { mu, t_n, t_t, gap, slip_plus, slip_minus }
    }
}

impl Iterate {
    /// Normal and tangential forces.
    pub(super) fn forces(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|pairs| (pairs.t_n, pairs.t_t)).collect()
    }

    /// The nearest states of the contacts.
    pub(super) fn contacts(&self) -> Vec<ContactStatus> {
        let contact = |at: &Pairs| {
            let Pairs { mu, t_n, t_t, gap, slip_plus, slip_minus } = *at;
            ContactStatus::nearest(mu, [t_n, t_t], gap, [slip_plus, slip_minus])
        };
        self.points.iter().map(contact).collect()
    }

    /// `(t, y)` of all pairs.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        self.points.iter().flat_map(|pairs| pairs.pairs())
    }

    /// The mean of the products of the pairs.
    pub(super) fn mean_product(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0_usize);
        for (t, y) in self.pairs() {
            (sum, count) = (sum + t * y, count + 1);
        }
        sum / count.max(1) as f64
    }

    /// The smallest product of a pair, relative to the mean.
    pub(super) fn centrality(&self) -> f64 {
        let mean = self.mean_product();
        self.pairs().map(|(t, y)| t * y / mean).fold(f64::INFINITY, f64::min)
    }

    /// Largest `|min(t, y)|` over the pairs, in these units of force and length.
    pub(super) fn natural(&self, force: f64, length: f64) -> f64 {
        self.pairs().fold(0.0, |max, (t, y)| max.max((t / force).min(y / length).abs()))
    }

    pub(super) fn is_finite(&self) -> bool {
        let sum: f64 = self.u.iter().sum();
        let forces: f64 = self.points.iter().map(|pairs| pairs.t_n + pairs.t_t).sum();
        (sum + forces).is_finite()
    }

    /// The largest step, at most one, that leaves all pairs positive.
    pub(super) fn longest(&self, step: &Self) -> f64 {
        let both = self.pairs().zip(step.pairs());
        longest(both.flat_map(|((t, y), (dt, dy))| [(t, dt), (y, dy)]))
    }

    /// The largest normal force, and the largest gap or slip.
    pub(super) fn sizes(&self) -> (f64, f64) {
        self.points.iter().fold((0.0, 0.0), |(force, length): (f64, f64), pairs| {
            let largest = pairs.gap.max(pairs.slip_plus).max(pairs.slip_minus);
            (force.max(pairs.t_n), length.max(largest))
        })
    }

    pub(super) fn largest_gap(&self) -> f64 {
        self.points.iter().fold(0.0, |max, pairs| max.max(pairs.gap.abs()))
    }

    pub(super) fn mean_gap(&self) -> f64 {
        self.points.iter().map(|pairs| pairs.gap).sum::<f64>() / self.points.len().max(1) as f64
    }

    /// Opens all gaps and slips further by this length.
    pub(super) fn opened(mut self, by: f64) -> Self {
        for pairs in &mut self.points {
            pairs.gap += by;
            if pairs.mu > 0.0 {
                pairs.slip_plus += by;
                pairs.slip_minus += by;
            }
        }
        self
    }

    pub(super) fn moved(&self, step: &Self, alpha: f64) -> Self {
        let u = self.u.iter().zip(&step.u).map(|(u, du)| u + alpha * du).collect();
        let points = self.points.iter().zip(&step.points);
        Self { u, points: points.map(|(pairs, step)| pairs.plus(step, alpha)).collect() }
    }

    /// `(1 - share) self + share other`.
    pub(super) fn mixed(&self, other: &Self, share: f64) -> Self {
        let u = self.u.iter().zip(&other.u).map(|(a, b)| (1.0 - share) * a + share * b).collect();
        let mixed = |(a, b): (&Pairs, &Pairs)| {
            Pairs { mu: a.mu, ..Pairs::default() }.plus(a, 1.0 - share).plus(b, share)
        };
        Self { u, points: self.points.iter().zip(&other.points).map(mixed).collect() }
    }
}
