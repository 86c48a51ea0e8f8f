//! The most accurate solution on a mesh, and its confirmation by another route.

use lcp::Status;
use serde::Serialize;

use super::runs::{Ran, Runner};
use super::verified::{Exact, Verification};
use super::{End, Errors, Figures, StudyProgress};
use crate::analysis::outcome::Outcome;
use crate::scene::{Route, Scene};
use crate::verify::checks::Checks;

/// The routes that are tried for a reference; the first two with an answer are compared. All but the last end on a
/// basis, and so at rounding errors; the last is for scenes that are too large for the others.
const ROUTES: [Route; 4] = [Route::Interior, Route::Lemke, Route::Alm, Route::Qp];
/// The tolerances that are tried for a reference, up to the first that is reached.
const TOLERANCES: [f64; 4] = [1e-13, 1e-12, 1e-11, 1e-10];
/// The tolerance for a route that converges to a residual: small enough to decide the states of the contacts.
const CONVERGED: [f64; 1] = [1e-10];

/// The reference of a mesh: the most accurate solution on this mesh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reference {
    /// The route that found the solution.
    pub route: Route,
    /// The smallest tolerance that the route reached \[-\].
    pub tolerance: f64,
    /// The residual of the solution \[-\], recomputed from the original data.
    pub residual: f64,
    /// The worst of the [checks](Checks) \[-\] of the solution, which do not depend on the method.
    pub balance: f64,
    /// Wall-clock time of the solve \[s\].
    pub seconds: f64,
    /// The verification of the solution in double-double arithmetic; `None` if memory does not suffice. Errors of other
    /// solutions are relative to the refined solution if the latter [is better](Verification::is_better).
    pub verified: Option<Verification>,
    /// The comparison with the solution of another route; `None` if no other route has one.
    pub confirmed: Option<Confirmation>,
}

/// The distance between a reference and an independent solution by another route.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Confirmation {
    /// The route of the independent solution.
    pub route: Route,
    /// The distance from the reference. It may be large if there is friction, since there may be several equilibria.
    pub errors: Errors,
    /// The difference between the forces on the nodes in both solutions, each refined from its own contact states
    /// \[-\]; `None` if they are not refined.
    pub refined: Option<f64>,
}

/// A reference with the values with which other solutions are compared.
pub(super) struct FoundReference {
    pub(super) reference: Reference,
    pub(super) outcome: Outcome,
    pub(super) figures: Figures,
    /// The refined solution, if it is better than the reference.
    pub(super) exact: Option<Exact>,
}

/// Finds the reference of a scene on a mesh; `None` if no route has a solution.
pub(super) fn find(scene: &Scene, mesh: u32, runner: &mut Runner) -> Option<FoundReference> {
    let mut found: Vec<RankedReference> = Vec::new();
    for route in ROUTES {
        if found.len() < 2 {
            found.extend(tightest(scene, mesh, route, runner));
        }
    }
    found.sort_by(|a, b| a.rank().0.cmp(&b.rank().0).then(a.rank().1.total_cmp(&b.rank().1)));
    let mut found = found.into_iter();
    let mut best = found.next()?;
    let figures = best.figures()?;
    best.reference.confirmed = found.next().and_then(|other| {
        let errors = other.ran.figures()?.errors(&figures);
        let refined = best.exact.as_ref().zip(other.exact.as_ref());
        let refined = refined.and_then(|(it, other)| it.refined.distance(&other.refined.on_bodies));
        Some(Confirmation { route: other.reference.route, errors, refined })
    });
    let outcome = best.ran.outcome?;
    let exact = best.exact.filter(|exact| exact.verified.is_better());
    Some(FoundReference { reference: best.reference, outcome, figures, exact })
}

struct RankedReference {
    reference: Reference,
    ran: Ran,
    exact: Option<Exact>,
}

impl RankedReference {
    /// Returns the rank of a solution: solutions with a better, refined one come first, then those with small
    /// residuals.
    fn rank(&self) -> (bool, f64) {
        (self.better().is_none(), self.reference.residual)
    }

    fn better(&self) -> Option<&Exact> {
        self.exact.as_ref().filter(|exact| exact.verified.is_better())
    }

    fn figures(&self) -> Option<Figures> {
        match (self.better(), self.ran.solved()) {
            (Some(exact), Some(outcome)) => Some(Figures::of(&outcome.model, &exact.state)),
            _ => self.ran.figures(),
        }
    }
}

fn tightest(
    scene: &Scene,
    mesh: u32,
    route: Route,
    runner: &mut Runner,
) -> Option<RankedReference> {
    let tolerances = if route == Route::Alm { &CONVERGED[..] } else { &TOLERANCES[..] };
    for &tolerance in tolerances {
        let ran = runner.run(scene, StudyProgress { mesh, route, tolerance });
        if let (Some(outcome), Some(seconds)) = (ran.solved(), ran.seconds) {
            let exact = Exact::of(outcome);
            let reference = Reference {
                route,
                tolerance,
                residual: outcome.solve.residuals.worst(),
                balance: outcome.checks.as_ref().map_or(0.0, Checks::worst),
                seconds,
                verified: exact.as_ref().map(|exact| exact.verified.clone()),
                confirmed: None,
            };
            return Some(RankedReference { reference, ran, exact });
        }
        // A looser tolerance is tried only if the residual was too large.
        let End::Ended(status) = ran.end else { return None };
        if !matches!(status, Status::AlmostSolved | Status::Stalled | Status::IterationLimit) {
            return None;
        }
    }
    None
}
