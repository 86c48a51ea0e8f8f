//! Coulomb's friction as the fixed point of programs with frozen bounds of the friction forces.

use super::anderson::Anderson;
use super::contact::{ContactProgram, assemble};
use super::form::{Bounds, Form, Point};
use super::interior::{Effort, End};
use super::program::{Best, Proof};
use super::reduced::{Law, Place};
use crate::solve::Monitor;
use crate::{Contact2d, Status};

/// Rounds without progress after which it is asked whether there is a solution at all.
const DOUBTS: usize = 4;
/// Times that larger bounds are tried where no bounds were large enough yet.
const ENLARGED: usize = 4;

/// Solves the program, and where there is friction the sequence of programs whose bounds are `mu` times
/// the normal forces of the one before. Every solution is polished with Coulomb's own law, which ends the
/// sequence as soon as the states of the contacts are right.
///
/// Says why it ended, where the best point is not good enough.
pub(super) fn solve_contact(
    contact: &Contact2d,
    program: &mut ContactProgram,
    (tolerance, effort): (f64, &dyn Fn() -> Effort),
    (best, monitor, proof): (&mut Best, &mut Monitor<'_>, &Proof<'_>),
) -> Result<End, Status> {
    let has_cones = program.scaled.form.has_cones();
    let mut limits = generous(&program.scaled.form);
    let mut anderson = Anderson::default();
    let mut enlarged = 0;
    let mut residual = best.residual;
    loop {
        if let Some(status) = monitor.stop(residual) {
            return Err(status);
        }
        let found = program.solve(&limits, effort());
        best.factorisations += found.iterations;
        match found.end {
            End::Failed => return Ok(End::Failed),
            End::NoPoint if !has_cones || proof.is_found() || enlarged >= ENLARGED => {
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
        let scaled = &program.scaled;
        let assemble = |point: &Point, places: Option<&[Place]>| assemble(contact, point, places);
        residual = best.offer(scaled, (&found.point, None), &assemble);
        best.polish(scaled, Law::Coulomb, &found.point, &assemble);
        if !has_cones || best.residual <= tolerance || found.end != End::Point {
            monitor.history.push(best.residual);
            return Ok(found.end);
        }
        let image = scaled.form.limits(&found.point.lambda);
        limits = anderson.next(&limits, &image);
        if anderson.is_stalled() || (anderson.idle() >= DOUBTS && proof.is_found()) {
            monitor.history.push(best.residual);
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
