//! The most accurate solution on a mesh, and its confirmation by another route.

use lcp::Status;
use serde::Serialize;

use super::runs::{Ran, Runner};
use super::verified::{Exact, Verification};
use super::{End, Errors, Figures, StudyProgress};
use crate::analysis::outcome::Outcome;
use crate::scene::{Route, Scene};
use crate::verify::checks::Checks;

/// Routes that end on a basis, and so at rounding errors; and a last one that does not, for scenes that are too
/// large for the others. The first two routes with an answer are compared.
const ROUTES: [Route; 4] = [Route::Interior, Route::Lemke, Route::Alm, Route::Qp];
/// Tolerances of a reference: the first that is reached.
const TOLERANCES: [f64; 4] = [1e-13, 1e-12, 1e-11, 1e-10];
/// The tolerance of a route that converges to a residual: enough to decide the states of the contacts.
const CONVERGED: [f64; 1] = [1e-10];

/// The most accurate solution on a mesh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reference {
    /// The route.
    pub route: Route,
    /// The tightest tolerance that the route reached \[-\].
    pub tolerance: f64,
    /// The residual, recomputed from the original data \[-\].
    pub residual: f64,
    /// The worst of the [checks](Checks) \[-\], which do not depend on the method.
    pub balance: f64,
    /// Wall-clock time \[s\].
    pub seconds: f64,
    /// The verification in double-double arithmetic. Errors are relative to the refined solution if that
    /// solution [is better](Verification::is_better).
    pub verified: Option<Verification>,
    /// The solution of another route; `None` if no other route has one.
    pub confirmed: Option<Confirmation>,
}

/// The distance of an independent solution from a reference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Confirmation {
    /// The other route.
    pub route: Route,
    /// The distance from the reference; it may be large with friction, since there may be several equilibria.
    pub errors: Errors,
    /// The distance of both solutions, each refined from the states of its own contacts, in the forces on the
    /// nodes \[-\].
    pub refined: Option<f64>,
}

/// A reference with the values that are compared with it.
pub(super) struct FoundReference {
    pub(super) reference: Reference,
    pub(super) outcome: Outcome,
    pub(super) figures: Figures,
    /// The refined answer, if it is better.
    pub(super) exact: Option<Exact>,
}

/// The reference of a scene.
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
    /// Verified answers come first, then those of small residuals.
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
        // A looser tolerance helps only if the residual was too large.
        let End::Ended(status) = ran.end else { return None };
        if !matches!(status, Status::AlmostSolved | Status::Stalled | Status::IterationLimit) {
            return None;
        }
    }
    None
}
