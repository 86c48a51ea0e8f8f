//! The parts that all solvers have in common.

use std::ops::ControlFlow;
use web_time::{Duration, Instant};

use crate::parallel::for_each;
use crate::{Error, Info, Method, Solution, Status};

/// The name of the method of a solver, whatever problems the solver treats.
pub trait Named {
    /// The method.
    fn method(&self) -> Method;
}

/// The name of a solver, and its settings.
macro_rules! named {
    ($solver:ident, $settings:ty, $method:expr) => {
        impl $crate::Named for $solver {
            fn method(&self) -> $crate::Method {
                $method
            }
        }

        impl $solver {
            /// A solver with these settings.
            pub fn new(settings: $settings) -> Self {
                Self { settings }
            }

            /// The settings.
            pub fn settings(&self) -> &$settings {
                &self.settings
            }
        }
    };
}

pub(crate) use named;

/// A method that treats problems of type `P`.
///
/// The solution carries a point of the general form of the problem: `(z, w)` as `(t, y)` for [`Lcp`](crate::Lcp)
/// and, of the standard problem, for [`Friction2d`](crate::Friction2d); and the pairs of `to_general` for
/// [`Contact2d`](crate::Contact2d::to_general), [`MixedLcp`](crate::MixedLcp::to_general) and
/// [`BoxedLcp`](crate::BoxedLcp::to_general), whose `recover` converts back.
///
/// ```
/// use faer::mat;
/// use lcp::{Lcp, Lemke, ProjectedGaussSeidel, SemismoothNewton, Solver};
/// let methods: [Box<dyn Solver<Lcp>>; 3] = [
///     Box::new(Lemke::default()),
///     Box::new(SemismoothNewton::default()),
///     Box::new(ProjectedGaussSeidel::default()),
/// ];
/// let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
/// for method in methods {
///     assert!(method.solve(&lcp)?.is_solved(), "{}", method.method());
/// }
/// # Ok::<(), lcp::Error>(())
/// ```
pub trait Solver<P>: Named {
    /// Solves a problem for the pairs of its general form. Methods implement this function, and
    /// [`solve_observed`](Self::solve_observed) returns its result as a solution of the problem.
    ///
    /// # Errors
    /// As for [`solve_observed`](Self::solve_observed).
    fn solve_pairs(&self, problem: &P, observer: &mut Observer<'_>) -> Result<Solution, Error>;

    /// Solves a problem, calling the observer before every sweep, step, program or pivot; `Break` stops with
    /// [`Status::Cancelled`], unless the point at hand is a solution.
    ///
    /// # Errors
    /// [`Error::NotTreated`] for a problem that the method cannot treat, and errors of the settings.
    /// Mathematical outcomes are in [`Solution::status`].
    fn solve_observed(
        &self,
        problem: &P,
        observer: &mut Observer<'_>,
    ) -> Result<Solution<P>, Error> {
        self.solve_pairs(problem, observer).map(Solution::of)
    }

    /// Solves a problem.
    ///
    /// # Errors
    /// As for [`solve_observed`](Self::solve_observed).
    fn solve(&self, problem: &P) -> Result<Solution<P>, Error> {
        self.solve_observed(problem, &mut |_| ControlFlow::Continue(()))
    }

    /// Solves many problems on all cores. The answers are those of [`solve`](Self::solve), in the order of the problems.
    ///
    /// ```
    /// use lcp::{Auto, Lcp, Solver};
    /// let problems = (1..=100).map(|k| Lcp::new([[2.0, 1.0], [1.0, 2.0]], [-f64::from(k), -1.0]));
    /// let problems = problems.collect::<Result<Vec<_>, _>>()?;
    /// let answers = Auto::default().solve_all(&problems);
    /// assert_eq!(answers.len(), 100);
    /// for (problem, answer) in problems.iter().zip(answers) {
    ///     assert_eq!(answer?.t, Auto::default().solve(problem)?.t);
    /// }
    /// # Ok::<(), lcp::Error>(())
    /// ```
    fn solve_all(&self, problems: &[P]) -> Vec<Result<Solution<P>, Error>>
    where
        Self: Sized + Sync,
        P: Sync,
    {
        let mut answers: Vec<_> = problems.iter().map(|_| None).collect();
        for_each(problems.iter().zip(&mut answers), |(problem, answer)| {
            *answer = Some(self.solve(problem));
        });
        answers.into_iter().flatten().collect()
    }
}

/// The progress of a method, for an observer.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Iteration {
    /// Number of sweeps, steps or programs; for [`Lemke`](crate::Lemke) the pivots of the attempt. The number begins at
    /// 0 for each attempt, and for each method of [`Auto`](crate::Auto).
    pub iteration: usize,
    /// The residual that controls the method. The path of [`Lemke`](crate::Lemke) has no residual; the number is then
    /// the artificial variable relative to its first value, which is zero at a solution
    /// ([`Progress::artificial`](crate::lemke::Progress::artificial)).
    pub residual: f64,
    /// The method; [`Auto`](crate::Auto) runs several one after the other.
    pub method: Method,
    /// The step of the interior-point method that led to this iteration; `None` at a start, for convex programs, which
    /// have an iteration of their own, and for other methods.
    pub step: Option<Step>,
}

/// A step of the interior-point method.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Step {
    /// The kind of its direction.
    pub kind: StepKind,
    /// The part of the step that was taken, up to one.
    pub length: f64,
    /// The mean product of the pairs after the step, in units of the scaled problem.
    pub mean_product: f64,
}

/// The kind of the direction of a step of the interior-point method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepKind {
    /// Predictor and correctors.
    Corrected,
    /// A mixture of the predictor and of centring.
    Mixed,
    /// Along the central path near a turn.
    Turn,
}

/// Called while a method runs; the result decides whether it continues.
pub type Observer<'a> = dyn FnMut(&Iteration) -> ControlFlow<()> + 'a;

/// The time at which a limit is reached; `None` also for a limit beyond the range of clocks.
pub(crate) fn deadline_of(began: Instant, time_limit: Option<Duration>) -> Option<Instant> {
    time_limit.and_then(|limit| began.checked_add(limit))
}

pub(crate) fn is_over(deadline: Option<Instant>) -> bool {
    deadline.is_some_and(|deadline| Instant::now() >= deadline)
}

/// Watches over the iterations of a method: limits, history, observer.
pub(crate) struct Monitor<'a> {
    method: Method,
    began: Instant,
    deadline: Option<Instant>,
    max_iterations: usize,
    observer: &'a mut Observer<'a>,
    /// Whether the observer has stopped the method; it is not called again.
    is_cancelled: bool,
    /// The residual at the start and after every iteration.
    pub(crate) history: Vec<f64>,
}

impl<'a> Monitor<'a> {
    pub(crate) fn new(
        method: Method,
        max_iterations: usize,
        time_limit: Option<Duration>,
        observer: &'a mut Observer<'a>,
    ) -> Self {
        let began = Instant::now();
        let deadline = deadline_of(began, time_limit);
        let (is_cancelled, history) = (false, Vec::new());
        Self { method, began, deadline, max_iterations, observer, is_cancelled, history }
    }

    /// Records the residual before an iteration; returns a status if the run has to end.
    pub(crate) fn stop(&mut self, residual: f64) -> Option<Status> {
        self.stop_after(residual, None)
    }

    /// Records the step before, too.
    pub(crate) fn stop_after(&mut self, residual: f64, step: Option<Step>) -> Option<Status> {
        let (iteration, method) = (self.history.len(), self.method);
        self.history.push(residual);
        let at = Iteration { iteration, residual, method, step };
        self.is_cancelled = self.is_cancelled || (self.observer)(&at).is_break();
        if self.is_cancelled {
            return Some(Status::Cancelled);
        }
        if iteration >= self.max_iterations {
            return Some(Status::IterationLimit);
        }
        is_over(self.deadline).then_some(Status::TimeLimit)
    }

    /// The time after which no iteration may begin.
    pub(crate) fn deadline(&self) -> Option<Instant> {
        self.deadline
    }

    pub(crate) fn iterations(&self) -> usize {
        self.history.len().saturating_sub(1)
    }

    pub(crate) fn seconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// The cost.
    pub(crate) fn info(self) -> Info {
        let (method, iterations, seconds) = (self.method, self.iterations(), self.seconds());
        Info { method, iterations, seconds, history: self.history, ..Info::default() }
    }
}
