//! What a solver returns.

use crate::pivoting::{Attempt, PivotRecord};
use crate::{Basis, Certificate, ContactState, Method, Residuals};

/// Outcome of a solve. Decided by the mathematics and the limits, never by misuse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Status {
    /// The residuals, recomputed from the original data, are below the tolerance.
    Solved,
    /// A complementary basis was found, but its residuals, recomputed from the original data, are
    /// above the tolerance asked for, and below the square root of it, also when the equation is
    /// measured by the right-hand side alone. Of a problem that was solved in another form: it is solved
    /// there, but the residuals in the form given are above the tolerance.
    AlmostSolved,
    /// There is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`, which
    /// [`Solution::certificate`] proves.
    Infeasible,
    /// There is no solution: the linear conditions can be met, but not with one variable of every pair zero.
    /// [`Solution::certificate`] proves it choice by choice.
    NoSolution,
    /// There is no equilibrium, by the evidence of [`Solution::certificate`]: soft springs on all
    /// displacements keep their share of the load, however soft they are. Where a body is rigid, or without
    /// friction, it was also checked that no forces balance the loads. Of elastic bodies with friction it
    /// is no proof.
    NoEquilibrium,
    /// No attempt found a solution, and at least one ended on a secondary ray. This does not prove
    /// that there is none.
    RayTermination,
    /// The limit on pivots was reached.
    PivotLimit,
    /// The limit on iterations was reached.
    IterationLimit,
    /// The residuals stopped decreasing above the tolerance, or the method cannot go on from where it
    /// is. Another method may.
    Stalled,
    /// The limit on wall-clock time was reached.
    TimeLimit,
    /// No attempt found a solution, and in at least one a basis came back; or the single exchanges of an
    /// active set method did.
    Cycling,
    /// No choice of one column from every pair gives a matrix that is nonsingular to working
    /// precision, so that there is no complementary basis to start from, and with artificial columns
    /// no solution was found either. For sparse problems of order above 2000: the solver found no such
    /// choice, which does not exclude that there is one. Then a start basis should be given.
    NoComplementaryBasis,
    /// Rounding errors could not be brought under control.
    NumericalTrouble,
    /// The observer asked to stop.
    Cancelled,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Debug::fmt(self, f)
    }
}

/// The secondary ray on which an attempt ended.
///
/// `A dt + B dy = covering dz0` with `dt, dy, dz0 >= 0` and `dt.dy = 0`: for every `s >= 0` the last
/// point of the attempt plus `s (dt, dy, dz0)` satisfies `A t + B y = c + covering z0`, so that along
/// the ray the artificial variable `z0` does not decrease.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Ray {
    /// Direction in `t`.
    pub dt: Vec<f64>,
    /// Direction in `y`.
    pub dy: Vec<f64>,
    /// Rate of the artificial variable.
    pub dz0: f64,
    /// The covering vector in the rows of the problem.
    pub covering: Vec<f64>,
}

/// What soft springs on all displacements of a contact problem carry when they are made softer and softer.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SoftSprings {
    /// The stiffnesses, relative to that of the bodies.
    pub stiffness: Vec<f64>,
    /// The share of the load that the springs of each stiffness carry: it tends to zero like the
    /// stiffness where there is an equilibrium, and to a constant where there is none.
    pub shares: Vec<f64>,
    /// The displacements with the softest springs: the mechanism, as large as the springs let it become.
    pub motion: Vec<f64>,
}

/// How a method that [`Auto`](crate::Auto) asked ended.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum RouteEnd {
    /// With an answer.
    Ended {
        /// Its status.
        status: Status,
        /// The worst of its residuals.
        #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinity"))]
        residual: f64,
    },
    /// It does not treat the problem.
    Refused {
        /// What is in the way.
        reason: String,
    },
}

impl std::fmt::Display for RouteEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ended { status, residual } => write!(f, "{status}, residual {residual:.1e}"),
            Self::Refused { reason } => write!(f, "refused: {reason}"),
        }
    }
}

/// A method that [`Auto`](crate::Auto) asked.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Route {
    /// The method.
    #[cfg_attr(feature = "serde", serde(rename = "solver"))]
    pub method: Method,
    /// Why it was its turn.
    pub reason: String,
    /// How it ended.
    pub end: RouteEnd,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}

/// What it cost.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Info {
    /// The method that the point comes from.
    #[cfg_attr(feature = "serde", serde(rename = "solver"))]
    pub method: Method,
    /// Pivots over all attempts.
    pub pivots: usize,
    /// Sweeps, steps, or programs of a method that has no pivots. Of `QuadraticProgram` they are programs, or
    /// times that soft springs were centred, and not the iterations within a program that its
    /// `max_iterations` limits.
    pub iterations: usize,
    /// Times that a matrix was factorised numerically, or a tableau rebuilt from the data.
    pub factorisations: usize,
    /// Every attempt of a pivoting method, in order.
    pub attempts: Vec<Attempt>,
    /// The residual by which an iterative method stops, at its start and after every iteration.
    #[cfg_attr(feature = "serde", serde(with = "crate::wire::infinities"))]
    pub history: Vec<f64>,
    /// The methods that [`Auto`](crate::Auto) asked, in order; the point comes from one of them, and so do
    /// the other numbers here but for the time. Of a problem that fell into independent parts they are of all parts,
    /// the other numbers their sums, and [`method`](Self::method) is that of the largest.
    pub routes: Vec<Route>,
    /// Wall-clock time \[s\].
    pub seconds: f64,
    /// The part of it spent on pivots; the rest of a pivoting method is start bases, scaling, final
    /// solves and proofs \[s\].
    pub pivot_seconds: f64,
}

/// The answer of a solver: always with the residuals of the point that it carries.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Solution {
    /// What the solver found.
    pub status: Status,
    /// The first variable of every pair.
    pub t: Vec<f64>,
    /// The second variable of every pair.
    pub y: Vec<f64>,
    /// The point of a [`Contact2d`](crate::Contact2d) by its displacements and forces, with all their digits: the
    /// residuals are those of this state. The pairs, with `mu t_n + t_t` and `mu t_n - t_t`, lose some where
    /// `mu` is large.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub contact: Option<ContactState>,
    /// The point of a [`BoxedLcp`](crate::BoxedLcp) by its variables `(z, w)`, where the pairs do not have all their
    /// digits: with bounds far away the distances to these have none left.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub boxed: Option<(Vec<f64>, Vec<f64>)>,
    /// The complementary basis of the point, of methods that end on one: of pivots, of active sets, and of
    /// interior points after a crossover.
    pub basis: Option<Basis>,
    /// Residuals of `(t, y)`, from the original data.
    pub residuals: Residuals,
    /// With the statuses [`Infeasible`](Status::Infeasible) and [`NoSolution`](Status::NoSolution) the proof, checked
    /// against the data as given; with [`NoEquilibrium`](Status::NoEquilibrium) the evidence of soft springs; with
    /// [`RayTermination`](Status::RayTermination) the ray on which the first of the attempts with an artificial
    /// variable, proximal ones aside, that met one ended. It refers to the general form of the problem, whose
    /// rows and pairs it has.
    pub certificate: Option<Certificate>,
    /// Estimate of the condition number, in the 1-norm, of the equilibrated matrix of the basis.
    pub condition: Option<f64>,
    /// Every pivot, if the settings asked for it.
    pub trace: Vec<PivotRecord>,
    /// What it cost.
    pub info: Info,
}

impl Solution {
    /// A point that is judged by residuals: [`Solved`](Status::Solved) where they are below the
    /// tolerance, else what the method says.
    pub(crate) fn judged(
        (t, y): (Vec<f64>, Vec<f64>),
        residuals: Residuals,
        tolerance: f64,
        otherwise: Status,
    ) -> Self {
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
        }
    }

    /// The Farkas vector of the certificate, if it is one.
    pub fn farkas(&self) -> Option<&[f64]> {
        match &self.certificate {
            Some(Certificate::Farkas { pi }) => Some(pi),
            _ => None,
        }
    }

    /// The secondary ray of the certificate, if it is one.
    pub fn ray(&self) -> Option<&Ray> {
        match &self.certificate {
            Some(Certificate::Ray(ray)) => Some(ray),
            _ => None,
        }
    }

    /// The soft springs of the certificate, if it is these.
    pub fn springs(&self) -> Option<&SoftSprings> {
        match &self.certificate {
            Some(Certificate::Springs(springs)) => Some(springs),
            _ => None,
        }
    }

    /// Whether the status is [`Status::Solved`].
    pub fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }
}
