//! The methods, and what they owe.

use lcp::{
    Error, InteriorPoint, InteriorPointSettings, Lemke, LemkeSettings, ProjectedGaussSeidel,
    ProjectedGaussSeidelSettings, SemismoothNewton, SemismoothNewtonSettings, Solution, Solver,
    Status,
};
#[cfg(feature = "clarabel")]
use lcp::{QuadraticProgram, QuadraticProgramSettings};

pub(crate) const TOLERANCES: [f64; 3] = [1e-4, 1e-8, 1e-12];

/// What a method owes for a problem that has a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Owes {
    /// The solution.
    Solution,
    /// An answer that is right where it is called solved, and does not claim that there is none.
    Honesty,
    /// [`Error::NotTreated`].
    Refusal,
}

/// The methods, by their place in the rows of tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Route {
    Lemke,
    Sweeps,
    Program,
    Interior,
    Newton,
}

pub(crate) type Routes<P> = Vec<(Route, Box<dyn Solver<P>>)>;

pub(crate) fn lemke(tolerance: f64) -> Lemke {
    Lemke::new(LemkeSettings { tolerance, ..Default::default() })
}

/// As many sweeps as the conditioning of these problems may take.
pub(crate) fn sweeps(tolerance: f64) -> ProjectedGaussSeidel {
    ProjectedGaussSeidel::new(ProjectedGaussSeidelSettings {
        tolerance,
        max_iterations: 200_000,
        ..Default::default()
    })
}

#[cfg(feature = "clarabel")]
pub(crate) fn program(tolerance: f64) -> QuadraticProgram {
    QuadraticProgram::new(QuadraticProgramSettings { tolerance, ..Default::default() })
}

pub(crate) fn interior(tolerance: f64) -> InteriorPoint {
    InteriorPoint::new(InteriorPointSettings { tolerance, ..Default::default() })
}

pub(crate) fn newton(tolerance: f64) -> SemismoothNewton {
    SemismoothNewton::new(SemismoothNewtonSettings { tolerance, ..Default::default() })
}

/// The methods that take problems of a type by all five.
#[cfg(feature = "clarabel")]
pub(crate) fn all<P>(tolerance: f64) -> Routes<P>
where
    Lemke: Solver<P>,
    ProjectedGaussSeidel: Solver<P>,
    QuadraticProgram: Solver<P>,
    InteriorPoint: Solver<P>,
    SemismoothNewton: Solver<P>,
{
    let mut routes: Routes<P> = vec![
        (Route::Lemke, Box::new(lemke(tolerance))),
        (Route::Sweeps, Box::new(sweeps(tolerance))),
        (Route::Interior, Box::new(interior(tolerance))),
        (Route::Newton, Box::new(newton(tolerance))),
    ];
    routes.push((Route::Program, Box::new(program(tolerance))));
    routes
}

/// The methods that take problems of a type by all four.
#[cfg(not(feature = "clarabel"))]
pub(crate) fn all<P>(tolerance: f64) -> Routes<P>
where
    Lemke: Solver<P>,
    ProjectedGaussSeidel: Solver<P>,
    InteriorPoint: Solver<P>,
    SemismoothNewton: Solver<P>,
{
    vec![
        (Route::Lemke, Box::new(lemke(tolerance))),
        (Route::Sweeps, Box::new(sweeps(tolerance))),
        (Route::Interior, Box::new(interior(tolerance))),
        (Route::Newton, Box::new(newton(tolerance))),
    ]
}

/// The solution of a method, unless it refuses the problem or does not get there, where it may.
pub(crate) fn solved<P>(
    (route, solver): &(Route, Box<dyn Solver<P>>),
    problem: &P,
    owes: Owes,
) -> Option<Solution<P>> {
    let solution = match (solver.solve(problem), owes) {
        (Err(Error::NotTreated { .. }), Owes::Refusal) => return None,
        (Ok(solution), Owes::Solution | Owes::Honesty) => solution,
        (other, _) => panic!("{route:?} owes {owes:?}, but: {other:?}"),
    };
    assert!(solution.t.iter().chain(&solution.y).all(|v| v.is_finite()), "{route:?}");
    assert_eq!(solution.info.method, solver.method(), "{route:?}");
    if solution.is_solved() {
        return Some(solution);
    }
    let is_honest = matches!(
        solution.status,
        Status::IterationLimit
            | Status::Stalled
            | Status::Cycling
            | Status::RayTermination
            | Status::NumericalTrouble
    );
    assert!(
        is_honest && owes == Owes::Honesty,
        "{route:?} owes {owes:?}, but: {:?} after {} steps, {:?}",
        solution.status,
        solution.info.iterations,
        solution.residuals
    );
    None
}
