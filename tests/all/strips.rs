//! Films of scenes as whole strips: against elements and films assembled at the nodes, against each other on
//! all routes, and their limits.

use crate::common;

use common::films::{
    Nodes, assert_energy, assert_films_balance, assert_films_balance_after, film_stresses,
};
use common::{
    M_KN, all_displacements, all_reactions, all_stresses, assert_close, difference, solved, state,
};
use masonry::analysis::outcome::{Outcome, PointStatus};
use masonry::model::joints::PointRule;
use masonry::model::{Body, Model, Plane};
use masonry::plan::{Effect, Plan};
use masonry::scene::{
    Brick, Films, Form, Joint, Load, Material, Route, Scene, Stage, Support, Wall,
};
use masonry::system::System;
use nalgebra::DVector;

const BRICK: f64 = 5e6;
const MORTAR: f64 = 8e5;

/// Three courses of three bricks on a rigid floor, everything in mortar of thickness `t`: without loads.
fn wall(t: f64, mu: f64, mesh: [u32; 2], films: Films) -> Scene {
    let class = || Joint::mu(mu).mortar(t, "mortar");
    let [width, _] = size(t);
    Scene::new("Wall", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .material("brick", Material::elastic(BRICK, 0.15))
        .material("mortar", Material::elastic(MORTAR, 0.3))
        .joint("bed", class())
        .joint("head", class())
        .joint("floor", class())
        .wall(Wall::running_bond("wall", "brick", BRICKS, width, 3).mesh(mesh).origin([0.0, t]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .contact_points(PointRule::Gauss)
        .films(films)
}

const BRICKS: Brick = Brick { length: 0.2, height: 0.1 };

/// Width and height of the wall, with the film below it.
fn size(t: f64) -> [f64; 2] {
    [3.0 * (0.2 + t) - t, 3.0 * (0.1 + t)]
}

/// Pressed on a part of the top, out of the middle, and pushed to the side: films open and slide.
fn pushed(t: f64, films: Films) -> Scene {
    let [width, height] = size(t);
    wall(t, 0.4, [2, 1], films)
        .load(Load::pressure("top", [0.55 * width, height], [width, height], 100.0))
        .load(Load::traction("left", [0.0, t], [0.0, height], [25.0, 0.0]))
}

/// Pressed from above, more to the right, and from both sides, with so much friction that nothing moves.
fn pressed(mesh: [u32; 2]) -> Scene {
    let t = 0.02;
    let [width, height] = size(t);
    wall(t, 5.0, mesh, Films::Strips)
        .load(Load::pressure("top", [0.0, height], [width, height], 100.0))
        .load(Load::traction("more", [0.5 * width, height], [width, height], [10.0, -40.0]))
        .load(Load::pressure("left", [0.0, t], [0.0, height], 60.0))
        .load(Load::pressure("right", [width, t], [width, height], 60.0))
}

fn count(outcome: &Outcome, status: PointStatus) -> usize {
    state(outcome).contacts.iter().filter(|contact| contact.status == status).count()
}

/// A wall of which no film opens or slides is linear, and known from elements and films alone.
#[test]
fn a_pressed_wall_is_the_linear_one() {
    for mesh in [[1, 1], [3, 2]] {
        let outcome = solved(&pressed(mesh));
        let (model, points) = (&outcome.model, outcome.model.contacts.len());
        assert_eq!(count(&outcome, PointStatus::Stick), points);
        let nodes = Nodes::of(model);
        let mut k = nodes.stiffness(model);
        nodes.parts(model).iter().for_each(|part| part.add_bonded(model, &mut k));
        let f = nodes.loads(model);
        let u = k.cholesky().unwrap().solve(&f);
        let found = nodes.gathered(&state(&outcome).displacements);
        assert!((&found - &u).amax() < 1e-10 * u.amax(), "{:e}", (&found - &u).amax() / u.amax());
        assert_close(state(&outcome).strain_energy, 0.5 * f.dot(&u), 1e-10);
        assert_films_balance(&outcome, 1e-8);
        assert_energy(&outcome, 1e-9);
    }
}

/// The films of a wall in which some open and some slide, against their law at Gauss points.
#[test]
fn the_law_of_strips_holds_where_films_open_and_slide() {
    for t in [0.02, 0.005] {
        let outcome = solved(&pushed(t, Films::Strips));
        for status in [PointStatus::Open, PointStatus::Stick, PointStatus::Slip] {
            assert!(count(&outcome, status) > 3, "{status:?}: {}", count(&outcome, status));
        }
        assert_films_balance(&outcome, 1e-8);
        assert_energy(&outcome, 1e-9);
    }
}

#[test]
fn all_routes_agree() {
    let reference = solved(&pushed(0.02, Films::Strips).route(Route::Lemke).form(Form::Mixed));
    assert_eq!(reference.plan.order, reference.solve.order);
    let routes = common::routes::ROUTES;
    for route in routes {
        let other = solved(&pushed(0.02, Films::Strips).route(route));
        assert_eq!(other.plan.order, other.solve.order);
        for of in [all_displacements, all_stresses, all_reactions, film_stresses] {
            let apart = difference(&of(&reference), &of(&other));
            assert!(apart < 1e-7, "{route:?}: {apart:e}");
        }
        assert_close(state(&other).strain_energy, state(&reference).strain_energy, 1e-7);
        assert_energy(&other, 1e-7);
    }
}

/// Pushed, and let go: films have slid, and their law goes on from there.
#[test]
fn strips_keep_their_slip_in_a_load_history() {
    let with_top = |name, left| Stage::new(name).load("top", 1.0).load("left", left);
    let scene = pushed(0.02, Films::Strips);
    let pushed = scene.clone().stage(with_top("push", 1.0));
    let before = solved(&pushed);
    let after = solved(&pushed.stage(with_top("back", 0.2)));
    let slips: Vec<f64> = state(&before).contacts.iter().map(|contact| contact.y_t).collect();
    assert_films_balance(&before, 1e-8);
    assert_films_balance_after(&after, &slips, 1e-8);
    let at_once = solved(&scene.stage(with_top("at once", 0.2)));
    assert!(difference(&all_displacements(&at_once), &all_displacements(&after)) > 1e-2);
}

/// The dry wall is the limit of thin films; what is left is in proportion to the thickness, and the terms along the
/// joints are as well. Bricks keep their size, so that the wall grows with its joints.
#[test]
fn thin_strips_are_dry_joints() {
    let at = |t: f64, films| {
        let [width, height] = size(t);
        let scene = wall(t, 0.7, [2, 1], films)
            .load(Load::pressure("top", [0.0, height], [width, height], 100.0))
            .load(Load::traction("left", [0.0, t], [0.0, height], [40.0, 0.0]));
        all_displacements(&solved(&scene))
    };
    let dry = at(0.0, Films::Strips);
    let largest = DVector::from_column_slice(&dry).amax();
    let rate = |t: f64, films| -> DVector<f64> {
        DVector::from_column_slice(&at(t, films)) - DVector::from_column_slice(&dry)
    };
    for films in [Films::Strips, Films::Compliance] {
        let rates = [1e-5, 1e-6, 1e-7].map(|t| rate(t, films) / t);
        assert!(rates[2].amax() > largest);
        for (rate, bound) in rates.iter().zip([1e-2, 1e-3]) {
            let apart = (rate - &rates[2]).amax() / rates[2].amax();
            assert!(apart < bound, "{films:?}: {apart:e}");
        }
    }
    let [thin, thinner] =
        [1e-5, 1e-6].map(|t| (rate(t, Films::Strips) - rate(t, Films::Compliance)) / t);
    assert!((&thin - &thinner).amax() < 1e-2 * thin.amax());
}

fn effect(outcome: &Plan) -> Effect {
    let named = |effect: &&Effect| effect.name == "longitudinal film terms";
    outcome.effects.iter().find(named).unwrap().clone()
}

/// Rigid blocks stretch no film: both kinds of films are the same then, but for the stress along them.
#[test]
fn only_elastic_blocks_stretch_films() {
    let rigid = |films| {
        let mut scene = pushed(0.02, films);
        scene.materials.insert("brick".to_owned(), Material::rigid());
        solved(&scene)
    };
    let (strips, springs) = (rigid(Films::Strips), rigid(Films::Compliance));
    assert_eq!(all_displacements(&strips), all_displacements(&springs));
    assert!(System::new(&strips.model).unwrap().stretches.is_empty());
    let off = effect(&strips.plan);
    assert!(!off.on && off.because.contains("rigid"), "{}", off.because);
    for (strip, spring) in state(&strips).films.iter().zip(&state(&springs).films) {
        // Held along the joint, in plane stress.
        assert!(
            (strip.sigma_x.unwrap() - 0.3 * strip.sigma_y).abs() <= 1e-12 * strip.sigma_y.abs()
        );
        assert!(spring.sigma_x.is_none());
    }
}

#[test]
fn nothing_is_built_of_strips_unless_asked_for() {
    let parts = |model: &Model| {
        let system = System::new(model).unwrap();
        let of_bodies: usize = system.bodies.iter().map(|body| body.stretches.len()).sum();
        (system.stretches.len(), of_bodies)
    };
    let plan_of = |scene: &Scene| {
        let model = Model::from_scene(scene).unwrap();
        (Plan::of(scene, &model), model)
    };
    let (plan, model) = plan_of(&pushed(0.02, Films::Strips));
    let points = model.contacts.len();
    let on_floor = model.joints.iter().filter(|it| matches!(it.a, Body::Support(_))).count();
    assert!(on_floor > 0);
    let sides: usize = model.contacts.iter().map(|it| 1 + usize::from(it.a.is_some())).sum();
    assert_eq!(parts(&model), (points, sides));
    let on = effect(&plan);
    assert!(on.on && on.unknowns == 0);
    assert!(on.because.contains(&format!("{points} bars")), "{}", on.because);
    let mixed = pushed(0.02, Films::Strips).route(Route::Lemke).form(Form::Mixed);
    assert_eq!(effect(&plan_of(&mixed).0).unknowns, 2 * points);

    let (plan, model) = plan_of(&pushed(0.02, Films::Compliance));
    assert_eq!(parts(&model), (0, 0));
    let off = effect(&plan);
    assert!(!off.on && off.because.contains("\"compliance\""), "{}", off.because);

    let (plan, model) = plan_of(&pushed(0.0, Films::Strips));
    assert_eq!(parts(&model), (0, 0));
    let off = effect(&plan);
    assert!(!off.on && off.because.contains("no mortar films"), "{}", off.because);
}

#[test]
fn reports_show_the_stress_along_strips() {
    let text = |films| {
        let outcome = solved(&pushed(0.02, films));
        let csv = masonry_report::csv::contacts(&outcome.model, state(&outcome));
        let json = masonry_report::json::result(&outcome, &[]).unwrap();
        let head = csv.lines().next().unwrap().to_owned();
        (head, masonry_report::table::report(&outcome), json, outcome)
    };
    let (head, table, json, outcome) = text(Films::Strips);
    let columns = "status,film_sigma_x_kN/m2,film_sigma_y_kN/m2,film_tau_kN/m2";
    assert!(head.ends_with(columns), "{head}");
    assert!(table.contains(" along films"), "{table}");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let all = state(&outcome).films.iter().map(|film| film.sigma_x.unwrap());
    let largest = all.fold(0.0, |m: f64, s| if s.abs() > m.abs() { s } else { m });
    assert_close(json["films"]["sigma_x"].as_f64().unwrap(), largest / 1e3, 1e-12);

    let (head, table, json, _) = text(Films::Compliance);
    assert!(head.ends_with("status,film_sigma_y_kN/m2,film_tau_kN/m2"), "{head}");
    assert!(!table.contains("along films"));
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(json["films"].get("sigma_x").is_none() && json["films"].get("tau_max").is_some());
}
