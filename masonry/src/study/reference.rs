//! The most accurate answer on a mesh, and what confirms it.

use lcp::Status;
use serde::Serialize;

use super::runs::{Ran, Runner, on_route};
use super::{End, Errors};
use crate::check::Checks;
use crate::outcome::Outcome;
use crate::scene::{Route, Scene};

/// Routes that end on a basis, and so at rounding; the first two that have an answer are compared.
const ROUTES: [Route; 3] = [Route::Interior, Route::Lemke, Route::Qp];
/// Tolerances of a reference: the first that is reached.
const TOLERANCES: [f64; 4] = [1e-13, 1e-12, 1e-11, 1e-10];

/// An answer by a route that ends exactly on a basis, as accurate as it can be had.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reference {
    /// The route.
    pub route: Route,
    /// The tightest tolerance that it reached \[-\].
    pub tolerance: f64,
    /// The residual, recomputed from the original data \[-\].
    pub residual: f64,
    /// The worst of the balances of forces and moments, the violation of the friction cones and the
    /// penetration \[-\], which use nothing of the method.
    pub balance: f64,
    /// Wall-clock time \[s\].
    pub seconds: f64,
    /// Another route that went another way; `None` where no other has an answer.
    pub confirmed: Option<Confirmation>,
}

/// How far an independent answer is from a reference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Confirmation {
    /// The other route.
    pub route: Route,
    /// Its distance from the reference. With friction there may be several equilibria, and then it may be large.
    pub errors: Errors,
}

/// The reference of a scene and its outcome.
pub(super) fn find(scene: &Scene, mesh: u32, runner: &mut Runner) -> Option<(Reference, Outcome)> {
    let mut found: Vec<Candidate> = Vec::new();
    for route in ROUTES {
        if found.len() < 2 {
            found.extend(tightest(scene, (mesh, route), runner));
        }
    }
    found.sort_by(|a, b| a.reference.residual.total_cmp(&b.reference.residual));
    let mut found = found.into_iter();
    let best = found.next()?;
    let figures = best.ran.figures()?;
    let confirmed = found.next().and_then(|other| {
        let errors = other.ran.figures()?.errors(&figures);
        Some(Confirmation { route: other.reference.route, errors })
    });
    Some((Reference { confirmed, ..best.reference }, best.ran.outcome?))
}

struct Candidate {
    reference: Reference,
    ran: Ran,
}

fn tightest(scene: &Scene, (mesh, route): (u32, Route), runner: &mut Runner) -> Option<Candidate> {
    for tolerance in TOLERANCES {
        let ran = runner.run(&on_route(scene, route, tolerance), mesh);
        if let (Some(outcome), Some(seconds)) = (ran.solved(), ran.seconds) {
            let reference = Reference {
                route,
                tolerance,
                residual: outcome.solve.residuals.worst(),
                balance: outcome.checks.as_ref().map_or(0.0, worst),
                seconds,
                confirmed: None,
            };
            return Some(Candidate { reference, ran });
        }
        // A looser tolerance helps where the residual was too large, and nowhere else.
        if !matches!(ran.end, End::Ended(Status::AlmostSolved | Status::Stalled)) {
            return None;
        }
    }
    None
}

fn worst(checks: &Checks) -> f64 {
    let Checks { force_balance, moment_balance, cone_violation, penetration, .. } = *checks;
    force_balance.max(moment_balance).max(cone_violation).max(penetration)
}
