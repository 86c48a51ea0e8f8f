//! One step of a load factor: the blocks rest, or flow.

use faer::sparse::SparseColMat;
use lcp::{
    Contact2d, ContactState, Evolution, EvolutionSettings, InteriorPoint, InteriorPointSettings,
    Observer, Solver, Status, WarmStart,
};

use crate::method::forms::Sparse;

/// Steps of interior points from the states of contacts before blocks move. Chosen: near a state at rest few suffice.
const STEPS_BEFORE_MOTION: usize = 40;
/// Steps of the motions of one step. Chosen: those of [`EvolutionSettings`].
const STEPS_OF_MOTION: usize = 1000;

/// The part of the work of the loads that nothing may have taken where blocks rest. Theory: none where they do, all where they
/// fall freely; the middle.
const UNTAKEN: f64 = 0.5;

/// The blocks where they rest.
#[derive(Debug, Clone)]
pub(super) struct Rest {
    /// Displacements of the sparse problem.
    pub(super) u: Vec<f64>,
    /// Forces and gaps; slips of the step.
    pub(super) state: ContactState,
}

/// How a step ended.
pub(super) enum End {
    Rests(Rest),
    /// With the velocities of all displacements.
    Flows(Vec<f64>),
    /// Neither came out.
    Open,
}

/// A structure under loads that stay and others that grow.
pub(super) struct Steps<'a> {
    pub(super) sparse: &'a Sparse,
    /// The loads that grow, for a factor of one.
    pub(super) growth: &'a [f64],
    pub(super) tolerance: f64,
}

impl Steps<'_> {
    /// From a state at rest, or from nothing, to a load factor.
    pub(super) fn advance(
        &self,
        from: Option<&Rest>,
        factor: f64,
        observer: &mut Observer<'_>,
    ) -> Result<End, lcp::Error> {
        let unloaded = &self.sparse.problem;
        let loads = unloaded.loads().iter().zip(self.growth);
        let mut problem =
            unloaded.with_loads(loads.map(|(stays, grows)| stays + factor * grows).collect())?;
        let mut start = WarmStart::None;
        let mut at = vec![0.0; problem.displacements()];
        if let Some(from) = from {
            problem = problem.after(&from.u)?;
            let (t, y) = problem.to_pairs(&from.state);
            start = WarmStart::Point { t, y };
            at.clone_from(&from.u);
        }
        let settings = InteriorPointSettings {
            tolerance: self.tolerance,
            max_iterations: STEPS_BEFORE_MOTION,
            start,
            continuation: false,
            ..InteriorPointSettings::default()
        };
        let solution = InteriorPoint::new(settings).solve_observed(&problem, observer)?;
        if solution.status == Status::Solved
            && let Some(state) = solution.contact
        {
            return Ok(end(&problem, &at, state));
        }
        let settings = EvolutionSettings {
            tolerance: self.tolerance,
            max_iterations: STEPS_OF_MOTION,
            ..EvolutionSettings::default()
        };
        let evolved = Evolution::new(settings).advance_observed(&problem, &at, observer)?;
        Ok(match evolved.solution.status {
            Status::Solved => end(&problem, &at, evolved.state().clone()),
            Status::NoEquilibrium => End::Flows(evolved.motions.motion),
            _ => End::Open,
        })
    }
}

/// Where blocks rest under loads; or that they flow, if nothing there balances the loads that have taken them there. Of blocks
/// that are far away residuals tell nothing: what their stiffness makes of the rounding errors of displacements is more
/// than all loads.
fn end(problem: &Contact2d, from: &[f64], state: ContactState) -> End {
    let moved: Vec<f64> = state.u.iter().zip(from).map(|(u, before)| u - before).collect();
    let work: f64 = problem.loads().iter().zip(&moved).map(|(f, moved)| f * moved).sum();
    let along = |forces: &[f64], rows: &SparseColMat<usize, f64>| -> f64 {
        rows.triplet_iter().map(|entry| forces[entry.row] * entry.val * moved[entry.col]).sum()
    };
    let by_contacts = along(&state.t_n, problem.normal()) + along(&state.t_t, problem.tangent());
    let unbalanced = work + by_contacts - along(&state.u, problem.stiffness());
    if work > 0.0 && unbalanced > UNTAKEN * work {
        End::Flows(moved)
    } else {
        End::Rests(Rest { u: state.u.clone(), state })
    }
}
