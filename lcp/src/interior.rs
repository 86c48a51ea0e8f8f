//! Interior-point method for contact with friction and for mixed problems.

mod balance;
mod constants;
mod convex;
mod dual;
mod homogeneous;
mod iterate;
mod least;
mod newton_system;
mod outcome;
mod predictor_corrector;
mod problems;
mod program;
mod settings;
mod start;
mod step;
mod turn;
mod variables;

pub use least::LeastForces;
pub use settings::InteriorPointSettings;

use balance::{Ended, balance};
use constants::{MORE_STEPS, PATIENCE, PROXIMAL_TERMS, TRIAL_REDUCTION, TRIAL_RESIDUAL};
use iterate::Iterate;
use newton_system::Defect;
use predictor_corrector::PredictorCorrector;
use start::{set_out, start};

use crate::active::{Effort, Original, Search};
use crate::solve::{Monitor, named};
use crate::states::PointRef;
use crate::vector::HALF_DIGITS;
use crate::{Contact2d, Error, Method, Observer, Solution, Status};

/// An interior-point method for large sparse problems: contact with Coulomb's friction
/// ([`Contact2d`](crate::Contact2d)), and mixed and standard problems.
///
/// Newton's method on `K u = f + C^T t`, the gaps and slips of `u`, and for every point
/// `t_n g = (mu t_n + t_t) s+ = (mu t_n - t_t) s- = m` with the slip `s+ - s-`. The mean product `m` is driven to zero
/// by Mehrotra's predictor and corrector (1992) and Gondzio's correctors of centrality (1996). All variables except the
/// displacements are eliminated point by point, so every step factorises one matrix with the pattern of `K + C^T C`.
/// The central path (the points with equal products) can turn back if there is friction, and steps then follow it
/// (Allgower and Georg 1990). The page `docs/methods/interior_point.md` has the details.
///
/// The crossover follows near the solution: the state of every contact (open, sticking, sliding) is read off, the
/// equations of these states are solved to the last digit, and contacts with contradictions are exchanged. The result
/// is a complementary basis with residuals at rounding level.
///
/// If the iteration jams on bodies in contact, a convex program decides whether any forces inside the friction cones
/// balance the loads. If no such forces exist, the status is [`Status::Infeasible`], with the motion that proves it in
/// [`Solution::certificate`].
///
/// # Guarantee
/// No guarantee is proved. The theory of interior-point methods gives convergence for monotone problems
/// (no friction, positive semidefinite `M`) with a strictly feasible point. The path need not lead to a solution if
/// there is friction; walls of 6e4 contact points took 30 to 70 steps for `mu` from 1/2 to 1.
///
/// # Failure
/// [`Status::Stalled`] if the iteration jams, and also if bodies fall although some forces could hold them. An
/// [`Evolution`](crate::Evolution) shows whether they fall.
///
/// # Cost
/// One sparse factorisation and two to six solves per step. A mixed problem with a dense `M` is treated, but not
/// faster than by dense methods.
///
/// # References
/// * Mehrotra, SIAM Journal on Optimization 2 (1992), [doi:10.1137/0802028](https://doi.org/10.1137/0802028)
/// * Gondzio, Computational Optimization and Applications 6 (1996), [doi:10.1007/BF00249643](https://doi.org/10.1007/BF00249643)
/// * Andersen, Ye, Mathematical Programming 84 (1999), [doi:10.1007/s101070050027](https://doi.org/10.1007/s101070050027)
/// * Duff, Reid, ACM Transactions on Mathematical Software 9 (1983), [doi:10.1145/356044.356047](https://doi.org/10.1145/356044.356047)
///
/// ```
/// use faer::mat;
/// use lcp::{Contact2d, InteriorPoint, Solver};
/// // A body of weight 2 on a plane (mu = 0.5), pushed by 1.4 against a spring of stiffness 4: it slides
/// let contact = Contact2d::new(
///     mat![[0.0, 0.0], [0.0, 4.0]], vec![-2.0, 1.4],
///     mat![[1.0, 0.0]], mat![[0.0, 1.0]], vec![0.0], vec![0.0], vec![0.5],
/// )?;
/// let solution = InteriorPoint::default().solve(&contact)?;
/// assert!(solution.is_solved());
/// let state = contact.variables(&solution);
/// assert!((state.slip[0] - 0.1).abs() < 1e-14 && (state.t_t[0] + 1.0).abs() < 1e-14);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InteriorPoint {
    settings: InteriorPointSettings,
}

named!(InteriorPoint, InteriorPointSettings, Method::Interior);

impl InteriorPoint {
    fn run(&self, problem: &dyn Original, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let mut monitor = Monitor::new(
            Method::Interior,
            self.settings.max_iterations,
            self.settings.time_limit,
            observer,
        );
        let mut search = Search::new(Method::Interior, problem, self.settings.tolerance, None)?;
        let settings = &self.settings;
        let run = Run { settings, problem, search: &mut search, monitor: &mut monitor };
        let (status, proof) = run.solve();
        let mut solution = search.finish(status, monitor);
        if !solution.is_solved() {
            solution.certificate = proof;
        }
        Ok(solution)
    }
}

/// The path from one start, opened by its largest gap, for a problem whose search was begun by another method. Measured
/// on settlements of 105 and 410 bricks, elastic and rigid: 19 of some 120 tries fail; with openings of 0, 1e3 and 1e4
/// times that gap, 33 of 148, 24 of 131 and 50 of 174.
pub(crate) fn follow_path(
    problem: &Contact2d,
    tolerance: f64,
    search: &mut Search<'_>,
    monitor: &mut Monitor<'_>,
) -> Status {
    let settings = InteriorPointSettings { tolerance, ..InteriorPointSettings::default() };
    Run { settings: &settings, problem, search, monitor }.attempt(1.0)
}

/// One solve.
struct Run<'r, 'a, 'b> {
    settings: &'r InteriorPointSettings,
    problem: &'r dyn Original,
    search: &'r mut Search<'a>,
    monitor: &'r mut Monitor<'b>,
}

impl Run<'_, '_, '_> {
    /// The iteration from a start that is opened by this multiple of its largest gap.
    fn attempt(&mut self, opening: f64) -> Status {
        let Search { scaled, condensed, .. } = &mut *self.search;
        let at = start(scaled, condensed);
        let (_, length) = at.sizes();
        self.iterate(at.opened(opening * length))
    }

    fn solve(mut self) -> Ended {
        if self.search.try_start(&self.settings.start)
            || self.search.try_rest(self.settings.crossover)
        {
            return (Status::Solved, None);
        }
        for &opening in &self.settings.openings {
            let status = self.attempt(opening);
            if status != Status::Stalled {
                return (status, None);
            }
        }
        match self.problem.contact() {
            Some(contact) if self.settings.prove_infeasible => self.balanced(contact),
            _ => (Status::Stalled, None),
        }
    }

    /// Whether any forces inside the friction cones balance the loads; these forces are tried with bodies that have not
    /// moved.
    fn balanced(&mut self, contact: &Contact2d) -> Ended {
        let Self { search, monitor, .. } = self;
        let found = balance(contact, &search.scaled, |residual| monitor.stop(residual));
        let (rest, _) = search.rest();
        let crossover = self.settings.crossover.then_some(&Effort::THOROUGH);
        match found {
            Ok(forces) if search.try_point(PointRef { u: &rest, forces: &forces }, crossover) => {
                (Status::Solved, None)
            }
            Ok(_) => (Status::Stalled, None),
            Err(ended) => ended,
        }
    }

    /// Whether the states of the contacts at a point, or those that they lead to, are those of a solution.
    fn crosses_over(&mut self, at: &Iterate, effort: &Effort) -> bool {
        let forces = at.forces();
        self.search.cross_over(PointRef { u: &at.u, forces: &forces }, at.contacts(), effort)
    }

    /// The interior-point iteration from an interior point.
    fn iterate(&mut self, mut at: Iterate) -> Status {
        let mut tried = TRIAL_RESIDUAL / TRIAL_REDUCTION;
        let (_, first) = at.sizes();
        let (mut least, mut since) = (f64::INFINITY, 0);
        let (mut before, mut solved_points) = (None, 0);
        let mut defect = Defect::of(&self.search.scaled, &at);
        loop {
            let worst = self.search.judge(&at.u, &at.forces());
            let is_solved = worst <= self.settings.tolerance;
            // The unit of length is at least that of the start, since lengths are rounding errors if nothing moves.
            let (force, length) = at.sizes();
            let (force, length) = (force.max(1.0), length.max(first));
            let natural = at.natural(force, length);
            let near = natural.max(defect.relative(force, length)).min(worst);
            if self.settings.crossover && (is_solved || near <= TRIAL_REDUCTION * tried) {
                tried = near;
                let effort = if is_solved { Effort::THOROUGH } else { Effort::QUICK };
                let is_sure = near <= HALF_DIGITS;
                let held = PROXIMAL_TERMS.into_iter().filter(|_| is_sure).map(Effort::held);
                if std::iter::once(effort).chain(held).any(|effort| self.crosses_over(&at, &effort))
                {
                    return Status::Solved;
                }
            }
            solved_points += usize::from(is_solved);
            if is_solved && (!self.settings.crossover || solved_points > MORE_STEPS) {
                return Status::Solved;
            }
            if let Some(status) = self.monitor.stop_after(worst, before) {
                return if solved_points > 0 { Status::Solved } else { status };
            }
            let Search { scaled, condensed, .. } = &mut *self.search;
            let (next, step) = if before.is_none() {
                set_out(scaled, condensed, &at)
            } else {
                PredictorCorrector::of(scaled, condensed, &at, &defect).advance()
            };
            before = Some(step);
            defect = Defect::of(scaled, &next);
            let lack = defect.relative(1.0, 1.0);
            let merit = step.mean_product + lack * lack;
            since = if merit < 0.9 * least { 0 } else { since + 1 };
            least = least.min(merit);
            if !next.is_finite() || step.length < HALF_DIGITS || since > PATIENCE {
                // Residuals of an interior point stay large if all gaps, or all forces, are zero at the solution.
                let is_exact = self.settings.crossover && self.crosses_over(&at, &Effort::THOROUGH);
                return if is_exact || solved_points > 0 {
                    Status::Solved
                } else {
                    Status::Stalled
                };
            }
            at = next;
        }
    }
}
