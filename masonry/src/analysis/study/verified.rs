//! Verification in double-double arithmetic: the equations of the contact states of a solution are solved again.

use lcp::ContactState;
use lcp::refine::{ContactStatus, Extended, Refined};
use serde::Serialize;

use crate::analysis::outcome::Outcome;
use crate::data::state::State;
use crate::forms::Sparse;
use crate::model::Model;
use crate::recover;
use crate::system::System;

/// The verification of a solution in double-double arithmetic ([`lcp::Contact2d::verify`]). Only the last step of a
/// load history is verified, with the slips of the previous steps.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verification {
    /// The largest residual of an equation in the refined solution, relative to the terms of the equation \[-\].
    pub residual: f64,
    /// The contradiction between the gaps of redundant contacts, relative to the terms of an equation \[-\]: rounding
    /// errors of coordinates and stiffnesses, or zero.
    pub shift: f64,
    /// The smallest margin by which an inequality of the contact law holds (gaps, slips, forces, distances from the
    /// edge of the friction cone), relative to the largest displacement or force \[-\]; `None` if there are no
    /// contacts.
    pub margin: Option<f64>,
    /// Whether all inequalities of the contact law hold, up to rounding errors of `f64`.
    pub holds: bool,
    /// Number of decimal digits of the refined solution that are certain.
    pub digits: f64,
    /// Distance between the solution of the route and the refined one: the largest difference of the forces on the
    /// nodes, relative to the largest force \[-\].
    pub distance: Option<f64>,
    /// Number of solves with the one factorisation.
    pub passes: usize,
    /// Wall-clock time of the factorisation and of the solves with it \[s\].
    pub seconds: f64,
}

/// The largest residual of a refined solution that counts as exact: the precision of `f64`.
const EXACT: f64 = f64::EPSILON;
/// The largest violation of an inequality that counts as a rounding error.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

impl Verification {
    /// Whether the refined point is a solution, and more accurate than any solution in `f64`.
    pub fn is_better(&self) -> bool {
        self.holds && self.residual < EXACT
    }
}

/// A solution that is refined in double-double arithmetic, with its verification.
#[derive(Debug, Clone)]
pub struct Exact {
    /// The verification of the solution: residuals, margins and certain digits.
    pub verified: Verification,
    /// The sparse problem that the solution solves.
    pub sparse: Sparse,
    /// The states of all contacts in the solution.
    pub statuses: Vec<ContactStatus>,
    /// The refined solution of the equations for the contact states `statuses`.
    pub refined: Refined,
    /// The mechanical state of the refined solution, rounded to `f64`.
    pub state: State,
}

impl Exact {
    /// Verifies an outcome; `None` if it has no state, or if memory does not suffice.
    pub fn of(outcome: &Outcome) -> Option<Self> {
        let (model, state) = (&outcome.model, outcome.state.as_ref()?);
        let system = System::new(model).ok()?;
        let sparse = Sparse::new(&system).ok()?;
        let given = sparse.state(model, &system, state);
        let lcp::refine::Verified { statuses, refined } = sparse.problem.verify(&given).ok()?;
        let plain = refined.rounded(&sparse.problem);
        let verified = judged(&sparse, &given, &refined);
        let state = exact_state(model, &system, &sparse, &plain);
        Some(Self { verified, sparse, statuses, refined, state })
    }
}

fn judged(sparse: &Sparse, given: &ContactState, refined: &Refined) -> Verification {
    let Refined { residual, shift, correction, passes, seconds, .. } = *refined;
    let least = refined.margin.least;
    let uncertain = residual.max(shift).max(correction).max(f64::EPSILON * f64::EPSILON);
    Verification {
        residual,
        shift,
        margin: refined.margin.contact.map(|_| least),
        holds: least >= -ROUNDED,
        digits: (-uncertain.log10()).max(0.0).floor(),
        distance: distance(sparse, given, refined),
        passes,
        seconds,
    }
}

/// Returns the distance between the solution of the route and the refined one, in the forces on the displacements.
fn distance(sparse: &Sparse, given: &ContactState, refined: &Refined) -> Option<f64> {
    let [t_n, t_t] = [&given.t_n, &given.t_t]
        .map(|forces| forces.iter().map(|force| Extended::from(*force)).collect::<Vec<_>>());
    refined.distance(&sparse.problem.forces_on_bodies(&t_n, &t_t))
}

fn exact_state(model: &Model, system: &System, sparse: &Sparse, exact: &ContactState) -> State {
    let rows = sparse.rows(exact);
    recover::from_displacements(model, system, sparse, &rows, &exact.u, EXACT, true)
}
