//! One step of the load factor, at the end of which the blocks rest or flow.

use lcp::{Contact2d, ContactState, Ending, Observer, Solver, WarmStart};

use crate::forms::Sparse;
use crate::method::loading::{self, Loading};

/// A state in which all blocks are at rest.
#[derive(Debug, Clone)]
pub(super) struct AtRest {
    /// Displacements of the sparse problem at rest.
    pub(super) u: Vec<f64>,
    /// Forces and gaps at rest; slips of the last part of the step.
    pub(super) state: ContactState,
    /// The problem under the loads of the state at rest, with slips measured from this state.
    under: Contact2d,
}

/// The outcome of a step.
pub(super) enum StepEnd {
    Rests(Box<AtRest>),
    /// The blocks flow, with these velocities of all displacements of the sparse problem.
    Flows(Vec<f64>),
    /// Neither rest nor flow was found.
    Open,
}

/// A structure under loads that stay and others that grow.
pub(super) struct Steps<'a> {
    pub(super) sparse: &'a Sparse,
    /// The growing loads on all displacements for a load factor of one.
    pub(super) growth: &'a [f64],
    /// The mass of every displacement \[kg\], and the largest distance that blocks may move, `reach` \[m\].
    pub(super) mass: &'a [f64],
    pub(super) reach: f64,
    pub(super) tolerance: f64,
}

impl Steps<'_> {
    /// Advances to a load factor, from a state at rest, or from no loads if there is no such state.
    pub(super) fn advance(
        &self,
        from: Option<&AtRest>,
        factor: f64,
        observer: &mut Observer<'_>,
    ) -> Result<StepEnd, lcp::Error> {
        let unloaded = &self.sparse.problem;
        let loads = unloaded.loads().iter().zip(self.growth);
        let loads = loads.map(|(stays, grows)| stays + factor * grows).collect();
        let mut problem = unloaded.with_loads(loads)?;
        let before = from.map(|from| (&from.under, &from.state));
        if let Some(from) = from {
            problem = problem.after(&from.u)?;
        } else {
            let path = loading::path(self.tolerance, None, &WarmStart::None);
            let solution = path.solve_observed(&problem, observer)?;
            if let (true, Some(state)) = (solution.is_solved(), solution.contact) {
                return Ok(StepEnd::Rests(rest(&problem, state)?.into()));
            }
        }
        let Self { mass, reach, tolerance, .. } = *self;
        let loading = Loading {
            before,
            problem: &problem,
            mass,
            reach,
            slowness: loading::SLOWNESS,
            tolerance: tolerance.min(loading::STEP_TOLERANCE),
        };
        let led = loading.lead(&mut |at| observer(at))?;
        Ok(match led.ending {
            Ending::Rests => StepEnd::Rests(rest(&problem, led.evolution.state().clone())?.into()),
            Ending::Flows | Ending::Left => StepEnd::Flows(led.evolution.velocity().to_vec()),
            _ => StepEnd::Open,
        })
    }
}

fn rest(problem: &Contact2d, state: ContactState) -> Result<AtRest, lcp::Error> {
    let under = problem.after(&state.u)?;
    Ok(AtRest { u: state.u.clone(), state, under })
}
