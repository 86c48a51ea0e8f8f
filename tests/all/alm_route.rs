//! The augmented Lagrangian route of scenes: the answers of the other routes, every iteration in the report, and
//! a refusal where it cannot work.

use crate::common;

use std::ops::ControlFlow;

use common::films::film_stresses;
use common::{
    M_KN, all_displacements, all_reactions, all_stresses, assert_close, difference, panels,
    rectangle, state,
};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{Event, SolveError, solve, solve_observed};
use masonry::model::Plane;
use masonry::model::joints::PointRule;
use masonry::plan::Plan;
use masonry::scene::{
    Brick, Films, Joint, Load, Material, Movement, Route, Scene, Stage, Support, Wall,
};
use masonry_report::{json, table};
use serde_json::Value;

const TOLERANCE: f64 = 1e-8;

fn by(scene: &Scene, route: Route, tolerance: f64) -> Outcome {
    let outcome = solve(&scene.clone().route(route).tolerance(tolerance)).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved, "{route:?}: {:?}", outcome.solve.attempts);
    outcome
}

/// Where they are by interior points, but for bricks without load, which most of the panels have.
#[test]
fn panels_as_by_interior_points() {
    for name in ["panel_square_mortar", "panel_rectangular_mortar"] {
        let scene = panels::scene(name);
        let reference = by(&scene, Route::Interior, 1e-10);
        let outcome = by(&scene, Route::Alm, TOLERANCE);
        let mut pairs = vec![
            ("sides", panels::sides(&reference.reactions), panels::sides(&outcome.reactions)),
            ("stresses", all_stresses(&reference), all_stresses(&outcome)),
        ];
        if name == "panel_rectangular_mortar" {
            let [expected, found] = [&reference, &outcome].map(all_displacements);
            pairs.push(("displacements", expected, found));
        }
        for (what, expected, found) in pairs {
            let error = difference(&expected, &found);
            assert!(error <= 10.0 * TOLERANCE, "{name}, {what}: {error:e}");
        }
        let [expected, found] = [&reference, &outcome].map(|it| state(it).strain_energy);
        assert_close(found, expected, 10.0 * TOLERANCE);

        let info = &outcome.solve;
        assert_eq!((info.route, info.convergence.len()), (Route::Alm, info.iterations));
        assert_eq!(info.order, outcome.plan.order);
        assert!(info.order < reference.solve.order && reference.solve.convergence.is_empty());
        assert!(info.factorisations < info.iterations);
        let last = info.convergence.last().unwrap();
        assert!(last.unbalance.max(last.distance) <= TOLERANCE);
        // The unbalanced force was that small before, and forces were not near.
        assert!(
            info.convergence.iter().any(|it| it.unbalance <= TOLERANCE && it.distance > TOLERANCE)
        );
    }
}

/// A wall in strips of mortar, also between it and two floors.
fn wall_on_floors() -> Scene {
    let t = 0.02;
    let (width, height) = (3.0 * (0.2 + t) - t, 3.0 * (0.1 + t));
    let class = || Joint::mu(0.7).mortar(t, "mortar");
    let brick = Brick { length: 0.2, height: 0.1 };
    Scene::new("Wall on two floors", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .material("brick", Material::elastic(5e6, 0.15))
        .material("mortar", Material::elastic(8e5, 0.2))
        .joint("bed", class())
        .joint("head", class())
        .wall(Wall::running_bond("wall", "brick", brick, width, 3).mesh([2, 1]).origin([0.0, t]))
        .support(Support::new("left", [-1.0, 0.0], [0.3, 0.0], "bed"))
        .support(Support::new("right", [0.36, 0.0], [2.0, 0.0], "bed"))
        .load(Load::pressure("top", [0.0, height], [width, height], 100.0))
        .load(Load::traction("side", [0.0, t], [0.0, height], [20.0, 0.0]))
        .contact_points(PointRule::Gauss)
        .films(Films::Strips)
}

/// One floor sinks, turns and goes away, and what has slid stays slid: the strips start from gaps and slips as
/// the contact points do.
#[test]
fn strips_on_floors_that_move() {
    let stage = |name| Stage::new(name).load("top", 1.0);
    let moved = Movement { turn: 2e-5, ..Movement::by(2e-5, -1e-5) };
    let scene = wall_on_floors()
        .stage(stage("push").load("side", 1.0))
        .stage(stage("settle").load("side", 0.3).moves("right", moved));
    let reference = by(&scene, Route::Interior, 1e-10);
    let outcome = by(&scene, Route::Alm, TOLERANCE);
    let first = by(&wall_on_floors().stage(stage("push").load("side", 1.0)), Route::Alm, TOLERANCE);
    for of in [all_displacements, all_stresses, all_reactions, film_stresses] {
        let error = difference(&of(&reference), &of(&outcome));
        assert!(error <= 10.0 * TOLERANCE, "{error:e}");
        assert!(difference(&of(&first), &of(&outcome)) > 0.01);
    }
    assert_eq!(outcome.solve.order, 2 * outcome.plan.nodes);
}

/// A block on a floor, pushed by a share of what presses it.
fn block(material: Material, share: f64) -> Scene {
    Scene::new("Block", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("stone", material)
        .joint("floor", Joint::mu(0.6))
        .block(rectangle("block", "stone", [0.0, 1.0], [0.0, 0.5]).mesh([2, 1]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .load(Load::traction("top", [0.0, 0.5], [1.0, 0.5], [share * 20.0, -20.0]))
}

#[test]
fn the_report_has_every_iteration() {
    let scene = block(Material::elastic(1e6, 0.2), 0.2).route(Route::Alm);
    let mut seen = Vec::new();
    let outcome = solve_observed(&scene, &mut |event| {
        if let Event::Iteration { number, residual } = event {
            seen.push((number, residual));
        }
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(outcome.solve.status, Status::Solved);
    let text = json::result(&outcome, &[]).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    let history = report["convergence"].as_array().unwrap();
    assert_eq!(history.len(), outcome.solve.iterations);
    for ((number, residual), line) in seen.iter().zip(history) {
        assert_eq!(line["unbalance"].as_f64(), Some(*residual), "{number}");
    }
    assert_eq!(
        seen.iter().map(|it| it.0).collect::<Vec<_>>(),
        (1..=history.len()).collect::<Vec<_>>()
    );
    // Distances are not known at first, and numbers of the report are finite.
    assert!(history[0]["distance"].is_null() && history.last().unwrap()["distance"].is_f64());
    assert!(table::report(&outcome).contains("alm: solved after"));
    let plan = Plan::of(&scene, &outcome.model);
    assert!(plan.solver.contains("augmented Lagrangian") && plan.dense_numbers() == 0);
    assert_eq!(all_reactions(&outcome).len(), 3);
}

#[test]
fn a_block_that_slides_is_not_solved() {
    let outcome = solve(&block(Material::elastic(1e6, 0.2), 0.7).route(Route::Alm)).unwrap();
    assert!(matches!(outcome.solve.status, Status::Stalled | Status::IterationLimit));
    assert!(outcome.state.is_none() && !outcome.solve.convergence.is_empty());
}

#[test]
fn rigid_blocks_are_refused_with_a_remedy() {
    let error = solve(&block(Material::rigid(), 0.2).route(Route::Alm)).unwrap_err();
    assert!(matches!(error, SolveError::NotTreated { route: Route::Alm, .. }));
    let text = error.to_string();
    assert!(text.contains("elastic modulus") && text.contains("another route"), "{text}");
}
