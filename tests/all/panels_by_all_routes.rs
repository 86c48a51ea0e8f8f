//! The panels of the paper by every route, dry and in mortar: one answer.
//!
//! Of the square panels and those in mortar the displacements are not unique, for bricks that carry nothing
//! may hang anywhere in their open joints: there stresses, forces and energy are compared; and `f.u = 2 U + D` holds. Quadratic programs
//! solve the square panel in strips of mortar only in part: their fixed point does not contract, and they say so.

use crate::common;

use common::films::{assert_energy, film_stresses};
use common::routes::ROUTES;
use common::{
    all_displacements, all_stresses, assert_close, assert_sound, difference, panels, state,
};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::scene::{Route, Scene};

const TOLERANCE: f64 = 1e-8;

fn by(scene: &Scene, route: Route, tolerance: f64) -> Outcome {
    let outcome = solve(&scene.clone().route(route).tolerance(tolerance)).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved, "{route:?}: {:?}", outcome.solve.attempts);
    assert_eq!(outcome.solve.route, route);
    assert_sound(&outcome, 10.0 * TOLERANCE);
    outcome
}

/// Every route against interior points that are asked for more.
fn assert_one_answer(name: &str, routes: &[Route], are_displacements_unique: bool) {
    let scene = panels::scene(name);
    let reference = by(&scene, Route::Interior, 1e-10);
    for &route in routes {
        let outcome = by(&scene, route, TOLERANCE);
        let mut pairs = vec![
            ("sides", panels::sides(&reference.reactions), panels::sides(&outcome.reactions)),
            ("stresses", all_stresses(&reference), all_stresses(&outcome)),
            ("films", film_stresses(&reference), film_stresses(&outcome)),
        ];
        if are_displacements_unique {
            let [expected, found] = [&reference, &outcome].map(all_displacements);
            pairs.push(("displacements", expected, found));
        }
        for (what, expected, found) in pairs {
            let error = difference(&expected, &found);
            assert!(error <= 10.0 * TOLERANCE, "{name} by {route:?}, {what}: {error:e}");
        }
        let [expected, found] = [&reference, &outcome].map(|it| state(it).strain_energy);
        assert_close(found, expected, 10.0 * TOLERANCE);
        assert_energy(&outcome, 10.0 * TOLERANCE);
    }
}

#[test]
fn square_dry() {
    assert_one_answer("panel_square", &ROUTES, false);
}

#[test]
fn rectangular_dry() {
    assert_one_answer("panel_rectangular", &ROUTES, true);
}

#[test]
fn rectangular_in_strips_of_mortar() {
    assert_one_answer("panel_rectangular_mortar_open", &ROUTES, false);
}

#[test]
fn square_in_strips_of_mortar() {
    let routes = [Route::Lemke, Route::Interior, Route::Alm];
    assert_one_answer("panel_square_mortar_open", &routes, false);
}
