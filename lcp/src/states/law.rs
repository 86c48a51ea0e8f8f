//! The nearest state of a contact, and the springs that hold the contact in a state.

use super::condensed::Springs;
use super::points::Point;
use super::scaled::Scaled;
use crate::problem::ContactStatus;

/// The nearest states for any displacements and forces.
pub(crate) fn nearest(problem: &Scaled, u: &[f64], forces: &[(f64, f64)]) -> Vec<ContactStatus> {
    let points = problem.points.iter().zip(forces).map(|(point, &forces)| {
        let gap = point.gap(u, forces.0);
        let slip = if point.mu > 0.0 { point.slip(u, forces.1) } else { 0.0 };
        ContactStatus::nearest(point.mu, forces.into(), gap, [slip.max(0.0), (-slip).max(0.0)])
    });
    points.collect()
}

impl ContactStatus {
    /// The nearest state for normal and tangential force, gap, and slips forwards and backwards.
    pub(crate) fn nearest(
        mu: f64,
        [t_n, t_t]: [f64; 2],
        gap: f64,
        [slip_plus, slip_minus]: [f64; 2],
    ) -> Self {
        if gap > t_n {
            return Self::Open;
        }
        let bound = mu * t_n;
        let (plus, minus) = (slip_plus > bound + t_t, slip_minus > bound - t_t);
        match (mu > 0.0 && plus, mu > 0.0 && minus) {
            (true, _) if slip_plus >= slip_minus => Self::Forwards,
            (_, true) => Self::Backwards,
            (true, false) => Self::Forwards,
            (false, false) => Self::Stick,
        }
    }

    /// Gap and slip of a point with these forces if the state requires them to be zero, else zero.
    pub(crate) fn opened(self, point: Point<'_>, u: &[f64], [t_n, t_t]: [f64; 2]) -> (f64, f64) {
        let [gap, slip] = self.is_closed(point.mu);
        let gap = if gap { point.gap(u, t_n) } else { 0.0 };
        (gap, if slip { point.slip(u, t_t) } else { 0.0 })
    }

    /// Springs of this stiffness, in series with those of the point, against gaps and slips that the state
    /// does not allow.
    pub(crate) fn springs(self, point: Point<'_>, stiffness: f64) -> Springs {
        let Point { mu, .. } = point;
        let [nn, tt] = point.in_series([stiffness, if mu > 0.0 { stiffness } else { 0.0 }]);
        match self {
            Self::Open => Springs::default(),
            Self::Stick => Springs { nn, tn: 0.0, tt },
            Self::Forwards => Springs { nn, tn: -mu * nn, tt: 0.0 },
            Self::Backwards => Springs { nn, tn: mu * nn, tt: 0.0 },
        }
    }
}
