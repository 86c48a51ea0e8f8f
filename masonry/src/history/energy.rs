//! Work and dissipation between two states.
//!
//! The blocks store strain energy `U`, sliding dissipates the energy `D`, and the work `W` of loads and of moving
//! supports supplies both. `D` is a sum over contact points of `-t_t` at the end of the step times the slip in the
//! step; no single term is negative, because friction opposes slip. `W` is computed by the trapezoidal rule, which is
//! exact if forces change linearly with displacements. So `W - U - D` tends to zero as steps become shorter, and is
//! zero if no point slides with a force that changes.
//!
//! Blocks with mass move from one state to the next in several steps. `D` is then the sum over all these steps, and the
//! drag takes a small part of the work.

use nalgebra::Vector2;

use crate::data::state::{PointState, PointStatus, State};
use crate::model::{Body, Model};
use crate::recover;
use crate::system::rigid::Modes;
use crate::system::{nodal_loads, resultant};

/// The data of a state from which the work of loads and supports is computed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Snapshot {
    /// Loads \[N\] on the displacements of all nodes, or on the amplitudes of rigid blocks.
    loads: Vec<f64>,
    /// Displacements \[m\] of nodes, or amplitudes of rigid blocks, in the same order.
    displacements: Vec<f64>,
    /// Force \[N\] of a support on the structure at each contact point; zero between blocks.
    pushes: Vec<Vector2<f64>>,
    /// Movement \[m\] of the support at each contact point; zero between blocks.
    movements: Vec<Vector2<f64>>,
}

impl Snapshot {
    /// Collects the data of a state of a model, which is under the loads of this state.
    pub(crate) fn of(model: &Model, state: &State) -> Self {
        let (mut loads, mut displacements) = (Vec::new(), Vec::new());
        for (block, moved) in model.blocks.iter().zip(&state.displacements) {
            if let (Some(mesh), Some(_)) = (&block.mesh, block.elasticity) {
                loads.extend(nodal_loads(model, block, mesh));
                displacements.extend(moved.iter().flat_map(|u| [u.x, u.y]));
            } else {
                loads.extend(resultant(model, block));
                displacements.extend(Modes::of(&block.corners).amplitudes(&block.corners, moved));
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

    /// Computes the work \[J\] of loads and supports from the state `before` to this state, by the trapezoidal rule;
    /// without `before`, from the structure without loads.
    ///
    /// # Panics
    /// If the states are not of one structure.
    pub(crate) fn work_from(&self, before: Option<&Self>) -> f64 {
        let of_loads = (0..self.loads.len()).map(|i| {
            let [load, u] = before.map_or([0.0; 2], |it| [it.loads[i], it.displacements[i]]);
            0.5 * (load + self.loads[i]) * (self.displacements[i] - u)
        });
        let of_supports = (0..self.pushes.len()).map(|i| {
            let rest = [Vector2::zeros(); 2];
            let [push, place] = before.map_or(rest, |it| [it.pushes[i], it.movements[i]]);
            0.5 * (push + self.pushes[i]).dot(&(self.movements[i] - place))
        });
        of_loads.sum::<f64>() + of_supports.sum::<f64>()
    }
}

/// The energies of friction and of drag in one step, or in several.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct FrictionWork {
    /// Energy \[J\] dissipated by friction, `-t_t . (increment of y_t)`.
    pub(crate) dissipation: f64,
    /// Ratio of the work of friction to its largest possible value; `None` if nothing slid.
    power: Option<f64>,
    /// Energy \[J\] that friction released, which is the negative part of the dissipation; zero by Coulomb's law.
    pub(crate) created: f64,
    /// Energy \[J\] that the drag of slow motions takes.
    pub(crate) dragged: f64,
}

impl FrictionWork {
    /// Computes the work of friction in one step; `y_t` of `contacts` is the slip of this step.
    pub(crate) fn of_step(model: &Model, contacts: &[PointState]) -> Self {
        let (mut sum, mut capacity) = (Self::default(), 0.0);
        for (point, contact) in model.contacts.iter().zip(contacts) {
            if contact.status != PointStatus::Slip {
                continue;
            }
            let taken = -contact.t_t * contact.y_t;
            sum.dissipation += taken;
            sum.created += (-taken).max(0.0);
            capacity += point.law.bound(contact.t_n) * contact.y_t.abs();
        }
        sum.power = (capacity > 0.0).then(|| sum.dissipation / capacity);
        sum
    }

    /// Returns the work of friction in all steps of a motion.
    pub(crate) fn of_way(account: &lcp::Account) -> Self {
        let lcp::Account { dissipation, created, dragged, .. } = *account;
        Self { dissipation, power: account.friction_power(), created, dragged }
    }

    /// Returns the ratio of the work of friction to its largest possible value; `None` if nothing slid.
    pub(crate) fn power(&self) -> Option<f64> {
        self.power
    }
}

/// Computes the energy \[J\] that open joints hold by their tensile strength, `T y_n`: they take this energy when they
/// open, and give it back when they close.
pub(crate) fn held(model: &Model, contacts: &[PointState]) -> f64 {
    let points = model.contacts.iter().zip(contacts);
    points.map(|(point, contact)| point.law.tension * contact.y_n.max(0.0)).sum()
}
