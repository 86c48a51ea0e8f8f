//! Problems that are solved one after the other, each from the states and in the memory of the one before.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use web_time::Instant;

use crate::certify::Couplings;
use crate::matrix::Column;
use crate::newton::{FreePoint, PATIENCE, System};
use crate::scaling::equilibrate;
use crate::solve::is_over;
use crate::vector::check_length;
use crate::{
    Auto, AutoSettings, Basis, Error, Info, Iteration, Lcp, Method, Observer, Residuals, Side,
    Solution, Solver, Status, WarmStart,
};

/// Solves `w = M z + q` for one `q` after the other, each from the free set of the solution before.
///
/// Steps of a simulation differ little: `z` that were positive mostly stay positive. As long as these `z` do, a solve
/// reuses the factors of their matrix from the solve before. If signs are wrong, all pairs with a wrong sign change
/// sides as in [`SemismoothNewton`](crate::SemismoothNewton), with a factorisation each time. If these exchanges do not
/// end, [`Auto`] solves the problem. If `M` is dense, solves after the first allocate nothing, except by [`Auto`].
///
/// Pairs have keys. If contacts come and go, [`renew`](Self::renew) takes the new problem, in which pairs that stay keep
/// their states; new ones begin with `z = 0`. The three pairs of a contact of [`Friction2d`](crate::Friction2d) have keys
/// such as `(contact, 0)` to `(contact, 2)`.
///
/// # Residuals
/// The residuals are upper bounds of those of [`Lcp::residuals`]: rows that matter to no load count like all others,
/// and the largest part of a row that rounding may hide is added. If a bound is too large, [`Auto`] solves the problem
/// again.
///
/// ```
/// use lcp::{AutoSettings, Lcp, Sequence};
/// // Two boxes on a floor, pressed down and then lifted on one side.
/// let lcp = Lcp::new([[2.0, 1.0], [1.0, 2.0]], [-3.0, -3.0])?;
/// let mut sequence = Sequence::new(lcp, &["left", "right"], AutoSettings::default())?;
/// let is = |z: &[f64], exact: [f64; 2]| z.iter().zip(exact).all(|(z, it)| (z - it).abs() < 1e-15);
/// assert!(is(&sequence.solve(&[-3.0, -3.0])?.t, [1.0, 1.0]));
/// assert!(is(&sequence.solve(&[-3.0, 1.0])?.t, [1.5, 0.0]));
/// // The left one leaves, and a third one comes.
/// let lcp = Lcp::new([[2.0, 0.0], [0.0, 4.0]], [1.0, -4.0])?;
/// sequence.renew(lcp, &["right", "third"])?;
/// assert!(is(&sequence.solve(&[1.0, -4.0])?.t, [0.0, 1.0]));
/// # Ok::<(), lcp::Error>(())
/// ```
pub struct Sequence<K> {
    settings: AutoSettings,
    keys: Vec<K>,
    lcp: Lcp,
    couplings: Couplings,
    system: System,
    point: FreePoint,
    memory: FreePoint,
    solution: Solution<Lcp>,
}

impl<K: Ord + Clone> Sequence<K> {
    /// A sequence that begins with a problem, with one key for every pair; there are no free pairs. The start of the
    /// settings is used in the first solve by [`Auto`].
    ///
    /// # Errors
    /// [`Error::Length`] for another number of keys, and the errors of [`AutoSettings::validate`].
    pub fn new(lcp: Lcp, keys: &[K], settings: AutoSettings) -> Result<Self, Error> {
        let n = lcp.order();
        check_length("keys", keys.len(), n)?;
        settings.validate(n)?;
        let columns: Vec<Column<'_>> = (0..n).map(|j| lcp.m().slice(j)).collect();
        let (row, col) = equilibrate(n, &columns);
        let couplings = Couplings::of(&columns, &row, &col);
        let (nowhere, tolerance) = (vec![0.0; n], settings.tolerance);
        let residuals = Residuals::infinite();
        let none =
            Solution::judged(nowhere.clone(), nowhere, residuals, tolerance, Status::Stalled);
        Ok(Self {
            settings,
            keys: keys.to_vec(),
            couplings,
            system: System::new(lcp.m()),
            point: FreePoint::of(vec![false; n]),
            memory: FreePoint::default(),
            solution: none.of(),
            lcp,
        })
    }

    /// Continues with another problem, with one key for every pair. Pairs of the problem before keep their states.
    ///
    /// # Errors
    /// [`Error::Length`] for another number of keys; the sequence is then unchanged.
    pub fn renew(&mut self, lcp: Lcp, keys: &[K]) -> Result<(), Error> {
        let states: BTreeMap<&K, &bool> = self.keys.iter().zip(&self.point.is_free).collect();
        let is_free = keys.iter().map(|key| states.get(key).is_some_and(|is_free| **is_free));
        let point = FreePoint::of(is_free.collect());
        let start = WarmStart::Basis(Basis::new(sides(&point).collect()));
        let settings = AutoSettings { start, ..self.settings.clone() };
        *self = Self { point, ..Self::new(lcp, keys, settings)? };
        Ok(())
    }

    /// The problem, with the last `q`.
    pub fn problem(&self) -> &Lcp {
        &self.lcp
    }

    /// Solves the problem for this `q`.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`] for `q`.
    pub fn solve(&mut self, q: &[f64]) -> Result<&Solution<Lcp>, Error> {
        self.solve_observed(q, &mut |_| ControlFlow::Continue(()))
    }

    /// Solves the problem for this `q`, calling the observer before every factorisation except the first, and before
    /// every iteration of [`Auto`]. `Break` stops with [`Status::Cancelled`], unless the point at hand is a solution;
    /// the next solve begins at that point. While pairs change sides, the residual is the most negative variable, in
    /// units of the largest of its vector.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`] for `q`.
    pub fn solve_observed(
        &mut self,
        q: &[f64],
        observer: &mut Observer<'_>,
    ) -> Result<&Solution<Lcp>, Error> {
        self.lcp.set_q(q)?;
        let mut is_cancelled = false;
        let observer = &mut |at: &Iteration| {
            is_cancelled = is_cancelled || observer(at).is_break();
            if is_cancelled { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let (began, before) = (Instant::now(), self.system.factorisations());
        let deadline = self.settings.time_limit.map(|limit| began + limit);
        let Some(iterations) = self.exchange(deadline, observer) else {
            return self.anew(began, observer);
        };
        let residuals = self.point.residuals(&self.lcp, &self.couplings, &mut self.memory);
        let verdict = residuals.verdict(self.settings.tolerance, Status::Stalled);
        if verdict != Status::Solved {
            return self.anew(began, observer);
        }
        let Self { system, point, solution, .. } = self;
        let Solution { status, t, y, basis, info, certificate, condition, .. } = solution;
        (*status, *certificate, *condition) = (verdict, None, None);
        t.clone_from(&point.z);
        y.clone_from(&point.w);
        match basis {
            Some(basis) => basis.set(sides(point)),
            None => *basis = Some(Basis::new(sides(point).collect())),
        }
        let factorisations = system.factorisations() - before;
        let (method, seconds) = (Method::Newton, began.elapsed().as_secs_f64());
        *info = Info { method, iterations, factorisations, seconds, ..Info::default() };
        solution.residuals = residuals;
        Ok(solution)
    }

    /// Exchanges pairs of the wrong sign until there are none, and returns the number of exchanges. `None` if the
    /// number of such pairs does not decrease, a matrix is singular, the time limit is reached, or the observer stops
    /// the solve.
    fn exchange(
        &mut self,
        deadline: Option<Instant>,
        observer: &mut Observer<'_>,
    ) -> Option<usize> {
        let Self { lcp, system, point, .. } = self;
        let (mut fewest, mut since, mut exchanges) = (usize::MAX, 0, 0);
        while since <= PATIENCE && !is_over(deadline) && system.solve(lcp, point) {
            let wrong = point.violated.len();
            if wrong == 0 {
                return Some(exchanges);
            }
            let (iteration, residual, method) = (exchanges, point.residual, Method::Newton);
            let at = Iteration { iteration, residual, method, step: None };
            if observer(&at).is_break() {
                return None;
            }
            since = if wrong < fewest { 0 } else { since + 1 };
            fewest = fewest.min(wrong);
            point.exchange(wrong);
            exchanges += 1;
        }
        None
    }

    /// The solution by [`Auto`] in the time left, and its states.
    fn anew(
        &mut self,
        began: Instant,
        observer: &mut Observer<'_>,
    ) -> Result<&Solution<Lcp>, Error> {
        if let Some(basis) = self.solution.basis.take() {
            self.settings.start = WarmStart::Basis(basis);
        }
        let time_limit = self.settings.time_limit.map(|it| it.saturating_sub(began.elapsed()));
        let settings = AutoSettings { time_limit, ..self.settings.clone() };
        self.solution = Auto::new(settings).solve_observed(&self.lcp, observer)?;
        let Solution { t, y, basis, .. } = &self.solution;
        let basis = basis.clone().unwrap_or_else(|| Basis::of_larger(t, y));
        self.point.is_free = basis.sides().iter().map(|side| *side == Side::T).collect();
        Ok(&self.solution)
    }
}

/// The basic sides of a point.
fn sides(point: &FreePoint) -> impl Iterator<Item = Side> {
    point.is_free.iter().map(|is_free| if *is_free { Side::T } else { Side::Y })
}
