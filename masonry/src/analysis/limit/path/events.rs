//! Events along the path: joints that open and slide as the load factor grows.

use serde::Serialize;

use super::Stand;
use super::steps::{AtRest, StepEnd, Steps};
use crate::analysis::limit::LimitError;
use crate::analysis::limit::watch::Watch;
use crate::data::state::PointStatus;
use crate::forms::Sparse;
use crate::ids::JointId;
use crate::model::Model;
use crate::rounding::largest;
use crate::system::System;

/// Gaps below this part of the largest displacement count as closed, and forces whose distance from the bound of
/// friction is below this part of the largest force count as at the bound. Chosen: far above the errors of states, far
/// below values that matter.
const ZERO: f64 = 1e-7;
/// Number of additional steps that locate events, multiplied by the number of contact points. Chosen: all events of
/// some dozen blocks are located, and the first events of hundreds of blocks, in a part of the time of the path.
const STEPS_BY_POINTS: usize = 5000;

/// A change of the state of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum JointChange {
    /// A point of the joint opens, but not all points: the joint is a hinge.
    Hinges,
    /// All points of the joint are open.
    Opens,
    /// All closed points of the joint are at the bound of friction, so that the joint slides.
    Slides,
}

impl JointChange {
    /// Whether a joint opens or slides more than before. A joint that was open and closes at one end is not a new
    /// hinge.
    fn is_after(self, before: Option<Self>) -> bool {
        before != Some(self) && (self, before) != (Self::Hinges, Some(Self::Opens))
    }
}

/// An event: a joint opens or slides for the first time.
#[derive(Debug, Clone, PartialEq)]
pub struct JointEvent {
    /// The joint that changes its state.
    pub joint: JointId,
    /// The change of its state.
    pub change: JointChange,
    /// The load factor \[-\] of the last state at rest before the change.
    pub after: f64,
    /// The load factor \[-\] of the first state at rest after the change.
    pub before: f64,
}

/// The search for events along the path, with additional states between those of the path.
pub(super) struct EventSearch<'a> {
    pub(super) model: &'a Model,
    pub(super) system: &'a System,
    pub(super) steps: &'a Steps<'a>,
    /// Largest difference between the load factors \[-\] of the states before and after an event.
    pub(super) near: f64,
}

impl EventSearch<'_> {
    /// Follows the states at rest along the path and lists the events. Adds a state between two of the states if a
    /// joint opens or slides between them, until all additional steps are used.
    pub(super) fn follow(
        &self,
        mut rests: Vec<(f64, AtRest)>,
        watch: &mut Watch<'_>,
    ) -> Result<(Vec<JointEvent>, Vec<Stand>), LimitError> {
        let mut steps = STEPS_BY_POINTS / self.model.contacts.len().max(1);
        let mut events: Vec<JointEvent> = Vec::new();
        let mut curve: Vec<Stand> = Vec::new();
        let mut known = vec![Vec::new(); self.model.joints.len()];
        let at_zero = rests.first().map(|(_, rest)| rest.u.clone()).unwrap_or_default();
        // The next state is the last of the list.
        rests.reverse();
        let mut last: Option<(f64, AtRest, Vec<Option<JointChange>>)> = None;
        while let Some((factor, rest)) = rests.pop() {
            let statuses = statuses(self.system, self.steps.sparse, &rest);
            let changes = self.changes(&statuses);
            if let Some((after, before, earlier)) = &last {
                let new: Vec<(usize, JointChange)> = (0..changes.len())
                    .filter_map(|k| Some((k, changes[k].filter(|it| it.is_after(earlier[k]))?)))
                    .filter(|(k, change)| !known[*k].contains(change))
                    .collect();
                if !new.is_empty() && factor - after > self.near && steps > 0 && !watch.is_ended {
                    steps -= 1;
                    let middle = 0.5 * (after + factor);
                    let end = self.steps.advance(Some(before), middle, &mut watch.steps())?;
                    if let StepEnd::Rests(between) = end {
                        rests.extend([(factor, rest), (middle, *between)]);
                        continue;
                    }
                }
                for (k, change) in new {
                    known[k].push(change);
                    let (joint, after, before) = (JointId::new(k), *after, factor);
                    events.push(JointEvent { joint, change, after, before });
                }
            }
            curve.push(self.stand(factor, &rest, &statuses, &at_zero));
            last = Some((factor, rest, changes));
        }
        Ok((events, curve))
    }

    fn changes(&self, statuses: &[PointStatus]) -> Vec<Option<JointChange>> {
        (0..self.model.joints.len()).map(|joint| change(self.model, joint, statuses)).collect()
    }

    fn stand(
        &self,
        load_factor: f64,
        rest: &AtRest,
        statuses: &[PointStatus],
        at_zero: &[f64],
    ) -> Stand {
        let blocks = self.steps.sparse.starts().last().copied().unwrap_or(0);
        let moved = rest.u[..blocks].iter().zip(at_zero).map(|(u, before)| (u - before).abs());
        let count = |status| statuses.iter().filter(|it| **it == status).count();
        Stand {
            load_factor,
            displacement: moved.fold(0.0, f64::max),
            contacts: [PointStatus::Open, PointStatus::Stick, PointStatus::Slip].map(count),
        }
    }
}

fn change(model: &Model, joint: usize, statuses: &[PointStatus]) -> Option<JointChange> {
    let of_joint = model.contacts.iter().zip(statuses);
    let of_joint = of_joint.filter(|(contact, _)| contact.joint.index() == joint);
    let (mut open, mut slides, mut all) = (0, 0, 0);
    for (_, status) in of_joint {
        all += 1;
        open += usize::from(*status == PointStatus::Open);
        slides += usize::from(*status == PointStatus::Slip);
    }
    match (open, slides) {
        _ if all > 0 && open == all => Some(JointChange::Opens),
        (open, slides) if slides > 0 && open + slides == all => Some(JointChange::Slides),
        (1.., _) => Some(JointChange::Hinges),
        _ => None,
    }
}

fn statuses(system: &System, sparse: &Sparse, rest: &AtRest) -> Vec<PointStatus> {
    let rows = sparse.rows(&rest.state);
    let points = system.points();
    let force = largest(&rows.t[..points]);
    let length = largest(&rest.u);
    let mut statuses: Vec<PointStatus> = rows.y[..points]
        .iter()
        .zip(&rows.t)
        .map(|(gap, t_n)| {
            let is_open = *gap > ZERO * length || *t_n <= ZERO * force;
            if is_open { PointStatus::Open } else { PointStatus::Stick }
        })
        .collect();
    for (friction, t_t) in system.friction.iter().zip(&rows.t[points..]) {
        let point = friction.contact.index();
        let bound = friction.cone.bound(rows.t[point]);
        if statuses[point] == PointStatus::Stick && t_t.abs() >= bound - ZERO * force {
            statuses[point] = PointStatus::Slip;
        }
    }
    statuses
}
