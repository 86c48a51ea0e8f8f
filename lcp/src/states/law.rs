//! The state that a contact is nearest to, and the springs that hold it there.

use super::condensed::Springs;
use super::scaled::{Point, Scaled};
use crate::problem::ContactStatus;

/// The states that displacements and forces are nearest to, wherever they are.
pub(crate) fn nearest(problem: &Scaled, u: &[f64], forces: &[(f64, f64)]) -> Vec<ContactStatus> {
    let points = problem.points.iter().zip(forces).map(|(point, &forces)| {
        let slip = if point.mu > 0.0 { point.slip(u) } else { 0.0 };
        ContactStatus::nearest(point, forces, (point.gap(u), slip.max(0.0), (-slip).max(0.0)))
    });
    points.collect()
}

impl ContactStatus {
    /// The state that is nearest to normal and tangential force, gap, and slips forwards and backwards.
    pub(crate) fn nearest(
        point: &Point,
        (t_n, t_t): (f64, f64),
        (gap, slip_plus, slip_minus): (f64, f64, f64),
    ) -> Self {
        if gap > t_n {
            return Self::Open;
        }
        let bound = point.mu * t_n;
        let (plus, minus) = (slip_plus > bound + t_t, slip_minus > bound - t_t);
        match (point.mu > 0.0 && plus, point.mu > 0.0 && minus) {
            (true, _) if slip_plus >= slip_minus => Self::Forwards,
            (_, true) => Self::Backwards,
            (true, false) => Self::Forwards,
            (false, false) => Self::Stick,
        }
    }

    /// Springs of this stiffness against what the state does not allow.
    pub(crate) fn springs(self, point: &Point, stiffness: f64) -> Springs {
        let tangential = if point.mu > 0.0 { stiffness } else { 0.0 };
        match self {
            Self::Open => Springs::default(),
            Self::Stick => Springs { nn: stiffness, tn: 0.0, tt: tangential },
            Self::Forwards => Springs { nn: stiffness, tn: -point.mu * stiffness, tt: 0.0 },
            Self::Backwards => Springs { nn: stiffness, tn: point.mu * stiffness, tt: 0.0 },
        }
    }
}
