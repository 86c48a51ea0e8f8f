//! Events along the path: joints that open and slide.

use serde::Serialize;

use super::Stand;
use super::steps::Rest;
use crate::ids::JointId;
use crate::method::forms::Sparse;
use crate::model::Model;
use crate::state::ContactStatus;
use crate::system::System;

/// Gaps below this part of the largest displacement are closed, and forces nearer to the bound of friction than this part of
/// the largest are at it. Chosen: far above the errors of states, far below what they mean.
const ZERO: f64 = 1e-7;

/// A change of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Change {
    /// One of its points opens: the joint is a hinge.
    Hinges,
    /// All of its points are open.
    Opens,
    /// All of its closed points are at the bound of friction.
    Slides,
}

/// The first time that a joint opens or slides.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// The joint.
    pub joint: JointId,
    /// The change.
    pub change: Change,
    /// The load factor \[-\] of the last state at rest before the change.
    pub after: f64,
    /// The load factor \[-\] of the first state at rest after it.
    pub before: f64,
}

/// Events, and the states between them.
pub(super) fn along(
    model: &Model,
    system: &System,
    sparse: &Sparse,
    rests: &[(f64, Rest)],
) -> (Vec<Event>, Vec<Stand>) {
    let mut events: Vec<Event> = Vec::new();
    let mut curve: Vec<Stand> = Vec::new();
    let mut last: Option<(f64, Vec<Option<Change>>)> = None;
    let at_zero = rests.first().map(|(_, rest)| rest.u.clone()).unwrap_or_default();
    let blocks = sparse.starts().last().copied().unwrap_or(0);
    for (factor, rest) in rests {
        let statuses = statuses(system, sparse, rest);
        let moved = rest.u[..blocks].iter().zip(&at_zero).map(|(u, before)| (u - before).abs());
        let count = |status| statuses.iter().filter(|it| **it == status).count();
        curve.push(Stand {
            load_factor: *factor,
            displacement: moved.fold(0.0, f64::max),
            contacts: [ContactStatus::Open, ContactStatus::Stick, ContactStatus::Slip].map(count),
        });
        let changes: Vec<Option<Change>> =
            (0..model.joints.len()).map(|joint| change(model, joint, &statuses)).collect();
        if let Some((after, before)) = &last {
            for (k, (now, before)) in changes.iter().zip(before).enumerate() {
                let Some(change) = *now else { continue };
                let joint = JointId::new(k);
                let is_known = Some(change) == *before
                    || events.iter().any(|it| it.joint == joint && it.change == change);
                if !is_known {
                    events.push(Event { joint, change, after: *after, before: *factor });
                }
            }
        }
        last = Some((*factor, changes));
    }
    (events, curve)
}

fn change(model: &Model, joint: usize, statuses: &[ContactStatus]) -> Option<Change> {
    let of_joint = model.contacts.iter().zip(statuses);
    let of_joint = of_joint.filter(|(contact, _)| contact.joint.index() == joint);
    let (mut open, mut slides, mut all) = (0, 0, 0);
    for (_, status) in of_joint {
        all += 1;
        open += usize::from(*status == ContactStatus::Open);
        slides += usize::from(*status == ContactStatus::Slip);
    }
    match (open, slides) {
        _ if all > 0 && open == all => Some(Change::Opens),
        (open, slides) if slides > 0 && open + slides == all => Some(Change::Slides),
        (1.., _) => Some(Change::Hinges),
        _ => None,
    }
}

fn statuses(system: &System, sparse: &Sparse, rest: &Rest) -> Vec<ContactStatus> {
    let rows = sparse.rows(&rest.state);
    let points = system.points();
    let force = rows.t[..points].iter().fold(0.0_f64, |most, t| most.max(t.abs()));
    let length = rest.u.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
    let mut statuses: Vec<ContactStatus> = rows.y[..points]
        .iter()
        .zip(&rows.t)
        .map(|(gap, t_n)| {
            let is_open = *gap > ZERO * length || *t_n <= ZERO * force;
            if is_open { ContactStatus::Open } else { ContactStatus::Stick }
        })
        .collect();
    for (friction, t_t) in system.friction.iter().zip(&rows.t[points..]) {
        let point = friction.contact.index();
        let bound = friction.bound(rows.t[point]);
        if statuses[point] == ContactStatus::Stick && t_t.abs() >= bound - ZERO * force {
            statuses[point] = ContactStatus::Slip;
        }
    }
    statuses
}
