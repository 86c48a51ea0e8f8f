//! Which routes are taken, what they need, and which one follows.

use super::common::{GRAVITY, applied_load, assert_close, assert_sound, rectangle};
use super::{materials, scene, stack, wall};
use lcp::Status;
use masonry::analysis::solve::{SolveError, solve};
use masonry::model::Model;
use masonry::plan::Plan;
use masonry::scene::{Form, Joint, Load, Route, Scene, Support};

/// Elastic walls go to the interior points, small ones then to the pivots, and the plan says why. Sparse routes
/// have no dense matrices, and so need little memory.
#[test]
fn the_plan_has_no_dense_matrices_for_sparse_routes() {
    let plan = |scene: &Scene| Plan::of(scene, &Model::from_scene(scene).unwrap());
    let small = plan(&wall(3, materials()[1]));
    let routes = |plan: &Plan| -> Vec<Route> { plan.routes.iter().map(|it| it.route).collect() };
    assert_eq!(routes(&small), [Route::Interior, Route::Forces, Route::Lemke]);
    let by_pivots = &small.routes[2];
    assert!(small.dense_numbers() > 9 * by_pivots.largest_order * by_pivots.largest_order);
    assert!(by_pivots.because.contains(&by_pivots.largest_order.to_string()));

    let large = wall(200, materials()[1]);
    let chosen = plan(&large);
    assert_eq!(routes(&chosen), [Route::Interior, Route::Forces]);
    let rigid = plan(&wall(200, materials()[0]));
    assert_eq!(routes(&rigid), [Route::Forces, Route::Interior]);
    let pivots = plan(&large.clone().route(Route::Lemke));
    assert_eq!(routes(&pivots), [Route::Lemke]);
    for route in [Route::Interior, Route::Qp, Route::Pgs] {
        let plan = plan(&large.clone().route(route));
        assert_eq!((routes(&plan), plan.dense_numbers()), (vec![route], 0));
        assert_eq!(plan.order, 2 * plan.nodes + 3 * plan.contact_points);
        assert!(plan.memory_bytes() < pivots.memory_bytes() / 100);
        let friction = plan.effects.iter().find(|effect| effect.name == "friction").unwrap();
        assert_eq!(friction.unknowns, 2 * plan.contact_points);
    }
    // What belongs to the pivots alone chooses them.
    for scene in [large.clone().form(Form::Mixed), large.max_pivots(10)] {
        assert_eq!(routes(&plan(&scene)), [Route::Lemke]);
    }
}

/// A large wall is solved without asking for it, and nothing is reduced.
#[test]
fn a_large_wall_goes_to_the_interior_points() {
    for (material, route) in materials().into_iter().zip([Route::Forces, Route::Interior]) {
        let outcome = solve(&wall(200, material)).unwrap();
        assert_eq!((outcome.solve.status, outcome.solve.route), (Status::Solved, route));
        // Forces of rigid blocks take a few steps, and their loading starts from these forces.
        let taken = outcome.solve.factorisations;
        assert!(route != Route::Forces || taken <= 12, "{taken}");
        assert_sound(&outcome, 1e-9);
        assert_close(outcome.reactions[0].fy, -applied_load(&outcome.model).y, 1e-9);
        let phases: Vec<&str> = outcome.times.iter().map(|time| time.phase.as_str()).collect();
        assert_eq!(phases, ["model", "system", "sparse form", "solve", "recovery"]);
    }
}

/// The mesh of one block is too fine for dense matrices, and nothing to the sparse routes.
#[test]
fn memory_is_that_of_the_route() {
    let fine = |elements| {
        scene(materials()[1])
            .block(rectangle("block", "stone", [0.0, 1.0], [0.0, 1.0]).mesh([elements; 2]))
            .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
    };
    // Dense matrices of 320 000 rows and columns have 800 GB.
    let scene = fine(400).route(Route::Lemke);
    let error = solve(&scene).unwrap_err();
    assert!(matches!(error, SolveError::TooLarge { .. }), "{error}");
    let plan = Plan::of(&scene, &Model::from_scene(&scene).unwrap());
    assert_eq!(plan.refused, Some(error.to_string()));
    let sparse = fine(160).route(Route::Interior);
    assert_eq!(Plan::of(&sparse, &Model::from_scene(&sparse).unwrap()).refused, None);
    let outcome = solve(&sparse).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved);
    assert_close(outcome.reactions[0].fy, 2000.0 * GRAVITY, 1e-9);
}

/// Where pivots end without an answer the next routes are asked, and all are reported.
#[test]
fn the_next_route_follows_where_one_fails() {
    let scene = stack(2, 0.3, materials()[1]);
    let outcome = solve(&scene.clone().max_pivots(1)).unwrap();
    assert_eq!(outcome.solve.status, Status::PivotLimit, "a limit is meant for the pivots");
    assert_eq!(outcome.solve.routes.len(), 1);

    // A proof follows where the interior points find no answer.
    let pull = Load::traction("pull", [0.0, 1.0], [1.0, 1.0], [0.0, 20.0]);
    let lifted = scene
        .joint("bed", Joint::mu(0.0))
        .block(rectangle("fine", "stone", [1.2, 1.9], [0.0, 0.5]).mesh([60, 40]))
        .load(pull);
    let outcome = solve(&lifted.gravity([0.0, -GRAVITY])).unwrap();
    assert_eq!(outcome.solve.status, Status::Infeasible, "{:?}", outcome.solve.attempts);
    let [first, second] = &outcome.solve.routes[..] else { panic!("{:?}", outcome.solve.routes) };
    assert_eq!((first.route, second.route), (Route::Interior, Route::Forces));
    assert_eq!(first.end, "Stalled");
    assert_eq!(second.end, "Infeasible");
    assert_eq!(outcome.solve.attempts.len(), 2);
}
