//! What soft springs on all displacements change, before they are centred anew.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use lcp::Status;
use masonry::analysis::solve::solve_observed;
use masonry::analysis::study::{End, Errors};
use masonry::data::state::State;
use masonry::scene::{Route, Scene};

/// Relative to the stiffness of the blocks \[-\], from soft to stiff, which takes more and more rounds.
const STIFFNESSES: [f64; 7] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2];
/// The tolerance to which springs are centred: their bias is known well enough then.
pub(crate) const TOLERANCE: f64 = 1e-6;

/// Quadratic programs with springs of one stiffness.
pub(crate) struct Springs {
    pub(crate) stiffness: f64,
    pub(crate) end: End,
    /// Wall-clock time, with all rounds and the solves for share and bias \[s\].
    pub(crate) seconds: Option<f64>,
    /// How often the springs were centred.
    pub(crate) rounds: Option<usize>,
    /// Share of the load that they carry before they are centred anew \[-\].
    pub(crate) share: Option<f64>,
    /// Their bias: the error of the displacements before, relative to these \[-\].
    pub(crate) bias: Option<f64>,
    /// Algebraic errors after the last round, when nothing of the springs is left.
    pub(crate) errors: Option<Errors>,
}

/// Springs of all stiffnesses; where the time ran out, stiffer ones are not tried.
pub(crate) fn springs(scene: &Scene, limit: Duration, reference: Option<&State>) -> Vec<Springs> {
    let mut too_long: Option<f64> = None;
    let of = |stiffness: f64| {
        if let Some(softer) = too_long {
            let reason = format!("the time ran out with springs of {softer:e}");
            return skipped(stiffness, End::Skipped(reason));
        }
        let found = one(scene, stiffness, limit, reference);
        if found.end == End::Ended(Status::TimeLimit) {
            too_long = Some(stiffness);
        }
        found
    };
    STIFFNESSES.into_iter().map(of).collect()
}

fn skipped(stiffness: f64, end: End) -> Springs {
    Springs { stiffness, end, seconds: None, rounds: None, share: None, bias: None, errors: None }
}

fn one(scene: &Scene, stiffness: f64, limit: Duration, reference: Option<&State>) -> Springs {
    let scene = scene.clone().route(Route::Qp).tolerance(TOLERANCE).stresses(true).soft(stiffness);
    let began = Instant::now();
    let result = solve_observed(&scene, &mut |_| {
        if began.elapsed() < limit { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let seconds = Some(began.elapsed().as_secs_f64());
    let outcome = match result {
        Ok(outcome) => outcome,
        Err(error) => return skipped(stiffness, End::Refused(error.to_string())),
    };
    // Nobody but this observer cancels.
    let end = End::Ended(match outcome.solve.status {
        Status::Cancelled => Status::TimeLimit,
        status => status,
    });
    let report = outcome.solve.soft;
    let state = outcome.state.as_ref().filter(|_| end.is_solved());
    Springs {
        stiffness,
        seconds,
        rounds: report.map(|it| it.rounds),
        share: report.map(|it| it.share),
        bias: report.and_then(|it| it.displacement_error),
        errors: state.zip(reference).map(|(state, it)| Errors::of(&outcome.model, state, it)),
        end,
    }
}
