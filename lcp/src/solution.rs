//! What a solver returns.

/// Outcome of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Status {
    /// The residuals, recomputed from the original data, are below the tolerance.
    Solved,
    /// The best point found satisfies the conditions only to a looser tolerance.
    AlmostSolved,
    /// Every attempt ended on a secondary ray: this does not prove that there is no solution.
    RayTermination,
    /// The limit on pivots was reached.
    PivotLimit,
    /// Rounding errors could not be brought under control.
    NumericalTrouble,
}

/// The one measure of a point `(t, y)`: dimensionless, from the original data.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Residuals {
    /// Largest row-wise relative residual of `A t + B y = c`.
    pub equation: f64,
    /// Most negative component of `t` and of `y`, each relative to its largest component.
    pub feasibility: f64,
    /// Largest `min(t_i / max t, y_i / max y)`.
    pub complementarity: f64,
    /// Largest of the three.
    pub natural: f64,
}
