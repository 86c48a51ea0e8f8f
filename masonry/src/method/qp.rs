//! The route by convex quadratic programs. If there is friction, the programs are a fixed-point iteration, in each step
//! of which the bounds of the friction forces are fixed (Tresca).
//!
//! On request, soft springs hold the blocks, and are re-centred at the last solution until they carry no load. The
//! report has their effect before the first re-centring.

use std::ops::ControlFlow;

use lcp::qp::SoftConstraints;
use lcp::{QuadraticProgram, QuadraticProgramSettings, Solver, Status};

use super::{EventObserver, Request, RouteAnswer, sparse};
use crate::data::info::SoftReport;
use crate::forms::Sparse;
use crate::scene::Route;

/// Solves a sparse problem by convex quadratic programs.
///
/// # Errors
/// As [`QuadraticProgram`].
pub fn solve(
    sparse: &Sparse,
    request: &Request,
    observer: EventObserver<'_>,
) -> Result<RouteAnswer, lcp::Error> {
    let problem = &sparse.problem;
    let soft = request.soft.map(|epsilon| SoftConstraints { epsilon, ..Default::default() });
    let settings =
        QuadraticProgramSettings { tolerance: request.tolerance, soft, ..Default::default() };
    let program = QuadraticProgram::new(settings);
    // If the springs carry no load, the status is solved even if the observer breaks at that moment.
    let mut is_cancelled = false;
    let solution = program.solve_observed(problem, &mut |at| {
        let next = observer(at.into());
        is_cancelled = next == ControlFlow::Break(());
        next
    })?;
    let is_over = is_cancelled || solution.status == Status::Cancelled;
    let soft = match request.soft {
        Some(epsilon) if !is_over => {
            let biased = program.solve_soft(problem, epsilon)?;
            Some(SoftReport {
                stiffness: epsilon,
                rounds: solution.info.iterations,
                share: biased.spring_share,
                displacement_error: Some(biased.displacement_error)
                    .filter(|error| error.is_finite()),
            })
        }
        _ => None,
    };
    let mut answer = sparse::solved(Route::Qp, sparse, solution);
    answer.info.soft = soft;
    Ok(answer)
}
