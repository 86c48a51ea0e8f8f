//! A primal-dual active set method, which is a semismooth Newton method, with a safeguard.

mod exchange;
mod factors;
mod system;

use std::time::Duration;

use crate::conversion::solve_in_standard_form;
use crate::settings::check_tolerance;
use crate::solve::{Monitor, named};
use crate::{
    Basis, Error, HorizontalLcp, Lcp, Method, Observer, Residuals, Side, Solution, Solver, Status,
    WarmStart,
};
pub(crate) use exchange::PATIENCE;
use exchange::{Exchanges, Next};
pub(crate) use system::{FreePoint, System, is_z_matrix};

/// Settings of [`SemismoothNewton`].
///
/// ```
/// use lcp::{SemismoothNewton, SemismoothNewtonSettings};
/// let settings = SemismoothNewtonSettings { max_iterations: 50, ..Default::default() };
/// let solver = SemismoothNewton::new(settings);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct SemismoothNewtonSettings {
    /// Largest residual, dimensionless, of a solution with status `Solved`. In `(0, 1)`. Used only if signs cannot be
    /// distinguished from rounding errors: else the method ends when all signs are right.
    pub tolerance: f64,
    /// Limit on steps: exchanges of pairs between the sets, each followed by a factorisation.
    pub max_iterations: usize,
    /// Wall-clock time, checked before every step; `None` sets no limit.
    pub time_limit: Option<Duration>,
    /// The start, whose basic `z` are free at first. If the matrix of the free `z` is singular, the method uses its own
    /// start.
    pub start: WarmStart,
}

impl Default for SemismoothNewtonSettings {
    fn default() -> Self {
        Self { tolerance: 1e-10, max_iterations: 1000, time_limit: None, start: WarmStart::None }
    }
}

impl SemismoothNewtonSettings {
    /// Checks the settings for a problem of order `n`.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Length`] or [`Error::NotFinite`] with the name of the setting.
    pub fn validate(&self, n: usize) -> Result<(), Error> {
        check_tolerance(self.tolerance)?;
        self.start.validate(n)
    }
}

/// The primal-dual active set method for `w = M z + q`, `z >= 0`, `w >= 0`, `z.w = 0`.
///
/// One variable of every pair is zero. The method solves `M_FF z_F = -q_F` for the free `z`, computes the other `w`,
/// and exchanges all pairs whose variable is negative, until there is none. This is Newton's method for
/// `min(z, w) = 0`, which ends with the exact solution after finitely many steps. A symmetric positive definite `M_FF`
/// is factorised by Cholesky's method, any other one by LU, dense or sparse like `M`. Solves are followed by iterative
/// refinement.
///
/// While the number of negative variables does not decrease, fewer pairs are exchanged, down to single ones, until that number
/// reaches a new minimum (Júdice and Pires 1994, after Murty 1974).
///
/// * M-matrices (obstacle problems, no positive off-diagonal entry): converges from every start, monotonically after
///   the first step (Hintermüller, Ito and Kunisch 2003). The number of steps is about the number of layers of a grid
///   by which a start is wrong; `families::Obstacle` of the crate `lcp-problems` gives good starts by nested grids.
/// * Other matrices without positive off-diagonal entries: solves whenever the problem is feasible, if necessary by a
///   restart from the pairs with `q < 0` (Chandrasekaran 1970).
/// * P-matrices (for example positive definite ones): the safeguard makes it finite; in the worst case exponentially
///   many steps.
/// * Others with a positive diagonal: often solves, without a guarantee. Otherwise the status is
///   [`Cycling`](Status::Cycling), [`Stalled`](Status::Stalled) if every next matrix is singular, or one of the
///   limits.
/// * Refused: a diagonal entry that is not positive, and a general problem that cannot be converted to the standard
///   form ([`HorizontalLcp::to_standard`]).
///
/// # Cost
/// A step costs one factorisation of `M_FF`. Without a start the first free set has all pairs if `M` has no positive
/// off-diagonal entry, else those with `q < 0`.
///
/// References: Hintermüller, Ito, Kunisch, SIAM J. Optim. 13 (2003), doi:10.1137/S1052623401383558;
/// Júdice, Pires, Computers & Operations Research 21 (1994);
/// Murty, Linear Algebra and its Applications 9 (1974); Chandrasekaran, Opsearch 7 (1970).
///
/// ```
/// use faer::mat;
/// use lcp::{Lcp, SemismoothNewton, Solver};
/// let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
/// let solution = SemismoothNewton::default().solve(&lcp)?;
/// assert!(solution.is_solved());
/// assert!((solution.t[0] - 4.0 / 3.0).abs() < 1e-15);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SemismoothNewton {
    settings: SemismoothNewtonSettings,
}

named!(SemismoothNewton, SemismoothNewtonSettings, Method::Newton);

impl SemismoothNewton {
    /// The best point found, and the status if its residuals are not small.
    fn run(
        &self,
        lcp: &Lcp,
        system: &mut System,
        monitor: &mut Monitor<'_>,
    ) -> (Status, FreePoint) {
        let point = self.first_point(lcp, system);
        let (status, best) = self.iterate(lcp, system, point, monitor);
        let is_stuck = matches!(status, Status::Cycling | Status::Stalled);
        if !is_stuck || !system.is_z_matrix || best.residual <= self.settings.tolerance {
            return (status, best);
        }
        // The only start that solves every feasible problem with such a matrix.
        match system.point(lcp, pushed(lcp)) {
            Some(point) => {
                let (status, again) = self.iterate(lcp, system, point, monitor);
                (status, if again.residual < best.residual { again } else { best })
            }
            None => (status, best),
        }
    }

    fn iterate(
        &self,
        lcp: &Lcp,
        system: &mut System,
        mut point: FreePoint,
        monitor: &mut Monitor<'_>,
    ) -> (Status, FreePoint) {
        let mut best = point.clone();
        let mut exchanges = Exchanges::new(system.is_z_matrix);
        loop {
            if point.residual < best.residual {
                best.clone_from(&point);
            }
            let stopped = monitor.stop(point.residual);
            if point.violated.is_empty() {
                return (Status::NumericalTrouble, point);
            }
            if let Some(status) = stopped {
                return (status, best);
            }
            let is_within = best.residual <= self.settings.tolerance;
            let count = match exchanges.next(point.hash, point.violated.len()) {
                // The remaining signs cannot be distinguished from rounding errors.
                Next::Fewer(_) | Next::Cycle if is_within => return (Status::Stalled, best),
                Next::Exchange(count) | Next::Fewer(count) => count,
                Next::Cycle => return (Status::Cycling, best),
            };
            // If the exchange of all pairs makes the matrix singular, the exchange of fewer may not.
            let counts = std::iter::successors(Some(count), |count| Some(count / 2));
            let mut points = counts.take_while(|count| *count > 0);
            match points.find_map(|count| system.exchanged(lcp, &point, count)) {
                Some(next) => point = next,
                None => return (Status::Stalled, best),
            }
        }
    }

    fn first_point(&self, lcp: &Lcp, system: &mut System) -> FreePoint {
        let n = lcp.order();
        let given = match &self.settings.start {
            WarmStart::None => None,
            WarmStart::Basis(basis) => Some(basis.clone()),
            WarmStart::Point { t, y } => Some(Basis::of_larger(t, y)),
        };
        let given = given.map(|basis| basis.sides().iter().map(|side| *side == Side::T).collect());
        let all = system.is_z_matrix.then(|| vec![true; n]);
        let starts = given.into_iter().chain(all);
        let starts = starts.chain([pushed(lcp), vec![false; n]]);
        let mut points = starts.filter_map(|is_free| system.point(lcp, is_free));
        points.next().unwrap_or_else(|| unreachable!("without free variables nothing is solved"))
    }
}

/// The pairs whose `w` is negative at `z = 0`.
fn pushed(lcp: &Lcp) -> Vec<bool> {
    lcp.q().iter().map(|q| *q < 0.0).collect()
}

fn basis_of(is_free: &[bool]) -> Basis {
    Basis::new(is_free.iter().map(|&it| if it { Side::T } else { Side::Y }).collect())
}

fn check_diagonal(lcp: &Lcp) -> Result<(), Error> {
    let not_positive = |i: &usize| lcp.m()[(*i, *i)] <= 0.0;
    match (0..lcp.order()).find(not_positive) {
        None => Ok(()),
        Some(i) => Err(Error::NotTreated {
            method: Method::Newton,
            reason: format!(
                "M[{i}, {i}] is {}, but every diagonal entry must be positive: take Lemke",
                lcp.m()[(i, i)]
            ),
        }),
    }
}
impl Solver<Lcp> for SemismoothNewton {
    fn solve_pairs(&self, lcp: &Lcp, observer: &mut Observer<'_>) -> Result<Solution, Error> {
        let settings = &self.settings;
        settings.validate(lcp.order())?;
        check_diagonal(lcp)?;
        let mut monitor =
            Monitor::new(Method::Newton, settings.max_iterations, settings.time_limit, observer);
        let mut system = System::new(lcp.m());
        let (status, best) = self.run(lcp, &mut system, &mut monitor);
        let positive = |v: &[f64]| v.iter().map(|v| v.max(0.0)).collect();
        let clipped =
            |it: &FreePoint| FreePoint { z: positive(&it.z), w: positive(&it.w), ..it.clone() };
        let judged = |it: FreePoint| {
            let residuals = lcp.residuals(&it.z, &it.w);
            (it, residuals)
        };
        let is_solved = |residuals: &Residuals| residuals.worst() <= settings.tolerance;
        let (mut point, mut residuals) = judged(clipped(&best));
        if !is_solved(&residuals) {
            let clean = system.without_noise(lcp, &best).map(|clean| judged(clipped(&clean)));
            let clean = clean.filter(|(_, residuals)| is_solved(residuals));
            (point, residuals) = clean.unwrap_or_else(|| judged(best));
        }
        let mut solution =
            Solution::judged(point.z, point.w, residuals, settings.tolerance, status);
        solution.basis = Some(basis_of(&point.is_free));
        solution.info = monitor.info();
        solution.info.factorisations = system.factorisations();
        Ok(solution)
    }
}

/// Problems that can be converted to the standard form ([`HorizontalLcp::to_standard`]).
impl Solver<HorizontalLcp> for SemismoothNewton {
    fn solve_pairs(
        &self,
        problem: &HorizontalLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let settings = &self.settings;
        settings.validate(problem.order())?;
        let (start, tolerance) = (&settings.start, settings.tolerance);
        solve_in_standard_form(Method::Newton, problem, start, tolerance, |lcp, start| {
            let inner = Self::new(SemismoothNewtonSettings { start, ..settings.clone() });
            inner.solve_pairs(lcp, observer)
        })
    }
}
