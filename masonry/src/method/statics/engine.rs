//! The methods that solve the optimisation programs of admissible forces.

use lcp::{InteriorPoint, InteriorPointSettings, MixedLcp, Observer, Solution, Solver};

/// Residual tolerance of the optimisation programs: the linear ones and the program of least forces.
pub(super) const TOLERANCE: f64 = 1e-12;
/// Largest number of steps of one program. Forces and proofs take ten to forty. Chosen: far more.
pub(super) const MAX_STEPS: usize = 200;
/// Residual tolerance of the target `Inside`: many walls take twice as many steps to smaller residuals.
const INSIDE: f64 = 1e-8;

/// The point at which the interior-point method ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// A point near the set of solutions: the first choice, since there may be many solutions.
    Inside,
    /// The vertex of the set of solutions to which the path leads.
    Vertex,
}

impl Target {
    /// All targets, in the order in which they are tried. The second one is needed: only `Vertex` gave a proof on a
    /// wall of 1000 bricks (measured).
    pub(super) const ALL: [Self; 2] = [Self::Inside, Self::Vertex];

    /// Solves a program to this target, and returns the best point that was found.
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
