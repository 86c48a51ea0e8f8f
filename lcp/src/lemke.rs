//! Lemke's method on the general form, records of its pivots, and solutions along a line of right-hand sides.

mod artificial;
mod basis_matrix;
mod constants;
mod crash;
mod dense;
mod feasibility;
mod finish;
mod kernel;
mod parametric;
mod path;
mod problems;
mod progress;
mod ratio;
mod search;
mod sparse;
mod start;
mod tableau;
mod trial;

pub use parametric::{
    Breakpoint, Parametric, ParametricEnd, ParametricPath, ParametricRay, ParametricSettings,
};
pub use progress::Progress;

pub use crate::pivoting::{
    Attempt, AttemptCovering, AttemptEnd, AttemptStart, PivotRecord, Variable,
};

use std::ops::ControlFlow;
use web_time::Instant;

use constants::MATRICES;
use search::Attempts;

use crate::solve::deadline_of;
use crate::{Error, HorizontalLcp, LemkeSettings, Method, Solution};

/// Lemke's method (Lemke 1965; Cottle, Pang and Stone, *The Linear Complementarity Problem*, section 4.4), applied
/// directly to the general form `A t + B y = c`.
///
/// A nonsingular complementary basis, given or found, turns the problem into `w + T z = q`, which is equilibrated by
/// powers of two. The artificial variable `z0` enters with the covering vector `d`, and complementary pivots follow
/// until it leaves. If rows tie, `z0` leaves first; otherwise the lexicographic rule decides. The tableau is checked
/// against the data in every block of pivots and rebuilt if it has drifted. The equations of the final basis are solved
/// with the original matrices and refined. The status is [`Solved`](crate::Status::Solved) only if the residuals,
/// computed from the original data, are below the tolerance. A free variable (a pair of opposite columns) is basic from
/// the start and never leaves.
///
/// # Guarantee
/// The method in exact arithmetic finds a solution, or a proof that there is none, for copositive-plus `M` (for example
/// positive semidefinite `M`) in the standard form. The path for other classes may end on a secondary ray although a
/// solution exists. Other covering vectors and start bases are then tried, and every attempt is recorded in
/// [`Info::attempts`](crate::Info::attempts). After the last attempt the status is
/// [`Infeasible`](crate::Status::Infeasible), with a proof, or [`RayTermination`](crate::Status::RayTermination), which
/// proves nothing.
///
/// # Cost
/// The memory is about five dense matrices of order `n` at the peak; a pivot costs about `100 n` flops and its share
/// of a blocked matrix product, `2 n^2` flops.
///
/// If both matrices are sparse ([`HorizontalLcp::is_sparse`]), no dense matrix of order `n` is formed. The memory is
/// that of the LU factors of a basis and some vectors. A pivot costs three solves with these factors, more if rows tie,
/// and its share of a factorisation. One exception: if no complementary basis is found otherwise, one is searched with
/// dense matrices up to order 2000; larger problems should be given a start basis ([`LemkeSettings::start`]).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lemke {
    settings: LemkeSettings,
}

impl Lemke {
    /// A solver with these settings.
    pub fn new(settings: LemkeSettings) -> Self {
        Self { settings }
    }

    /// The settings.
    pub fn settings(&self) -> &LemkeSettings {
        &self.settings
    }

    /// Solves a problem like [`Solver::solve_observed`](crate::Solver::solve_observed), for an observer that also
    /// needs the attempt and the order.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] for settings out of range, and
    /// [`Error::NotTreated`] for dense problems that need more memory than there is. Mathematical outcomes are in
    /// [`Solution::status`].
    pub fn solve_with_progress(
        &self,
        problem: &HorizontalLcp,
        observer: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        if !problem.is_sparse() {
            check_memory(problem.order())?;
        }
        let began = Instant::now();
        let deadline = deadline_of(began, self.settings.time_limit);
        let mut solution = Attempts::new(&self.settings, problem, deadline).run(observer);
        solution.info.method = Method::Lemke;
        solution.info.seconds = began.elapsed().as_secs_f64();
        Ok(solution)
    }
}

/// Refuses, before it is allocated, a dense problem of an order for which memory does not suffice.
fn check_memory(order: usize) -> Result<(), Error> {
    let entries = order.checked_mul(order).and_then(|square| square.checked_mul(MATRICES));
    let mut trial: Vec<f64> = Vec::new();
    let reserved = trial.try_reserve_exact(std::hint::black_box(entries.unwrap_or(usize::MAX)));
    reserved.map_err(|_| {
        let gigabytes = (MATRICES * size_of::<f64>()) as f64 * (order as f64).powi(2) / 1e9;
        let reason = format!(
            "order {order} takes about {gigabytes:.0} GB, which the system does not have: the method works with \
             {MATRICES} dense matrices of this order"
        );
        Error::NotTreated { method: Method::Lemke, reason }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five dense matrices of three million unknowns need more than any memory.
    #[test]
    fn an_order_beyond_the_memory_is_refused() {
        let message = check_memory(3_000_000).map_err(|error| error.to_string());
        let expected = "order 3000000 takes about 360000 GB, which the system does not have";
        assert!(message.is_err_and(|message| message.contains(expected)));
        assert!(check_memory(10).is_ok());
    }
}
