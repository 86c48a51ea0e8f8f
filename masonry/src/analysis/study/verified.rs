//! The reference in double-double arithmetic: the equations of its contact states, solved again.

use lcp::ContactState;
use lcp::refine::{ContactStatus, Extended, Refined};
use serde::Serialize;

use crate::analysis::outcome::Outcome;
use crate::data::state::State;
use crate::forms::Sparse;
use crate::model::Model;
use crate::recover;
use crate::system::System;

/// The verification of a solution in double-double arithmetic: see [`lcp::Contact2d::verify`]. The last step of a
/// load history is verified, with the slips of the previous steps.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verification {
    /// The largest residual of an equation of the refined solution, relative to the terms of its row \[-\].
    pub residual: f64,
    /// The contradiction between the gaps of redundant contacts, relative to the terms of a row \[-\]: rounding
    /// errors of coordinates and stiffnesses, or zero.
    pub shift: f64,
    /// The smallest margin of the inequalities of the contact law (gaps, slips, forces and distances from the edge of
    /// the cone), relative to the largest displacement or force \[-\]; `None` without contacts.
    pub margin: Option<f64>,
    /// Whether all these inequalities hold, up to rounding errors of `f64`.
    pub holds: bool,
    /// Decimal digits of the refined solution that are certain.
    pub digits: f64,
    /// Distance between the route's solution and the refined one: the largest difference of the forces on the nodes,
    /// relative to the largest force \[-\].
    pub distance: Option<f64>,
    /// Solves with one factorisation.
    pub passes: usize,
    /// Wall-clock time of the factorisation and of these solves \[s\].
    pub seconds: f64,
}

/// Answers with residuals up to this one are exact to the usual digits.
const EXACT: f64 = f64::EPSILON;
/// Violations of inequalities below this one are rounding errors.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

impl Verification {
    /// Whether the refined point is a solution and better than any in `f64`.
    pub fn is_better(&self) -> bool {
        self.holds && self.residual < EXACT
    }
}

/// A solution refined in double-double arithmetic.
#[derive(Debug, Clone)]
pub struct Exact {
    /// The verification.
    pub verified: Verification,
    /// The problem.
    pub sparse: Sparse,
    /// The states of all contacts.
    pub statuses: Vec<ContactStatus>,
    /// The solution of the equations of these states.
    pub refined: Refined,
    /// The solution in `f64`.
    pub state: State,
}

impl Exact {
    /// The verified numbers of an outcome with a state; `None` if memory does not suffice.
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

/// The distance of a plain answer in the forces on the displacements.
fn distance(sparse: &Sparse, given: &ContactState, refined: &Refined) -> Option<f64> {
    let [t_n, t_t] = [&given.t_n, &given.t_t]
        .map(|forces| forces.iter().map(|force| Extended::from(*force)).collect::<Vec<_>>());
    refined.distance(&sparse.problem.forces_on_bodies(&t_n, &t_t))
}

fn exact_state(model: &Model, system: &System, sparse: &Sparse, exact: &ContactState) -> State {
    let rows = sparse.rows(exact);
    recover::from_displacements(model, system, sparse, &rows, &exact.u, EXACT, true)
}
