//! Interior-point method for contact with friction and for mixed problems.

mod balance;
mod constants;
mod continuation;
mod factors;
mod homogeneous;
mod iterate;
mod least;
mod path;
mod problems;
mod program;
mod saddle;
mod settings;
mod start;
mod turn;
mod variables;

use std::ops::ControlFlow;

pub use least::LeastForces;
pub use settings::InteriorPointSettings;

use balance::{Balance, balance};
use constants::{
    BALANCE_TOLERANCE, HELD, MORE, NEAR, NEARER, NO_STEP, OPENING_OF_STEP, PATIENCE,
    PATIENCE_OF_START, SURE, WIDTH,
};
use continuation::End;
use iterate::{Defect, Iterate};
use path::advance;
use start::{set_out, start_opened};

use crate::active::{Effort, Original, Search};
use crate::solve::Monitor;
use crate::states::{Condensed, Scaled};
use crate::{
    Certificate, Contact2d, Error, Iteration, Method, Observer, SoftSprings, Solution, Status,
};

/// An interior-point method for large sparse problems: contact with Coulomb's friction
/// ([`Contact2d`](crate::Contact2d)), and mixed and standard problems.
///
/// Newton's method on `K u = f + C^T t`, `y = C u + x`, `t_i y_i = tau`, with `tau` driven to zero by Mehrotra's
/// predictor and corrector (1992) and Gondzio's correctors of centrality (1996). Everything but the displacements is
/// eliminated point by point, so every step factorises one matrix with the pattern of `K + C^T C`. Its order and
/// structure are found once; friction makes its values unsymmetric. Small proximal terms keep floating bodies and
/// redundant contacts regular, and vanish with the steps.
///
/// With friction the central path (the points with equal products) can turn back: for a while the products have to
/// grow. The sign of the determinant, which the factorisation gives, shows on which side of a turn a point is, and
/// steps follow the path around it (Allgower and Georg 1990).
///
/// Near the solution follows the crossover. The state of every contact (open, sticking, sliding) is read off, the
/// equations of these states are solved to the last digit, and contacts with contradictions are exchanged. The result
/// is a complementary basis with residuals at rounding level.
///
/// If the iteration fails, soft springs on all displacements are reduced step by step. If there is a solution, the
/// share of the load that they carry tends to zero with their stiffness; if there is none, it tends to a constant.
/// Then a convex program decides whether any forces inside the friction cones balance the loads. If such forces
/// exist, they are tried. If a checked motion proves that none exist, the status is [`Status::NoEquilibrium`], with
/// the evidence in [`Solution::certificate`].
///
/// # Guarantee
/// None is proved. For monotone problems (no friction, positive semidefinite `M`) with a strictly feasible point the
/// theory of interior-point methods gives convergence. With friction the path need not lead to a solution; walls of
/// 6e4 contact points took 30 to 70 steps for `mu` from 1/2 to 1.
///
/// # Failure
/// [`Status::Stalled`] if both the iteration and the springs fail, and if rigid bodies fall although some forces
/// could hold them. For elastic bodies with friction [`Status::NoEquilibrium`] is evidence, not a proof: there may be
/// a solution. It has no Farkas vector.
///
/// # Cost
/// One sparse factorisation and two to six solves per step. A mixed problem with a dense `M` is treated, but not
/// faster than by dense methods.
///
/// # References
/// * S. Mehrotra, On the implementation of a primal-dual interior point method, SIAM Journal on
///   Optimization 2 (1992), [doi:10.1137/0802028](https://doi.org/10.1137/0802028)
/// * J. Gondzio, Multiple centrality corrections in a primal-dual method for linear programming,
///   Computational Optimization and Applications 6 (1996),
///   [doi:10.1007/BF00249643](https://doi.org/10.1007/BF00249643)
/// * E. D. Andersen, Y. Ye, On a homogeneous algorithm for the monotone complementarity problem, Mathematical
///   Programming 84 (1999), [doi:10.1007/s101070050027](https://doi.org/10.1007/s101070050027)
/// * I. S. Duff, J. K. Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM
///   Transactions on Mathematical Software 9 (1983),
///   [doi:10.1145/356044.356047](https://doi.org/10.1145/356044.356047)
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

impl InteriorPoint {
    /// A solver with these settings.
    pub fn new(settings: InteriorPointSettings) -> Self {
        Self { settings }
    }

    /// The settings.
    pub fn settings(&self) -> &InteriorPointSettings {
        &self.settings
    }

    fn run(&self, problem: &dyn Original, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        self.settings.validate(problem.order())?;
        let mut monitor =
            Monitor::new(self.settings.max_iterations, self.settings.time_limit, observer);
        let mut search = Search::new(Method::Interior, problem, self.settings.tolerance)?;
        let settings = &self.settings;
        let run = Run { settings, problem, search: &mut search, monitor: &mut monitor };
        let (status, springs) = run.solve();
        let mut solution = search.finish(status, monitor);
        if !solution.is_solved() {
            solution.certificate = springs.map(Certificate::Springs);
        }
        Ok(solution)
    }
}

/// The path from one wide start, for a problem whose search others have begun.
pub(crate) fn follow_path(
    problem: &Contact2d,
    tolerance: f64,
    search: &mut Search<'_>,
    monitor: &mut Monitor<'_>,
) -> Status {
    let settings = InteriorPointSettings { tolerance, ..InteriorPointSettings::default() };
    Run { settings: &settings, problem, search, monitor }.path(OPENING_OF_STEP)
}

/// One solve.
struct Run<'r, 'a, 'b> {
    settings: &'r InteriorPointSettings,
    problem: &'r dyn Original,
    search: &'r mut Search<'a>,
    monitor: &'r mut Monitor<'b>,
}

/// A step from a point with its residuals, with the stiffness of the springs and the least product of a pair.
type Step = fn(&Scaled, &mut Condensed, (&Iterate, &Defect), (f64, f64)) -> (Iterate, f64);

impl Run<'_, '_, '_> {
    /// The path from a start that is opened by this multiple of its largest gap.
    fn path(&mut self, opening: f64) -> Status {
        let Search { scaled, condensed, .. } = &mut *self.search;
        let at = start_opened(scaled, condensed, opening);
        self.iterate(at, PATIENCE_OF_START, set_out)
    }

    fn solve(mut self) -> (Status, Option<SoftSprings>) {
        let is_tried = self.search.try_start(&self.settings.start)
            || self.search.try_rest(self.settings.crossover);
        let (mut status, mut springs) = (is_tried.then_some(Status::Solved), None);
        let openings = if status.is_none() { &self.settings.openings[..] } else { &[] };
        for &opening in openings {
            status = Some(self.path(opening));
            if status != Some(Status::Stalled) {
                break;
            }
        }
        if status == Some(Status::Stalled) && self.settings.continuation {
            let Self { search, monitor, .. } = &mut self;
            let Search { scaled, condensed, .. } = &mut **search;
            let mut limit = None;
            let end = continuation::follow(scaled, condensed, || {
                let last = monitor.history.last().copied().unwrap_or(f64::INFINITY);
                limit = monitor.stop(last);
                limit.is_none()
            });
            status = Some(match end {
                End::Standing(at) => self.iterate(at, PATIENCE, advance),
                End::Falling(path) if self.problem.has_bodies() => {
                    let status = self.fallen();
                    springs = (status == Status::NoEquilibrium).then_some(path);
                    status
                }
                End::Falling(_) | End::Open => limit.unwrap_or(Status::Stalled),
            });
        }
        (status.unwrap_or(Status::Stalled), springs)
    }

    /// What follows from bodies that fall from spring to spring.
    ///
    /// With friction they may come to rest elsewhere: that they cannot is proved, or else the forces that
    /// might hold them are tried. Where these do not hold them, bodies that all have a stiffness are taken
    /// to fall, because it says how their contacts are strained; of rigid ones nothing is known.
    fn fallen(&mut self) -> Status {
        let left = self.settings.max_iterations.saturating_sub(self.monitor.iterations());
        let Self { search, monitor, .. } = self;
        let scaled = &search.scaled;
        let last = monitor.history.last().copied().unwrap_or(f64::INFINITY);
        let mut limit = None;
        let observer = &mut |_: &Iteration| {
            limit = monitor.stop(last);
            if limit.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let settings = InteriorPointSettings {
            tolerance: BALANCE_TOLERANCE,
            max_iterations: left,
            continuation: false,
            ..InteriorPointSettings::default()
        };
        let found = balance(scaled, |mixed| InteriorPoint::new(settings).run(mixed, observer).ok());
        let rest = vec![0.0; scaled.order()];
        let crossover = self.settings.crossover.then_some(&Effort::THOROUGH);
        match (found, limit) {
            (Balance::Impossible, _) => Status::NoEquilibrium,
            (_, Some(status @ (Status::Cancelled | Status::TimeLimit))) => status,
            // Bodies that have not moved.
            (Balance::Possible(forces), _)
                if self.search.try_point((&rest, &forces), crossover) =>
            {
                Status::Solved
            }
            _ if self.search.scaled.is_elastic() => Status::NoEquilibrium,
            _ => Status::Stalled,
        }
    }

    /// The interior-point iteration from a point inside, with a first step of its own, until it has jammed for so many steps.
    fn iterate(&mut self, mut at: Iterate, patience: usize, first_step: Step) -> Status {
        let mut step = first_step;
        let mut tried = NEAR / NEARER;
        let (_, first) = at.sizes();
        let (mut least, mut since) = (f64::INFINITY, 0);
        let mut solved = 0;
        let mut defect = Defect::of(&self.search.scaled, &at, 0.0);
        loop {
            let forces = at.forces();
            let worst = self.search.judge(&at.u, &forces);
            let is_solved = worst <= self.settings.tolerance;
            // Where nothing moves the residuals measure gaps by noise.
            let (force, length) = at.sizes();
            let units = (force.max(1.0), length.max(first));
            let natural = at.natural(&self.search.scaled, units);
            let near = natural.max(defect.relative(units)).min(worst);
            if self.settings.crossover && (is_solved || near <= NEARER * tried) {
                tried = near;
                let contacts = at.contacts(&self.search.scaled);
                let effort = if is_solved { Effort::THOROUGH } else { Effort::QUICK };
                let is_sure = near <= SURE;
                let held = HELD.into_iter().filter(|_| is_sure).map(Effort::held);
                let is_exact = std::iter::once(effort).chain(held).any(|effort| {
                    self.search.cross_over((&at.u, &forces), contacts.clone(), &effort)
                });
                if is_exact {
                    return Status::Solved;
                }
            }
            solved += usize::from(is_solved);
            if is_solved && (!self.settings.crossover || solved > MORE) {
                return Status::Solved;
            }
            if let Some(status) = self.monitor.stop(worst) {
                return if solved > 0 { Status::Solved } else { status };
            }
            let Search { scaled, condensed, .. } = &mut *self.search;
            let (next, alpha) = step(scaled, condensed, (&at, &defect), (0.0, WIDTH));
            step = advance;
            defect = Defect::of(scaled, &next, 0.0);
            let lack = defect.size();
            let merit = next.gap(scaled) + lack * lack;
            since = if merit < 0.9 * least { 0 } else { since + 1 };
            least = least.min(merit);
            if !next.is_finite() || alpha < NO_STEP || since > patience {
                // The residual is no guide where all of one side vanishes, which it is measured by.
                let contacts = at.contacts(&self.search.scaled);
                let is_exact = self.settings.crossover
                    && self.search.cross_over((&at.u, &forces), contacts, &Effort::THOROUGH);
                return if is_exact || solved > 0 { Status::Solved } else { Status::Stalled };
            }
            at = next;
        }
    }
}
