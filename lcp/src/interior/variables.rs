//! The variables of the homogeneous problem of a convex program, inside their bounds, and their start.

use super::constants::START_SHIFT;
use super::program::{Program, ProgramFactors};
use super::step::longest;
use crate::states::PROXIMAL;

/// The variables inside their bounds, or a step of them.
#[derive(Debug, Clone)]
pub(super) struct Variables {
    pub(super) u: Vec<f64>,
    pub(super) t: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// The pair that distinguishes a solution from a proof that there is none.
    pub(super) tau: f64,
    pub(super) kappa: f64,
}

impl Variables {
    /// A start from the forces that the contacts would carry if they were springs in both directions.
    pub(super) fn start(program: &Program, factors: &mut ProgramFactors) -> Option<Self> {
        let stiffness: Vec<f64> = program.compliance.iter().map(|c| 1.0 / (1.0 + c)).collect();
        factors.factorise(program, stiffness, PROXIMAL)?;
        let stiffness = &factors.stiffness;
        let mut u = program.f.clone();
        let forces = stiffness.iter().zip(&program.x_0).map(|(stiffness, x)| -stiffness * x);
        program.add_forces(&forces.collect::<Vec<f64>>(), &mut u);
        factors.gram.solve(&mut u);
        // The gap is reduced by the compression under the force, which is the force of a spring of stiffness
        // one.
        let mut gaps = program.opened(&u);
        for ((gap, x), stiffness) in gaps.iter_mut().zip(&program.x_0).zip(stiffness) {
            *gap = stiffness * (*gap + x);
        }
        let mean = gaps.iter().map(|g| g.abs()).sum::<f64>() / gaps.len().max(1) as f64;
        // Contacts that pull cannot remain: the larger the pull, the farther the solution.
        let pull = gaps.iter().fold(0.0, |max, gap| gap.max(max));
        let shift = mean.max(START_SHIFT * pull);
        let shift = if shift > 0.0 && shift.is_finite() { shift } else { 1.0 };
        let t: Vec<f64> = gaps.iter().map(|gap| (-gap).max(0.0) + shift).collect();
        let y: Vec<f64> = gaps.iter().map(|gap| gap.max(0.0) + shift).collect();
        let kappa = dot(&t, &y) / t.len().max(1) as f64;
        Some(Self { u, t, y, tau: 1.0, kappa })
    }

    pub(super) fn zero(program: &Program) -> Self {
        let pairs = vec![0.0; program.x_0.len()];
        Self { u: vec![0.0; program.f.len()], t: pairs.clone(), y: pairs, tau: 0.0, kappa: 0.0 }
    }

    /// The mean of the products of all pairs.
    pub(super) fn mean_product(&self) -> f64 {
        (dot(&self.t, &self.y) + self.tau * self.kappa) / (self.t.len() + 1) as f64
    }

    pub(super) fn moved(&self, step: &Self, alpha: f64) -> Self {
        let of = |v: f64, step: f64| v + alpha * step;
        let with = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| of(*a, *b)).collect();
        Self {
            u: with(&self.u, &step.u),
            t: with(&self.t, &step.t),
            y: with(&self.y, &step.y),
            tau: of(self.tau, step.tau),
            kappa: of(self.kappa, step.kappa),
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        let sums = [&self.u, &self.t, &self.y].map(|v| v.iter().sum::<f64>());
        (sums.iter().sum::<f64>() + self.tau + self.kappa).is_finite()
    }

    /// The largest step, at most one, that leaves all bounded variables positive.
    pub(super) fn longest(&self, step: &Self) -> f64 {
        let pairs = self.t.iter().zip(&step.t).chain(self.y.iter().zip(&step.y));
        let pairs = pairs.chain([(&self.tau, &step.tau), (&self.kappa, &step.kappa)]);
        longest(pairs.map(|(v, change)| (*v, *change)))
    }

    /// The solution near the point, if there is one.
    pub(super) fn solution(mut self) -> Self {
        let by = 1.0 / self.tau.max(f64::MIN_POSITIVE);
        let Self { u, t, y, .. } = &mut self;
        u.iter_mut().chain(t).chain(y).for_each(|v| *v *= by);
        (self.tau, self.kappa) = (1.0, by * self.kappa);
        self
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
