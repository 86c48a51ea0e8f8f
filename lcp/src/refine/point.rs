//! Displacements and forces during their refinement.

use crate::ContactState;
use crate::extended::{Extended, extended};
use crate::problem::ContactStatus;
use crate::states::{Point, Scaled};
use crate::vector::{SMALL, max_abs};

/// Displacements and forces in the units of the scaled problem.
#[derive(Debug, Clone)]
pub(super) struct ExtendedPoint {
    pub(super) u: Vec<Extended>,
    pub(super) forces: Vec<[Extended; 2]>,
}

impl ExtendedPoint {
    pub(super) fn from(scaled: &Scaled, state: &ContactState) -> Self {
        let (u, mut forces) = scaled.of_state(state);
        let smooth = forces.iter_mut().zip(&scaled.points.mu).filter(|(_, mu)| **mu <= 0.0);
        smooth.for_each(|((_, t_t), _)| *t_t = 0.0);
        Self::of(&u, &forces)
    }

    pub(super) fn of(u: &[f64], forces: &[(f64, f64)]) -> Self {
        let forces = forces.iter().map(|(n, t)| [*n, *t].map(Extended::from));
        Self { u: extended(u), forces: forces.collect() }
    }

    /// Displacements, and pairs of forces, rounded to `f64`.
    pub(super) fn rounded(&self) -> (Vec<f64>, Vec<(f64, f64)>) {
        let forces = self.forces.iter().map(|[n, t]| (n.rounded(), t.rounded()));
        (self.u.iter().map(|u| u.rounded()).collect(), forces.collect())
    }

    /// The displacements in the units of the original problem, by factors that are powers of two.
    pub(super) fn displacements(&self, scaled: &Scaled) -> Vec<Extended> {
        let [high, low] = [Extended::rounded, Extended::rest]
            .map(|part| scaled.displacements(&self.u.iter().map(|u| part(*u)).collect::<Vec<_>>()));
        high.into_iter().zip(low).map(|(high, low)| Extended::from(high) + low.into()).collect()
    }

    /// Gap of a point with this normal force.
    pub(super) fn gap(&self, point: Point<'_>, t_n: Extended) -> Extended {
        self.row(point, point.x_0, 0) + t_n * point.compliance[0]
    }

    /// Slip of a point with this tangential force.
    pub(super) fn slip(&self, point: Point<'_>, t_t: Extended) -> Extended {
        self.row(point, point.s_0, 1) + t_t * point.compliance[1]
    }

    fn row(&self, point: Point<'_>, first: f64, k: usize) -> Extended {
        let terms = point.columns.iter().zip(point.coefficients).map(|(&j, v)| self.u[j] * v[k]);
        terms.fold(Extended::from(first), |sum, term| sum + term)
    }

    /// The largest force, of contacts or loads, and the largest displacement or gap.
    pub(super) fn sizes(&self, scaled: &Scaled) -> (f64, f64) {
        let (u, forces) = self.rounded();
        let force =
            forces.iter().fold(max_abs(&scaled.f), |max, (n, t)| max.max(n.abs().max(t.abs())));
        let gaps =
            scaled.points.x_0.iter().zip(&scaled.points.s_0).map(|(x, s)| x.abs().max(s.abs()));
        // The unit of stiffness is one.
        (force, gaps.fold(max_abs(&u).max(force), f64::max))
    }

    pub(super) fn nearest(&self, scaled: &Scaled) -> Vec<ContactStatus> {
        let (u, forces) = self.rounded();
        let (force, length) = self.sizes(scaled);
        let part = |v: f64, unit: f64| if unit > 0.0 { v / unit } else { 0.0 };
        let of_point = |(point, (t_n, t_t)): (Point<'_>, (f64, f64))| {
            let (gap, slip) = (point.gap(&u, t_n), point.slip(&u, t_t));
            let (gap, slip) = (part(gap, length), part(slip, length));
            let margin = part(point.mu * t_n - t_t.abs(), force);
            if gap > part(t_n, force).max(SMALL) {
                ContactStatus::Open
            } else if point.mu > 0.0 && slip.abs() > margin.max(SMALL) {
                if slip > 0.0 { ContactStatus::Forwards } else { ContactStatus::Backwards }
            } else {
                ContactStatus::Stick
            }
        };
        scaled.points.iter().zip(forces).map(of_point).collect()
    }
}
