//! What soft springs on all displacements change, before they are centred anew.

use serde::Serialize;

use super::runs::{Ran, Runner, on_route};
use super::{End, Errors, Figures};
use crate::scene::{Route, Scene};

/// The tolerance to which springs are centred: their bias is known well enough then.
const TOLERANCE: f64 = 1e-6;

/// Quadratic programs with springs of one stiffness.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Springs {
    /// Stiffness of the springs, relative to that of the blocks \[-\].
    pub stiffness: f64,
    /// The residual asked for \[-\].
    pub tolerance: f64,
    /// How it ended.
    pub end: End,
    /// Wall-clock time, with all rounds and one solve more for the bias \[s\].
    pub seconds: Option<f64>,
    /// How often the springs were centred.
    pub rounds: Option<usize>,
    /// Share of the load that they carry before they are centred anew \[-\].
    pub share: Option<f64>,
    /// Their bias: the error of the displacements before, relative to these \[-\].
    pub bias: Option<f64>,
    /// Algebraic errors after the last round, when nothing of the springs is left.
    pub errors: Option<Errors>,
}

/// One record for every stiffness, from soft to stiff, which takes more and more rounds: where the time ran
/// out, stiffer ones are not tried.
pub(super) fn studied(
    scene: &Scene,
    mesh: u32,
    stiffnesses: &[f64],
    runner: &mut Runner,
    reference: Option<&Figures>,
) -> Vec<Springs> {
    let plain = on_route(scene, Route::Qp, TOLERANCE);
    let mut stiffnesses = stiffnesses.to_vec();
    stiffnesses.sort_by(f64::total_cmp);
    let mut too_long: Option<f64> = None;
    let of = |stiffness: f64| {
        let ran = match too_long {
            Some(softer) => Ran::skipped(format!("the time ran out with springs of {softer:e}")),
            None => runner.run(&plain.clone().soft(stiffness), mesh),
        };
        if ran.is_too_long() {
            too_long = Some(stiffness);
        }
        let report = ran.outcome.as_ref().and_then(|outcome| outcome.solve.soft);
        Springs {
            stiffness,
            tolerance: TOLERANCE,
            seconds: ran.seconds,
            rounds: report.map(|it| it.rounds),
            share: report.map(|it| it.share),
            bias: report.and_then(|it| it.displacement_error),
            errors: ran.figures().zip(reference).map(|(found, it)| found.errors(it)),
            end: ran.end,
        }
    };
    stiffnesses.into_iter().map(of).collect()
}
