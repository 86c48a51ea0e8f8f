//! What a solver returns.

use crate::Basis;

/// Outcome of a solve. Decided by the mathematics and the limits, never by misuse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Status {
    /// The residuals, recomputed from the original data, are below the tolerance.
    Solved,
    /// A complementary basis was found, but its residuals, recomputed from the original data, are
    /// above the tolerance asked for (and below the square root of it).
    AlmostSolved,
    /// No attempt found a solution, and at least one ended on a secondary ray. This does not prove
    /// that there is none.
    RayTermination,
    /// The limit on pivots was reached.
    PivotLimit,
    /// No attempt found a solution, and in at least one a basis came back.
    Cycling,
    /// No choice of one column from every pair gives a matrix that is nonsingular to working
    /// precision, so that there is no complementary basis to start from.
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

/// The one measure of a point `(t, y)`: dimensionless, from the original data.
///
/// See [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals) for the definitions.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Residuals {
    /// Largest row-wise relative residual of `A t + B y = c`.
    pub equation: f64,
    /// Most negative component of `t` and of `y`, each relative to the largest of its vector.
    pub feasibility: f64,
    /// Largest `min(t_i / max t, y_i / max y)` over the pairs.
    pub complementarity: f64,
    /// Largest `|min(t_i / max t, y_i / max y)|`: feasibility and complementarity in one number.
    pub natural: f64,
}

impl Residuals {
    /// The largest of the residuals.
    pub fn worst(&self) -> f64 {
        self.equation.max(self.feasibility).max(self.complementarity)
    }
}

/// The secondary ray on which an attempt ended.
///
/// `A dt + B dy = covering dz0` with `dt, dy, dz0 >= 0` and `dt.dy = 0`: for every `s >= 0` the last
/// point of the attempt plus `s (dt, dy, dz0)` satisfies `A t + B y = c + covering z0`, so that along
/// the ray the artificial variable `z0` does not decrease.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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

/// How one attempt of a pivoting method ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum AttemptEnd {
    /// The artificial variable left the basis.
    Complementary,
    /// No basic variable blocks the entering one.
    Ray,
    /// The limit on pivots was reached.
    PivotLimit,
    /// A basis came back.
    Cycle,
    /// The basis became singular to working precision.
    Singular,
    /// The observer asked to stop.
    Cancelled,
}

/// One attempt: where it started, with which covering vector, and how it ended.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Attempt {
    /// The start basis, in words.
    pub start: String,
    /// The covering vector, in words.
    pub covering: String,
    /// Whether the right-hand side was perturbed to part ties.
    pub perturbed: bool,
    /// How the attempt ended.
    pub end: AttemptEnd,
    /// Pivots that it took.
    pub pivots: usize,
    /// The worst residual of its complementary basis, where it ended on one that could be solved.
    pub residual: Option<f64>,
}

/// What it cost.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Info {
    /// Pivots over all attempts.
    pub pivots: usize,
    /// Times that the tableau was rebuilt from the data.
    pub refactorisations: usize,
    /// Every attempt, in order.
    pub attempts: Vec<Attempt>,
    /// Wall-clock time \[s\].
    pub seconds: f64,
}

/// The answer of a solver: always with the residuals of the point that it carries.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Solution {
    /// What the solver found.
    pub status: Status,
    /// The first variable of every pair.
    pub t: Vec<f64>,
    /// The second variable of every pair.
    pub y: Vec<f64>,
    /// The complementary basis of the point, where there is one.
    pub basis: Option<Basis>,
    /// Residuals of `(t, y)`, from the original data.
    pub residuals: Residuals,
    /// The ray on which the first of the attempts that met one ended, when the status is
    /// [`RayTermination`](Status::RayTermination).
    pub ray: Option<Ray>,
    /// What it cost.
    pub info: Info,
}

impl Solution {
    /// Whether the status is [`Status::Solved`].
    pub fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }
}
