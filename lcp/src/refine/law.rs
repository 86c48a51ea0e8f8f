//! The margin of the inequalities of the contact law.

use super::point::ExtendedPoint;
use crate::extended::Extended;
use crate::problem::ContactStatus;
use crate::states::Scaled;

/// The margin by which the inequalities of the contact law hold, at the contact that is nearest to a violation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Margin {
    /// The least margin of all: of gaps of open contacts and slips of sliding ones, in units of the largest
    /// displacement; of normal forces of closed contacts and the distance of friction from its bound at sticking
    /// ones, in units of the largest force. Negative if an inequality is violated; infinite without contacts.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
    pub least: f64,
    /// The contact; `None` without contacts.
    pub contact: Option<usize>,
}

impl Margin {
    pub(super) fn of(slacks: impl Iterator<Item = (f64, ContactStatus)>) -> Self {
        let none = Self { least: f64::INFINITY, contact: None };
        slacks.enumerate().fold(none, |margin, (i, (least, _))| {
            if least < margin.least { Self { least, contact: Some(i) } } else { margin }
        })
    }
}

/// The slack of the inequalities of every contact, and the status that replaces the present one if the slack is
/// negative.
pub(super) fn slacks(
    scaled: &Scaled,
    statuses: &[ContactStatus],
    at: &ExtendedPoint,
) -> impl Iterator<Item = (f64, ContactStatus)> {
    use ContactStatus::{Backwards, Forwards, Open, Stick};
    let (force, length) = at.sizes(scaled);
    let part = |v: Extended, unit: f64| if unit > 0.0 { v.rounded() / unit } else { 0.0 };
    let points = scaled.points.iter().zip(statuses).zip(&at.forces);
    points.map(move |((point, status), [t_n, t_t])| {
        let pressed = (part(*t_n, force), Open);
        let slip = || part(at.slip(point, *t_t), length);
        let other = match status {
            Open => return (part(at.gap(point, *t_n), length), Stick),
            _ if point.mu == 0.0 => return pressed,
            Stick => {
                let next = if *t_t < Extended::ZERO { Forwards } else { Backwards };
                (part(*t_n * point.mu - t_t.abs(), force), next)
            }
            Forwards => (slip(), Stick),
            Backwards => (-slip(), Stick),
        };
        // A tensile normal force decides before the friction that follows from it.
        if pressed.0 < 0.0 || pressed.0 < other.0 { pressed } else { other }
    })
}
