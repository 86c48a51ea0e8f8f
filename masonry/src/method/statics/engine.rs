//! The method that solves the linear programs of admissible forces.

use lcp::{InteriorPoint, InteriorPointSettings, MixedLcp, Observer, Solution, Solver};

/// Residual of the programs, linear or of least forces.
pub(super) const TOLERANCE: f64 = 1e-12;
/// Steps of a program. Forces and proofs take ten to forty. Chosen: far more.
pub(super) const MAX_STEPS: usize = 200;
/// Residual of a point inside: many walls take twice as many steps to smaller residuals.
const INSIDE: f64 = 1e-8;

/// The point at which interior points end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// A point near the solution: the first choice, since there may be many solutions.
    Inside,
    /// The vertex at the end of the path.
    Vertex,
}

impl Target {
    /// The targets in their order. Measured on a wall of 1000 bricks: the first gives no proof there, and the
    /// second does.
    pub(super) const ALL: [Self; 2] = [Self::Inside, Self::Vertex];

    /// The best point that was found.
    pub(super) fn solve(
        self,
        program: &MixedLcp,
        observer: &mut Observer<'_>,
    ) -> Result<Solution<MixedLcp>, lcp::Error> {
        let crossover = self == Self::Vertex;
        let settings = InteriorPointSettings {
            tolerance: if crossover { TOLERANCE } else { INSIDE },
            max_iterations: MAX_STEPS,
            crossover,
            prove_infeasible: false,
            ..Default::default()
        };
        InteriorPoint::new(settings).solve_observed(program, observer)
    }
}
