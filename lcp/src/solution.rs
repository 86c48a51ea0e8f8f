//! Answers of solvers.

use std::marker::PhantomData;

use derive_where::derive_where;

use crate::certify::Ray;
use crate::pivoting::{Attempt, PivotRecord};
use crate::{Basis, Certificate, ContactState, HorizontalLcp, Method, Residuals, Status};

/// The ending of a method that [`Auto`](crate::Auto) ran.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum RunEnd {
    /// The method ended with a status.
    Ended {
        /// Its status.
        status: Status,
        /// The worst of its residuals.
        #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
        residual: f64,
    },
    /// The method does not treat the problem.
    Refused {
        /// The reason.
        reason: String,
    },
}

impl std::fmt::Display for RunEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ended { status, residual } => write!(f, "{status}, residual {residual:.1e}"),
            Self::Refused { reason } => write!(f, "refused: {reason}"),
        }
    }
}

/// A method that [`Auto`](crate::Auto) ran.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct MethodRun {
    /// The method.
    #[cfg_attr(feature = "serde", serde(rename = "solver"))]
    pub method: Method,
    /// The reason for its choice.
    pub reason: String,
    /// The ending of the method.
    pub end: RunEnd,
    /// Its pivots, as in [`Info::pivots`].
    #[cfg_attr(feature = "serde", serde(default))]
    pub pivots: usize,
    /// Its factorisations, as in [`Info::factorisations`].
    #[cfg_attr(feature = "serde", serde(default))]
    pub factorisations: usize,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}

/// The cost of a solve.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Info {
    /// The method that found the point.
    #[cfg_attr(feature = "serde", serde(rename = "solver"))]
    pub method: Method,
    /// Pivots over all attempts; for enumeration the exchanges of columns in its least squares problems.
    pub pivots: usize,
    /// Sweeps, steps, or programs of a method that has no pivots. `QuadraticProgram` counts programs, or re-centrings
    /// of soft springs, not the iterations within a program, which its `max_iterations` limits.
    pub iterations: usize,
    /// Numeric factorisations of a matrix, or tableaus rebuilt from the data.
    pub factorisations: usize,
    /// Every attempt of a pivoting method, in order.
    pub attempts: Vec<Attempt>,
    /// The residual that controls an iterative method, at its start and after every iteration.
    #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinities"))]
    pub history: Vec<f64>,
    /// The methods that [`Auto`](crate::Auto) ran, in order. The point and the other numbers here, except for the time,
    /// come from one of them. If the problem has independent parts, `runs` has the methods of all parts, the other
    /// numbers are sums, and [`method`](Self::method) is that of the largest part.
    pub runs: Vec<MethodRun>,
    /// Wall-clock time \[s\].
    pub seconds: f64,
    /// The part of `seconds` spent on pivots; the rest of a pivoting method is start bases, scaling, final solves and
    /// proofs \[s\].
    pub pivot_seconds: f64,
}

impl Info {
    /// Adds the work of another solve, and moves its attempts here.
    pub(crate) fn add_work(&mut self, other: &mut Self) {
        self.pivots += other.pivots;
        self.iterations += other.iterations;
        self.factorisations += other.factorisations;
        self.pivot_seconds += other.pivot_seconds;
        self.attempts.append(&mut other.attempts);
    }
}

/// The result of a solver for a problem of type `P`, always with the residuals of its point.
///
/// The pairs are those of the general form of the problem: `problem.variables(&solution)` returns the answer in the
/// variables of the problem, and takes no solution of a problem of another type.
///
/// ```compile_fail
/// use lcp::{Auto, BoxedLcp, Lcp, Solver};
/// let lcp = Lcp::new([[1.0]], [-1.0])?;
/// let boxed = BoxedLcp::new([[1.0]], [-1.0], [0.0], [0.5])?;
/// let solution = Auto::default().solve(&boxed)?;
/// let (z, w) = lcp.variables(&solution); // a solution of `boxed`
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive_where(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(bound = ""))]
#[non_exhaustive]
pub struct Solution<P = HorizontalLcp> {
    /// The outcome.
    pub status: Status,
    /// The first variable of every pair.
    pub t: Vec<f64>,
    /// The second variable of every pair.
    pub y: Vec<f64>,
    /// The point of a [`Contact2d`](crate::Contact2d) by its displacements and forces, with all their digits: the
    /// residuals are those of this state. The pairs, with `mu t_n + t_t` and `mu t_n - t_t`, lose some digits if `mu`
    /// is large.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub contact: Option<ContactState>,
    /// The point of a [`BoxedLcp`](crate::BoxedLcp) by its variables `(z, w)`, if the pairs do not have all their
    /// digits: the distances to very distant bounds have no correct digit.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub boxed: Option<(Vec<f64>, Vec<f64>)>,
    /// The complementary basis of the point, for methods that end on one: Lemke's method, active sets, and the
    /// interior-point method after a crossover.
    pub basis: Option<Basis>,
    /// Residuals from the original data: of `contact` or `boxed` if there is one, else of `(t, y)`.
    pub residuals: Residuals,
    /// The proof, checked against the given data, if the status is [`Infeasible`](Status::Infeasible) or
    /// [`NoSolution`](Status::NoSolution). If the status is [`RayTermination`](Status::RayTermination), the ray of the
    /// first attempt with an artificial variable that ended on a ray. The certificate refers to the rows and pairs of
    /// the general form of the problem.
    pub certificate: Option<Certificate>,
    /// Estimate of the condition number, in the 1-norm, of the equilibrated matrix of the basis.
    pub condition: Option<f64>,
    /// Every pivot, if the settings request it.
    pub trace: Vec<PivotRecord>,
    /// The cost.
    pub info: Info,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) problem: PhantomData<fn() -> P>,
}

impl Solution {
    /// A point judged by residuals: [`Solved`](Status::Solved) if they are below the tolerance, else the status of the
    /// method. A point that is not finite, as found if a coefficient has no inverse in floating point, is replaced by
    /// zero; its residuals are infinite.
    pub(crate) fn judged(
        mut t: Vec<f64>,
        mut y: Vec<f64>,
        residuals: Residuals,
        tolerance: f64,
        otherwise: Status,
    ) -> Self {
        if t.iter().chain(&y).any(|it| !it.is_finite()) {
            t.fill(0.0);
            y.fill(0.0);
        }
        Self {
            status: residuals.verdict(tolerance, otherwise),
            t,
            y,
            basis: None,
            residuals,
            contact: None,
            boxed: None,
            certificate: None,
            condition: None,
            trace: Vec::new(),
            info: Info::default(),
            problem: PhantomData,
        }
    }

    /// Judges the point by the residuals of the given problem, if a method solved another form of the problem. A status
    /// that does not depend on the point, such as a limit, a proof or a ray, stays.
    pub fn judge_again(&mut self, residuals: Residuals, tolerance: f64) {
        self.residuals = residuals;
        let is_of_point =
            matches!(self.status, Status::Solved | Status::AlmostSolved | Status::NumericalTrouble);
        if is_of_point {
            self.status = residuals.verdict(tolerance, Status::AlmostSolved);
        }
    }

    /// The answer with a checked proof, whose status replaces that of the point.
    pub(crate) fn proved(self, proof: Certificate) -> Self {
        let status = match proof {
            Certificate::Farkas { .. } => Status::Infeasible,
            Certificate::Choices { .. } => Status::NoSolution,
            Certificate::Ray(_) => Status::RayTermination,
        };
        Self { status, certificate: Some(proof), ..self }
    }
}

impl<P> Solution<P> {
    /// The Farkas vector of the certificate, if the certificate is one.
    pub fn farkas(&self) -> Option<&[f64]> {
        match &self.certificate {
            Some(Certificate::Farkas { pi }) => Some(pi),
            _ => None,
        }
    }

    /// The secondary ray of the certificate, if the certificate is one.
    pub fn ray(&self) -> Option<&Ray> {
        match &self.certificate {
            Some(Certificate::Ray(ray)) => Some(ray),
            _ => None,
        }
    }

    /// The solution as one of the general form of the problem, with the same pairs.
    pub fn of_pairs(self) -> Solution {
        self.of()
    }

    /// The solution as one of a problem with this general form.
    pub(crate) fn of<Q>(self) -> Solution<Q> {
        Solution {
            status: self.status,
            t: self.t,
            y: self.y,
            contact: self.contact,
            boxed: self.boxed,
            basis: self.basis,
            residuals: self.residuals,
            certificate: self.certificate,
            condition: self.condition,
            trace: self.trace,
            info: self.info,
            problem: PhantomData,
        }
    }

    /// Whether the status is [`Status::Solved`].
    pub fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }

    /// The solution if the status is [`Status::Solved`], for callers to whom every other status is an error.
    ///
    /// ```
    /// use lcp::{Auto, Lcp, Solver, Status};
    /// fn largest(q: [f64; 2]) -> Result<f64, Box<dyn std::error::Error>> {
    ///     let lcp = Lcp::new([[2.0, 1.0], [1.0, 2.0]], q)?;
    ///     let solution = Auto::default().solve(&lcp)?.into_result()?;
    ///     Ok(solution.t[0].max(solution.t[1]))
    /// }
    /// assert!((largest([-5.0, -4.0])? - 2.0).abs() < 1e-15);
    /// let none = Lcp::new([[-1.0]], [-1.0])?;
    /// let unsolved = Auto::default().solve(&none)?.into_result().unwrap_err();
    /// assert_eq!(unsolved.solution.status, Status::Infeasible);
    /// assert!(unsolved.to_string().starts_with("the problem is not solved: Infeasible"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Unsolved`] with the whole answer, if the status is not [`Status::Solved`].
    pub fn into_result(self) -> Result<Self, Unsolved> {
        if self.is_solved() {
            Ok(self)
        } else {
            Err(Unsolved { solution: Box::new(self.of_pairs()) })
        }
    }
}

/// A status other than `Solved`, as an error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the problem is not solved: {}, residual {:.1e}", .solution.status, .solution.residuals.worst())]
pub struct Unsolved {
    /// The answer: the best point, and the proof that there is no solution, if one was found.
    pub solution: Box<Solution>,
}
