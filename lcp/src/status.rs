//! The status of a solve.

/// Outcome of a solve: a mathematical result or a limit, never a mistake in the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Status {
    /// The residuals, recomputed from the original data, are below the tolerance.
    Solved,
    /// A complementary basis was found, but its residuals, recomputed from the original data, are above the tolerance
    /// and below its square root, also if the equation is measured by the right-hand side alone. A problem that was
    /// solved in another form is solved there, but the residuals in the given form are above the tolerance.
    AlmostSolved,
    /// There is no solution: `A t + B y = c` has none with `t >= 0` and `y >= 0`, which
    /// [`Solution::certificate`](crate::Solution::certificate) proves.
    Infeasible,
    /// There is no solution: the linear conditions can be met, but not together with complementarity.
    /// [`Solution::certificate`](crate::Solution::certificate) has a proof for every choice.
    NoSolution,
    /// Bodies in contact flow, or have moved beyond the displacements for which the problem is valid
    /// ([`Ending::status`](crate::Ending::status)). The status is evidence, but not a proof, that there is no
    /// equilibrium.
    NoEquilibrium,
    /// No attempt found a solution, and at least one ended on a secondary ray. A ray does not prove that there is no
    /// solution.
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
    /// no complementary basis to start from, and no solution was found with artificial columns either. The solver may
    /// have missed such a choice in a sparse problem of order above 2000: a start basis should then be given.
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
