//! How a solve ended.

/// Outcome of a solve: a mathematical result or a limit, never a mistake in the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Status {
    /// The residuals, recomputed from the original data, are below the tolerance.
    Solved,
    /// A complementary basis was found, but its residuals, recomputed from the original data, are above the tolerance
    /// and below its square root, also if the equation is measured by the right-hand side alone. For a problem that
    /// was solved in another form: it is solved there, but the residuals in the given form are above the tolerance.
    AlmostSolved,
    /// There is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`, which
    /// [`Solution::certificate`](crate::Solution::certificate) proves.
    Infeasible,
    /// There is no solution: the linear conditions can be met, but not together with complementarity.
    /// [`Solution::certificate`](crate::Solution::certificate) proves it choice by choice.
    NoSolution,
    /// Bodies in contact flow, or have left the displacements that the problem is for
    /// ([`Ending::status`](crate::Ending::status)). This is evidence, and no proof that there is no equilibrium.
    NoEquilibrium,
    /// No attempt found a solution, and at least one ended on a secondary ray. This does not prove
    /// that there is none.
    RayTermination,
    /// The limit on pivots was reached.
    PivotLimit,
    /// The limit on iterations was reached.
    IterationLimit,
    /// The residuals stopped decreasing above the tolerance, or the method has no further step. Another method may
    /// succeed.
    Stalled,
    /// The limit on wall-clock time was reached.
    TimeLimit,
    /// No attempt found a solution, and in at least one a basis was repeated; or the single exchanges of an active
    /// set method repeated a set.
    Cycling,
    /// No choice of one column from every pair gives a matrix that is nonsingular to working precision, so there is
    /// no complementary basis to start from, and with artificial columns no solution was found either. For sparse
    /// problems of order above 2000: the solver found no such choice, but there may be one. Then a start basis should
    /// be given.
    NoComplementaryBasis,
    /// Rounding errors are too large.
    NumericalTrouble,
    /// The observer stopped the solve.
    Cancelled,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Debug::fmt(self, f)
    }
}
