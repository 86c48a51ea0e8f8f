//! The methods that solve the linear programs of admissible forces.

use lcp::{
    InteriorPoint, InteriorPointSettings, Iteration, MixedLcp, Observer, QuadraticProgram,
    QuadraticProgramSettings, Solution, Solver,
};

/// Residual of the programs, linear or of least forces.
pub(super) const TOLERANCE: f64 = 1e-12;
/// Steps of a program. Forces and proofs take ten to forty. Chosen: far more.
pub(super) const MAX_STEPS: usize = 200;
/// Residual of a point inside: beyond it many walls take as many steps again.
const INSIDE: f64 = 1e-8;

/// How a program is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Engine {
    /// Interior points, to a point near the solution: the first choice, since there may be many solutions.
    Inside,
    /// Interior points, and the vertex that they lead to.
    Interior,
    /// The convex programs of another library, and the vertex that they lead to.
    Clarabel,
}

impl Engine {
    /// The best point that was found.
    pub(super) fn solve(
        self,
        program: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution<MixedLcp>, lcp::Error> {
        let observer = &mut |at: &Iteration| observer(at);
        let max_iterations = MAX_STEPS;
        let (tolerance, crossover) = match self {
            Self::Inside => (INSIDE, false),
            Self::Interior | Self::Clarabel => (TOLERANCE, true),
        };
        if self == Self::Clarabel {
            let settings =
                QuadraticProgramSettings { tolerance, max_iterations, ..Default::default() };
            return QuadraticProgram::new(settings).solve_observed(program, observer);
        }
        let settings = InteriorPointSettings {
            tolerance,
            max_iterations,
            crossover,
            prove_infeasible: false,
            ..Default::default()
        };
        InteriorPoint::new(settings).solve_observed(program, observer)
    }
}
