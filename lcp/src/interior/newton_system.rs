//! Newton's equations at an interior point of the cone.

use super::iterate::Iterate;
use crate::states::{Condensed, PROXIMAL, Scaled, Springs};
use crate::vector::max_abs;

/// The residuals of the equations at a point.
pub(super) struct Defect {
    /// `f + C^T t - K u`.
    balance: Vec<f64>,
    /// `C_n u + x_0 + a_n t_n - g` and `C_t u + s_0 + a_t t_t - (s+ - s-)`.
    gaps: Vec<(f64, f64)>,
}

impl Defect {
    pub(super) fn of(problem: &Scaled, at: &Iterate) -> Self {
        let forces = at.points.iter().map(|pairs| (pairs.t_n, pairs.t_t));
        let balance = problem.unbalanced(&at.u, forces);
        let gaps = problem.points.iter().zip(&at.points).map(|(point, pairs)| {
            let slip = if point.mu > 0.0 {
                point.slip(&at.u, pairs.t_t) - (pairs.slip_plus - pairs.slip_minus)
            } else {
                0.0
            };
            (point.gap(&at.u, pairs.t_n) - pairs.gap, slip)
        });
        Self { balance, gaps: gaps.collect() }
    }

    /// The largest defect in these units of force and length.
    pub(super) fn relative(&self, force: f64, length: f64) -> f64 {
        let gaps = self.gaps.iter().fold(0.0_f64, |max, (g, s)| max.max(g.abs()).max(s.abs()));
        (max_abs(&self.balance) / force).max(gaps / length)
    }
}

/// The matrix of Newton's equations at a point, factorised.
pub(super) struct NewtonSystem<'a> {
    problem: &'a Scaled,
    condensed: &'a Condensed,
    at: &'a Iterate,
    springs: Vec<Springs>,
}

impl<'a> NewtonSystem<'a> {
    pub(super) fn new(problem: &'a Scaled, condensed: &'a mut Condensed, at: &'a Iterate) -> Self {
        let points = problem.points.iter().zip(&at.points);
        let springs = points.map(|(point, pairs)| pairs.springs(point.compliance));
        let springs: Vec<Springs> = springs.collect();
        condensed.factorise(problem, &springs, PROXIMAL);
        Self { problem, condensed, at, springs }
    }

    /// Whether the determinant is negative, so that `tau` grows on the way forwards along the central path: see
    /// [`turn`](super::turn::turn).
    pub(super) fn is_backwards(&self) -> bool {
        self.condensed.is_negative()
    }

    /// The step that changes the products of the pairs by `targets`, to first order, and nothing else.
    pub(super) fn correction(&self, targets: &[[f64; 3]]) -> Iterate {
        let balance = vec![0.0; self.problem.order()];
        self.step(&Defect { balance, gaps: vec![(0.0, 0.0); targets.len()] }, targets)
    }

    /// The step that removes the defect and changes the products of the pairs by `targets`, to first order:
    /// `y dt + t dy = target`.
    pub(super) fn step(&self, defect: &Defect, targets: &[[f64; 3]]) -> Iterate {
        let points = self.problem.points.iter().zip(&self.at.points).zip(targets).zip(&defect.gaps);
        let opened = points.clone().map(|(((point, at), targets), gaps)| {
            let slip = if point.mu > 0.0 {
                let (plus, minus) = at.reserves();
                gaps.1 - (targets[1] / plus - targets[2] / minus)
            } else {
                0.0
            };
            (gaps.0 - targets[0] / at.t_n, slip)
        });
        let balance = defect.balance.clone();
        let (u, forces) = self.condensed.step(self.problem, &self.springs, balance, opened);
        let points = points.zip(forces).map(|((((point, at), targets), gaps), (t_n, t_t))| {
            let moved = point.moved(&u);
            let [normal, tangential] = point.compliance;
            let opened = [moved.0 + gaps.0 + normal * t_n, moved.1 + gaps.1 + tangential * t_t];
            at.change([t_n, t_t], opened, targets)
        });
        let points = points.collect();
        Iterate { u, points }
    }
}
