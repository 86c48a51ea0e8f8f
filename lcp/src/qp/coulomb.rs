//! Coulomb's friction as the fixed point of programs with frozen bounds of the friction forces.

use super::constants::{DOUBTS, IDLE};
use super::form::{Bounds, Form, ProgramPoint};
use super::interior::{End, Interior};
use super::program::ProgramRun;
use crate::states::{PointRef, Scaled};
use crate::{Status, active};

/// Solves the program, and if there is friction the sequence of programs whose bounds are `mu` times the normal
/// forces of the one before. The states of the contacts of every solution are solved with Coulomb's law, which ends
/// the sequence as soon as the states are right. `to_scaled` returns the displacements and forces of a point.
///
/// # Errors
/// The status if the best point is not good enough.
pub(super) fn solve_programs(
    run: &mut ProgramRun<'_>,
    program: &mut Interior,
    to_scaled: impl Fn(&Scaled, &ProgramPoint) -> (Vec<f64>, Vec<(f64, f64)>),
) -> Result<End, Status> {
    let has_cones = program.form.has_cones();
    let mut limits = generous(&program.form);
    // The last bounds that had a point.
    let mut last: Option<Vec<f64>> = None;
    let (mut least, mut idle, mut enlarged) = (f64::INFINITY, 0, 0);
    let effort = if has_cones { &active::Effort::THOROUGH } else { &active::Effort::ANCHORED };
    let end = loop {
        if let Some(status) = run.monitor.stop(run.search.residual()) {
            return Err(status);
        }
        let found = program.solve(&limits, run.time());
        run.steps += found.iterations;
        match found.end {
            End::Failed => break Ok(End::Failed),
            End::NoPoint if !has_cones || enlarged >= DOUBTS || run.proof().is_some() => {
                break Ok(End::NoPoint);
            }
            // The bounds are too small to hold the bodies.
            End::NoPoint if idle > IDLE => break Err(Status::Stalled),
            End::NoPoint => {
                limits = if let Some(last) = &last {
                    idle += 1;
                    halfway(last, &limits)
                } else {
                    enlarged += 1;
                    limits.iter().map(|limit| 16.0 * limit).collect()
                };
                continue;
            }
            End::ProgramPoint | End::IterationLimit | End::TimeLimit => {}
        }
        let (u, forces) = to_scaled(&run.search.scaled, &found.point);
        let at = PointRef { u: &u, forces: &forces };
        let is_solved = run.search.try_point(at, Some(effort));
        if !has_cones || is_solved || found.end != End::ProgramPoint {
            break Ok(found.end);
        }
        let image = program.form.limits(&found.point.lambda);
        let change = limits.iter().zip(&image).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        idle = if change < 0.9 * least { 0 } else { idle + 1 };
        least = least.min(change);
        if idle > IDLE || (idle >= DOUBTS && run.proof().is_some()) {
            break Err(Status::Stalled);
        }
        // The first bounds are a guess, and no part of them is kept. Later whole steps would oscillate: load that
        // friction takes at one place is missing at others.
        let next = if last.is_none() { image } else { halfway(&limits, &image) };
        last = Some(std::mem::replace(&mut limits, next));
    };
    run.monitor.history.push(run.search.residual());
    end
}

/// Half the way between bounds.
fn halfway(from: &[f64], to: &[f64]) -> Vec<f64> {
    from.iter().zip(to).map(|(from, to)| from + 0.5 * (to - from)).collect()
}

/// Bounds that are larger than the friction forces are likely to be: `mu` times all loads together.
fn generous(form: &Form) -> Vec<f64> {
    let total: f64 = form.linear.iter().chain(&form.offset).map(|v| v.abs()).sum();
    let limit = |bounds: &Bounds| match bounds {
        Bounds::Cone { mu, .. } => mu * total,
        Bounds::Free | Bounds::Nonnegative => 0.0,
    };
    form.bounds.iter().map(limit).collect()
}
