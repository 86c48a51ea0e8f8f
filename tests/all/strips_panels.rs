//! The panels with strips of mortar and one element per brick, open between their lower corner bricks.

use crate::common;

use std::sync::LazyLock;

use common::films::{assert_energy, assert_films_balance};
use common::{assert_close, assert_sound, panels, state};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::model::Model;
use masonry::scene::{Films, Route};
use masonry_report::summary;

const SQUARE: &str = "panel_square_mortar_open";
const RECTANGULAR: &str = "panel_rectangular_mortar_open";

fn by(name: &str, route: Route) -> Outcome {
    let outcome = solve(&panels::scene(name).route(route)).unwrap();
    assert_eq!(outcome.solve.status, Status::Solved, "{:#?}", outcome.solve.attempts);
    assert_sound(&outcome, 1e-9);
    outcome
}

static SQUARE_BY_POINTS: LazyLock<Outcome> = LazyLock::new(|| by(SQUARE, Route::Interior));
static RECTANGULAR_BY_POINTS: LazyLock<Outcome> =
    LazyLock::new(|| by(RECTANGULAR, Route::Interior));

#[test]
fn panels_have_one_element_per_brick_and_the_films_of_the_paper() {
    for (name, bricks, films) in [(SQUARE, 126, 335), (RECTANGULAR, 71, 180)] {
        let model = Model::from_scene(&panels::scene(name)).unwrap();
        assert_eq!(model.blocks.len(), bricks);
        assert!(model.blocks.iter().all(|it| it.mesh.as_ref().unwrap().elements.len() == 1));
        assert_eq!(model.joints.iter().filter(|joint| joint.film.is_some()).count(), films);
        let strips = model.contacts.iter().filter_map(|contact| contact.film);
        assert_eq!(strips.clone().count(), 2 * films);
        assert!(strips.into_iter().all(|film| film.stretch.is_some()));
    }
}

/// The films' own law, at the nodes, and the energy: of points that other methods have found.
#[test]
fn strips_balance_bricks_and_loads_at_every_node() {
    for outcome in [&*SQUARE_BY_POINTS, &*RECTANGULAR_BY_POINTS] {
        assert_films_balance(outcome, 1e-8);
        assert_energy(outcome, 1e-9);
    }
}

#[test]
fn panels_balance_and_are_symmetric() {
    for (outcome, load) in [(&*SQUARE_BY_POINTS, 11e3), (&*RECTANGULAR_BY_POINTS, 12e3)] {
        assert_close(outcome.reactions.iter().map(|it| it.fy).sum(), load, 1e-9);
        let sides = panels::sides(&outcome.reactions);
        assert_close(sides[0], -sides[3], 1e-7);
        assert_close(sides[1], sides[4], 1e-7);
        for wall in outcome.reactions.iter().filter(|it| it.support.ends_with("wall")) {
            assert!(wall.fy.abs() <= wall.fx.abs() * (1.0 + 1e-9));
        }
        let (sum, load) = (summary::total_reaction(outcome), summary::applied_load(&outcome.model));
        assert!((sum.moment + load.moment).abs() < 1e-9 * load.moment.abs());
    }
}

/// What films carry along the joints is no detail: without it the panels are softer by a tenth.
#[test]
fn bars_along_the_joints_stiffen_the_panels() {
    for (strips, name) in [(&*SQUARE_BY_POINTS, SQUARE), (&*RECTANGULAR_BY_POINTS, RECTANGULAR)] {
        let scene = panels::scene(name).films(Films::Compliance).route(Route::Interior);
        let softer = state(&solve(&scene).unwrap()).strain_energy / state(strips).strain_energy;
        assert!(softer > 1.05 && softer < 1.25, "{softer}");
        // The thrust of the arch presses bed films along their length, and next to nothing pulls.
        let along = || state(strips).films.iter().filter_map(|film| film.sigma_x);
        let [pressed, pulled] = [along().fold(0.0, f64::min), along().fold(0.0, f64::max)];
        assert!(pulled < -0.05 * pressed, "{pressed} and {pulled}");
    }
}
