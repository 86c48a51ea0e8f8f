//! The routes of scenes, in one place for all tests that treat every one of them.

use lcp::Status;
use masonry::outcome::Outcome;
use masonry::scene::{Route, Scene};
use masonry::solve::solve;

use super::assert_sound;

/// All routes.
pub const ROUTES: [Route; 4] = [Route::Lemke, Route::Interior, Route::Qp, Route::Pgs];

/// Relative errors of numbers that are exact in closed form: those of rounding, where the equations are
/// solved at the end; of sweeps, which end by their residual, what that means for single contacts.
pub fn rounding(route: Route) -> f64 {
    if route == Route::Pgs { 1e-8 } else { 1e-10 }
}

/// The outcome by one route of a scene that has an equilibrium, with its balances checked.
#[track_caller]
pub fn solved_by(scene: &Scene, route: Route) -> Outcome {
    let outcome = solve(&scene.clone().route(route)).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved, "{route:?}: {:#?}", outcome.solve.attempts);
    assert_sound(&outcome, 1e-9);
    outcome
}

/// The same, but for sweeps that stall, and say so: they come no nearer than 1e-9 to 1e-4 where only
/// their springs hold rigid blocks, and where forces can circulate, around the end of a head joint or
/// between points that are more than the nodes.
#[track_caller]
pub fn solved_unless_sweeps_stall(scene: &Scene, route: Route) -> Option<Outcome> {
    if route == Route::Pgs {
        let outcome = solve(&scene.clone().route(route)).unwrap();
        if outcome.solve.status == Status::Stalled {
            let residual = outcome.solve.residuals.worst();
            assert!(outcome.state.is_none() && residual < 1e-3, "residual {residual:e}");
            return None;
        }
    }
    Some(solved_by(scene, route))
}

/// Whether a route finds an equilibrium.
pub fn stands_by(scene: &Scene, route: Route) -> bool {
    solve(&scene.clone().route(route)).unwrap().solve.status == Status::Solved
}
