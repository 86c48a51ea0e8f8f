//! The routes of scenes, in one place for all tests that treat every one of them.

use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::scene::{Route, Scene};

use super::assert_sound;

/// All routes.
pub const ROUTES: [Route; 5] = [Route::Lemke, Route::Interior, Route::Qp, Route::Pgs, Route::Alm];

/// Those that treat rigid blocks too; the augmented Lagrangian method has its penalties from their
/// stiffness.
pub const OF_RIGID_BLOCKS: [Route; 4] = [Route::Lemke, Route::Interior, Route::Qp, Route::Pgs];

/// The routes that treat a scene; the others refuse it.
#[track_caller]
pub fn routes_for(scene: &Scene) -> Vec<Route> {
    let is_rigid = |material: &str| scene.materials[material].young.is_none();
    let of_blocks = scene.blocks.iter().map(|block| &block.material);
    let mut materials = of_blocks.chain(scene.walls.iter().map(|wall| &wall.material));
    if !materials.any(|material| is_rigid(material)) {
        return ROUTES.to_vec();
    }
    for route in ROUTES.into_iter().filter(|route| !OF_RIGID_BLOCKS.contains(route)) {
        let error = solve(&scene.clone().route(route)).unwrap_err();
        let is_refused = error.is_refusal();
        assert!(is_refused && error.to_string().contains("rigid"), "{route:?}: {error}");
    }
    OF_RIGID_BLOCKS.to_vec()
}

/// The residual that is asked for: the augmented Lagrangian method converges by a fixed factor only.
fn asked(route: Route) -> f64 {
    if route == Route::Alm { 1e-8 } else { 1e-10 }
}

/// Relative errors of numbers that are exact in closed form: those of rounding, where the equations are
/// solved at the end; where iterations end by their residual, what that means for single contacts.
pub fn rounding(route: Route) -> f64 {
    match route {
        Route::Alm => 1e-6,
        Route::Pgs => 1e-8,
        _ => 1e-10,
    }
}

/// The outcome by one route of a scene that has an equilibrium, with its balances checked.
#[track_caller]
pub fn solved_by(scene: &Scene, route: Route) -> Outcome {
    let outcome = outcome_by(scene, route);
    assert_eq!(outcome.solve.status, Status::Solved, "{route:?}: {:#?}", outcome.solve.attempts);
    assert_sound(&outcome, 10.0 * asked(route));
    outcome
}

/// The same, but for iterations that do not come as near as was asked for, and say so.
///
/// Sweeps come no nearer than 1e-9 to 1e-3 where only their springs hold rigid blocks, where bodies of very
/// different stiffness meet, and where forces can circulate, around the end of a head joint or between
/// points that are more than the nodes. The augmented Lagrangian method is slow in the same cases.
#[track_caller]
pub fn answer_by(scene: &Scene, route: Route) -> Option<Outcome> {
    if matches!(route, Route::Pgs | Route::Alm) {
        let outcome = outcome_by(scene, route);
        if matches!(outcome.solve.status, Status::Stalled | Status::IterationLimit) {
            let residual = outcome.solve.residuals.equation;
            assert!(outcome.state.is_none() && residual < 1e-2, "{route:?}: residual {residual:e}");
            return None;
        }
    }
    Some(solved_by(scene, route))
}

/// Whether a route finds an equilibrium.
pub fn stands_by(scene: &Scene, route: Route) -> bool {
    outcome_by(scene, route).solve.status == Status::Solved
}

fn outcome_by(scene: &Scene, route: Route) -> Outcome {
    solve(&scene.clone().route(route).tolerance(asked(route))).unwrap()
}
