//! Work and dissipation between two states.
//!
//! The blocks store strain energy `U`, sliding dissipates `D`, and both come from the work `W` of loads and of
//! supports that move. `D` is a sum over contact points of `-t_t` at the end of the step times the slip in it; no
//! single term is negative, for friction opposes slip. `W` is a trapezoidal sum, exact where forces
//! change linearly with displacements. So `W - U - D` tends to zero as steps become shorter,
//! and is zero where no point slides with a force that changes.
//!
//! Friction of blocks that came to rest need not oppose all slips of the step. `D` is a trapezoidal sum there, too; then
//! `W - U - D` is the work of normal forces where gaps open and close.

use nalgebra::Vector2;

use crate::ids::BlockId;
use crate::model::{Body, Model};
use crate::recover;
use crate::state::{ContactState, ContactStatus, State};
use crate::system::{System, displaced_nodes};

/// What loads and supports need to have their work told.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Snapshot {
    /// Loads \[N\] in the order of all displacements.
    loads: Vec<f64>,
    /// Nodal displacements, or amplitudes of rigid blocks \[m\].
    displacements: Vec<f64>,
    /// Force \[N\] of a support on the structure at each contact point, zero between blocks.
    pushes: Vec<Vector2<f64>>,
    /// Movement \[m\] of the support there.
    movements: Vec<Vector2<f64>>,
}

impl Snapshot {
    /// The state of a model, with the system that has its loads.
    pub(crate) fn of(model: &Model, system: &System, state: &State) -> Self {
        let (mut loads, mut displacements) = (Vec::new(), Vec::new());
        for (b, (body, moved)) in system.bodies.iter().zip(&state.displacements).enumerate() {
            if body.stiffness.is_some() {
                loads.extend(system.external_load(body));
                displacements.extend(moved.iter().flat_map(|u| [u.x, u.y]));
            } else {
                loads.extend(system.external_resultant(body));
                let places = displaced_nodes(model, BlockId::new(b));
                displacements.extend(body.modes.amplitudes(places, moved));
            }
        }
        let (mut pushes, mut movements) = (Vec::new(), Vec::new());
        for (contact, force) in model.contacts.iter().zip(&state.contacts) {
            let (push, movement) = match model.joints[contact.joint.index()].a {
                Body::Support(support) => (
                    recover::contact_force(model, contact, force),
                    model.supports[support.index()].displacement_at(contact.position),
                ),
                Body::Block(_) => (Vector2::zeros(), Vector2::zeros()),
            };
            pushes.push(push);
            movements.push(movement);
        }
        Self { loads, displacements, pushes, movements }
    }

    /// The same structure without loads, at rest.
    #[must_use]
    pub(crate) fn at_rest(&self) -> Self {
        Self {
            loads: vec![0.0; self.loads.len()],
            displacements: vec![0.0; self.displacements.len()],
            pushes: vec![Vector2::zeros(); self.pushes.len()],
            movements: vec![Vector2::zeros(); self.movements.len()],
        }
    }

    /// Work \[J\] of loads and supports on the way from this state to the next, by the trapezoidal rule.
    ///
    /// # Panics
    /// If the states are not of one structure.
    pub(crate) fn work_to(&self, next: &Self) -> f64 {
        assert_eq!(self.loads.len(), next.loads.len(), "states of one structure");
        let of_loads: f64 = (0..self.loads.len())
            .map(|i| {
                let moved = next.displacements[i] - self.displacements[i];
                0.5 * (self.loads[i] + next.loads[i]) * moved
            })
            .sum();
        let of_supports: f64 = (0..self.pushes.len())
            .map(|i| {
                let moved = next.movements[i] - self.movements[i];
                0.5 * (self.pushes[i] + next.pushes[i]).dot(&moved)
            })
            .sum();
        of_loads + of_supports
    }
}

/// Energy \[J\] that sliding dissipates where the blocks slid by `slips` before the slip of the state in which they rest: by the
/// trapezoidal rule. `before` is `None` in the first step.
pub(crate) fn dissipation_to_rest(
    before: Option<&[ContactState]>,
    after: &[ContactState],
    slips: &[f64],
) -> f64 {
    let taken = |(i, (contact, slip)): (usize, (&ContactState, &f64))| {
        let t_t = before.map_or(0.0, |before| before[i].t_t) + contact.t_t;
        -0.5 * t_t * (slip + contact.y_t)
    };
    after.iter().zip(slips).enumerate().map(taken).sum()
}

/// What friction did with the slips of a step, by the forces at its end: the law of motion as it was kept.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Friction {
    /// Energy \[J\] that it took, the sum of `-t_t ds`.
    pub(crate) taken: f64,
    /// Energy \[J\] that it could take at most, the sum of `(mu t_n + C) |ds|`.
    capacity: f64,
    /// Energy \[J\] that it gave: the part of the first sum that is negative.
    pub(crate) created: f64,
}

impl Friction {
    /// Of contacts that slid by `slips` before the slip of their state, if by any.
    pub(crate) fn of(model: &Model, contacts: &[ContactState], slips: Option<&[f64]>) -> Self {
        let mut sum = Self::default();
        for (i, (point, contact)) in model.contacts.iter().zip(contacts).enumerate() {
            // What is computed for a contact that sticks is an error, and no slip.
            let own = if contact.status == ContactStatus::Stick { 0.0 } else { contact.y_t };
            let slip = own + slips.map_or(0.0, |slips| slips[i]);
            let is_open = contact.status == ContactStatus::Open;
            if is_open || !point.law.resists_sliding() {
                continue;
            }
            let taken = -contact.t_t * slip;
            sum.taken += taken;
            sum.created += (-taken).max(0.0);
            sum.capacity += point.law.bound(contact.t_n) * slip.abs();
        }
        sum
    }

    /// What it took of what it could, one by Coulomb's law; `None` where nothing slid.
    pub(crate) fn power(&self) -> Option<f64> {
        (self.capacity > 0.0).then(|| self.taken / self.capacity)
    }
}

/// Energy \[J\] that the tensile strength of open joints holds, `T y_n`: what opening them took, and what they give
/// back when they close.
pub(crate) fn held(model: &Model, contacts: &[ContactState]) -> f64 {
    let points = model.contacts.iter().zip(contacts);
    points.map(|(point, contact)| point.law.tension * contact.y_n.max(0.0)).sum()
}
