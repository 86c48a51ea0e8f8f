//! Coulomb's friction as the fixed point of programs with frozen bounds of the friction forces.

use super::anderson::Anderson;
use super::constants::{DOUBTS, ENLARGED};
use super::contact::{ContactProgram, state_of};
use super::form::{Bounds, Form};
use super::interior::End;
use super::program::Run;
use crate::{Contact2d, Status, active};

/// Solves the program, and where there is friction the sequence of programs whose bounds are `mu` times
/// the normal forces of the one before. Of every solution the states of the contacts are solved with Coulomb's
/// own law, which ends the sequence as soon as they are right.
///
/// Says why it ended, where the best point is not good enough.
pub(super) fn solve_contact(
    run: &mut Run<'_>,
    contact: &Contact2d,
    program: &mut ContactProgram,
) -> Result<End, Status> {
    let has_cones = program.scaled.form.has_cones();
    let mut limits = generous(&program.scaled.form);
    let mut anderson = Anderson::default();
    let mut enlarged = 0;
    let effort = if has_cones { &active::Effort::THOROUGH } else { &active::Effort::ANCHORED };
    loop {
        if let Some(status) = run.monitor.stop(run.search.residual()) {
            return Err(status);
        }
        let found = program.solve(&limits, run.effort());
        run.steps += found.iterations;
        match found.end {
            End::Failed => return Ok(End::Failed),
            End::NoPoint
                if !has_cones || enlarged >= ENLARGED || run.proof.is_found(run.effort()) =>
            {
                return Ok(End::NoPoint);
            }
            // The bounds are too small to hold the bodies.
            End::NoPoint => {
                limits = anderson.retreat(&limits).unwrap_or_else(|| {
                    enlarged += 1;
                    limits.iter().map(|limit| 16.0 * limit).collect()
                });
                if anderson.is_stalled() {
                    return Err(Status::Stalled);
                }
                continue;
            }
            End::Point | End::IterationLimit | End::TimeLimit => {}
        }
        let state = state_of(contact, &program.scaled.unscaled(&found.point));
        let (u, forces) = run.search.scaled.of_state(&state);
        let is_solved = run.search.try_point((&u, &forces), Some(effort));
        if !has_cones || is_solved || found.end != End::Point {
            run.monitor.history.push(run.search.residual());
            return Ok(found.end);
        }
        let image = program.scaled.form.limits(&found.point.lambda);
        limits = anderson.next(&limits, &image);
        if anderson.is_stalled() || (anderson.idle() >= DOUBTS && run.proof.is_found(run.effort()))
        {
            run.monitor.history.push(run.search.residual());
            return Err(Status::Stalled);
        }
    }
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
