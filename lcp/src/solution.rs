//! What a solver returns.

use crate::certify::{Ray, SoftSprings};
use crate::pivoting::{Attempt, PivotRecord};
use crate::{Basis, Certificate, ContactState, Method, Residuals, Status};

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
