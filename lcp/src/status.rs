//! How a solve ended.

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
    /// [`Solution::certificate`](crate::Solution::certificate) proves.
    Infeasible,
    /// There is no solution: the linear conditions can be met, but not with one variable of every pair zero.
    /// [`Solution::certificate`](crate::Solution::certificate) proves it choice by choice.
    NoSolution,
    /// There is no equilibrium, by the evidence of [`Solution::certificate`](crate::Solution::certificate): soft springs on all
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
