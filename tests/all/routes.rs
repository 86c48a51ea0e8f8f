//! All routes through the whole pipeline: one answer in one shape.
//!
//! Reactions, stresses and displacements are compared where they are unique, on scenes with answers in
//! closed form and on a panel; where nothing stands, each route says so in its own way, and never claims a
//! solution.

use crate::common;
mod plan;

use std::cell::Cell;
use std::ops::ControlFlow;

use common::routes::{OF_RIGID_BLOCKS as ROUTES, solved_by};
use common::{
    GRAVITY, M_KN, all_displacements, all_reactions, all_stresses, applied_load, assert_close,
    difference, joint_resultant, rectangle, state,
};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{Event, SolveError, solve, solve_observed};
use masonry::ids::{BlockId, SupportId};
use masonry::model::{Body, Plane};
use masonry::scene::{
    Block, Brick, Form, Joint, Load, Material, Route, Scene, SceneErrorKind, Support, Wall,
};
use masonry_report::{json, summary, table};
use nalgebra::Vector2;
use serde_json::Value;

const TOLERANCE: f64 = 1e-10;

/// The outcome by a route that must find one, with what all routes report.
fn solved(scene: &Scene, route: Route) -> Outcome {
    let outcome = solved_by(scene, route);
    let info = &outcome.solve;
    assert!(info.residuals.worst() <= TOLERANCE, "{route:?}: {:?}", info.residuals);
    assert_eq!((info.route, info.routes.len()), (route, 1));
    assert!([outcome.plan.order, outcome.plan.largest_order].contains(&info.order));
    assert!(info.because.contains(route.name()));
    // A start basis may be the answer.
    assert!(info.pivots == 0 || route == Route::Lemke);
    assert_eq!(info.iterations > 0, route != Route::Lemke);
    assert_eq!(info.soft.is_some(), route == Route::Pgs);
    outcome
}

fn materials() -> [Material; 2] {
    [Material::rigid(), Material::elastic(1e7, 0.2)].map(|material| material.density(2000.0))
}

fn scene(material: Material) -> Scene {
    Scene::new("Routes", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .material("stone", material)
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
}

/// `count` blocks, 1 wide and 0.5 high, on top of each other, pushed by `alpha` of their weight.
fn stack(count: u32, alpha: f64, material: Material) -> Scene {
    let floor = Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed");
    let on_floor = scene(material).gravity([alpha * GRAVITY, -GRAVITY]).support(floor);
    (0..count).map(f64::from).fold(on_floor, |scene, k| {
        let block = rectangle(&format!("{k}"), "stone", [0.0, 1.0], [0.5 * k, 0.5 * k + 0.5]);
        scene.block(block.mesh([2, 2]))
    })
}

/// A keystone between smooth faces inclined by 20 degrees.
fn wedge(material: Material) -> Scene {
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let foot = sin / cos;
    let (left, right) = ([foot, 0.0], [1.0 - foot, 0.0]);
    scene(material)
        .joint("smooth", Joint::mu(0.0))
        .block(Block::new("key", "stone", [left, right, [1.0, 1.0], [0.0, 1.0]]).mesh([2, 3]))
        .support(Support::new("left", left, [0.0, 1.0], "smooth"))
        .support(Support::new("right", right, [1.0, 1.0], "smooth"))
}

/// A wall of `courses` courses, 0.6 wide, loaded on top by a traction that leans.
fn wall(courses: u32, material: Material) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    let top = 0.1 * f64::from(courses);
    scene(material)
        .wall(Wall::running_bond("wall", "stone", brick, 0.6, courses).mesh([2, 1]))
        .support(Support::new("floor", [0.0, 0.0], [0.6, 0.0], "bed"))
        .load(Load::traction("top", [0.0, top], [0.6, top], [2.0, -20.0]))
}

/// A panel of bricks between two walls without a floor, which friction alone could hold.
fn hanging(mu: f64, material: Material) -> Scene {
    let brick = Brick { length: 0.1, height: 0.1 };
    Scene::new("Panel without a floor", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("brick", material)
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
        .wall(Wall::running_bond("panel", "brick", brick, 0.3, 3).mesh([2, 2]))
        .support(Support::new("left wall", [0.0, 0.0], [0.0, 0.3], "head"))
        .support(Support::new("right wall", [0.3, 0.0], [0.3, 0.3], "head"))
        .load(Load::pressure("top", [0.0, 0.3], [0.3, 0.3], 10.0))
}

/// Everything that is unique, against the pivots.
fn assert_agree(route: Route, outcome: &Outcome, reference: &Outcome) {
    let bound = 10.0 * TOLERANCE;
    let pairs = [
        ("reactions", all_reactions(reference), all_reactions(outcome)),
        ("stresses", all_stresses(reference), all_stresses(outcome)),
        ("displacements", all_displacements(reference), all_displacements(outcome)),
    ];
    for (what, expected, found) in pairs {
        let error = difference(&expected, &found);
        assert!(error <= bound, "{route:?}, {what}: {error:e}");
    }
    let [expected, found] = [reference, outcome].map(|it| state(it).strain_energy);
    assert!((found - expected).abs() <= bound * expected.abs(), "{found} for {expected}");
}

#[test]
fn a_stack_that_is_pushed() {
    for material in materials() {
        let scene = stack(3, 0.3, material);
        let reference = solved(&scene, Route::Lemke);
        for route in ROUTES {
            let outcome = solved(&scene, route);
            assert_agree(route, &outcome, &reference);
            let weight = 1.5 * 2000.0 * GRAVITY;
            let reaction = &outcome.reactions[0];
            assert_close(reaction.fy, weight, 1e-9);
            assert_close(reaction.fx, -0.3 * weight, 1e-9);
        }
    }
}

#[test]
fn a_smooth_wedge() {
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    for material in materials() {
        let scene = wedge(material);
        for route in ROUTES {
            let outcome = solved(&scene, route);
            let weight = 2000.0 * GRAVITY * (1.0 - sin / cos);
            for (face, inwards) in [(0, Vector2::new(cos, sin)), (1, Vector2::new(-cos, sin))] {
                let force = joint_resultant(&outcome, Body::Support(SupportId(face)), BlockId(0));
                let error = (force - inwards * (weight / (2.0 * sin))).norm();
                assert!(error <= 1e-9 * weight, "{route:?}: {error:e}");
            }
        }
    }
}

/// The load spreads downwards through bricks whose joints open and slide. Of rigid bricks only the
/// reaction is unique, and displacements are zero.
#[test]
fn a_leaning_wall() {
    let [rigid, elastic] = materials();
    let reference = solved(&wall(3, elastic), Route::Lemke);
    for route in ROUTES {
        assert_agree(route, &solved(&wall(3, elastic), route), &reference);
        let outcome = solved(&wall(3, rigid), route);
        let [reaction] = outcome.reactions.as_slice() else { panic!("one support") };
        let load = applied_load(&outcome.model);
        assert_close(reaction.fx, -load.x, 1e-9);
        assert_close(reaction.fy, -load.y, 1e-9);
        assert!(all_displacements(&outcome).iter().all(|u| u.abs() <= 0.0), "{route:?}");
        assert_eq!(outcome.checks.as_ref().unwrap().open, 0);
    }
}

/// The springs of the programs are taken away again, and what they changed is reported.
#[test]
fn springs_leave_no_bias() {
    let scene = wall(2, materials()[1]);
    let reference = solved(&scene, Route::Lemke);
    let outcome = solve(&scene.clone().route(Route::Qp).soft(1e-4)).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved);
    assert_agree(Route::Qp, &outcome, &reference);
    let soft = outcome.solve.soft.unwrap();
    assert!(soft.rounds >= 2 && (soft.stiffness - 1e-4).abs() <= 0.0);
    assert!(soft.share > 1e-6 && soft.share < 1e-2, "{soft:?}");
    assert!(soft.displacement_error.is_some_and(|error| error > 1e-6), "{soft:?}");
    assert!(table::report(&outcome).contains("soft springs"));

    let stiff = solve(&scene.clone().route(Route::Pgs).soft(1e-2)).unwrap();
    assert_eq!(stiff.solve.status, Status::Solved, "{:?}", stiff.solve.attempts);
    assert!(stiff.solve.soft.unwrap().share > soft.share);
}

/// Nothing stops a block that friction does not hold.
#[test]
fn a_motion_shows_that_a_block_slides() {
    for material in materials() {
        let outcome = solve(&stack(1, 0.8, material).route(Route::Interior)).unwrap();
        assert_eq!(outcome.solve.status, Status::NoEquilibrium, "{:?}", outcome.solve.attempts);
        assert!(outcome.state.is_none() && outcome.reactions.is_empty());
        for corner in &outcome.mechanism.as_ref().unwrap()[0] {
            assert!((corner - Vector2::x()).amax() < 1e-4, "{corner}");
        }
        assert!(summary::reason(&outcome).unwrap().contains("not a proof"));
        let report = table::report(&outcome);
        assert!(report.contains("go on moving, and nothing resists them"), "{report}");
        let json: Value = serde_json::from_str(&json::result(&outcome, &[]).unwrap()).unwrap();
        assert!(json["mechanism"]["0"].is_array() && json["reactions"].is_null());
    }
}

/// A pull that no contact takes: programs prove that nothing stands.
#[test]
fn a_program_proves_that_nothing_stands() {
    for material in materials() {
        let lifted = stack(1, 0.0, material).load(Load::traction(
            "pull",
            [0.0, 0.5],
            [1.0, 0.5],
            [0.0, 20.0],
        ));
        let outcome = solve(&lifted.route(Route::Qp)).unwrap();
        assert_eq!(outcome.solve.status, Status::Infeasible, "{:?}", outcome.solve.attempts);
        assert!(outcome.solve.proved && outcome.state.is_none());
        assert!(summary::reason(&outcome).unwrap().contains("proved"));
        let json: Value = serde_json::from_str(&json::result(&outcome, &[]).unwrap()).unwrap();
        assert_eq!(json["proved"], true);
    }
}

/// No route takes the fall of a panel for an equilibrium, and all hold one that can hang.
#[test]
fn a_panel_without_a_floor() {
    let elastic = Material::elastic(1e5, 0.15);
    for route in ROUTES {
        let outcome = solve(&hanging(1.0, elastic).route(route)).unwrap();
        assert_ne!(outcome.solve.status, Status::Solved, "{route:?}");
        assert!(outcome.state.is_none(), "{route:?}");
        assert!(summary::reason(&outcome).is_some());
        let falls = matches!(route, Route::Lemke | Route::Interior);
        assert_eq!(outcome.mechanism.is_some(), falls, "{route:?}");
    }
    let reference = solved(&hanging(2.5, elastic), Route::Lemke);
    for route in [Route::Interior, Route::Qp] {
        assert_agree(route, &solved(&hanging(2.5, elastic), route), &reference);
    }
}

/// Every route can be watched and stopped.
#[test]
fn any_route_can_be_cancelled() {
    // None of them has an answer after a step, which would be more than a cancelled solve.
    let scene = hanging(2.5, Material::elastic(1e5, 0.15));
    for route in ROUTES {
        let seen = Cell::new(0);
        let outcome = solve_observed(&scene.clone().route(route), &mut |event| {
            let steps = match event {
                Event::Phase(_) | Event::Step { .. } => return ControlFlow::Continue(()),
                Event::Pivots(_) => route == Route::Lemke,
                Event::Iteration { residual, .. } => route != Route::Lemke && residual >= 0.0,
            };
            assert!(steps, "{route:?}: {event:?}");
            seen.set(seen.get() + 1);
            if seen.get() < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        let outcome = outcome.unwrap();
        assert!(seen.get() >= 1, "{route:?}");
        if seen.get() >= 2 {
            assert_eq!(outcome.solve.status, Status::Cancelled, "{route:?}");
            assert!(outcome.state.is_none());
        }
    }
}

/// Keys that a route has no use for are mistakes with a remedy.
#[test]
fn options_of_other_routes_are_refused() {
    let base = stack(1, 0.1, materials()[0]);
    let cases = [
        (base.clone().route(Route::Interior).form(Form::Mixed), "solver.form", "lemke"),
        (base.clone().route(Route::Qp).max_pivots(5), "solver.max_pivots", "lemke"),
        (base.clone().route(Route::Interior).soft(1e-4), "solver.soft", "qp"),
        (base.clone().route(Route::Lemke).soft(1e-4), "solver.soft", "pgs"),
        (base.clone().soft(1e-4), "solver.soft", "qp"),
    ];
    for (scene, key, remedy) in cases {
        let SolveError::Scene(error) = solve(&scene).unwrap_err() else { panic!("{key}") };
        assert!(matches!(error.kind(), SceneErrorKind::Unwanted { .. }), "{error}");
        assert_eq!(error.key(), key);
        let text = error.to_string();
        assert!(text.contains("remove it") && text.contains(remedy), "{text}");
    }
}
