//! Mortar films in scenes: closed forms, the panels in mortar, and the dry answer as their limit.

use crate::common;

use std::ops::ControlFlow;
use std::sync::LazyLock;

use common::routes::{ROUTES, rounding, routes_for, solved_by};
use common::{
    M_KN, assert_close, block_named, displacements, panels, rectangle, solved, stands, state,
};
use lcp::{InteriorPoint, Solver};
use masonry::analysis::outcome::{Outcome, PointStatus};
use masonry::forms::Sparse;
use masonry::ids::FilmId;
use masonry::model::joints::PointRule;
use masonry::model::{Body, Model, Plane};
use masonry::paper::alm::{self, AlmError, AlmSettings};
use masonry::plan::Plan;
use masonry::recover;
use masonry::scene::{Brick, Joint, Load, Material, Route, Scene, Support, Wall};
use masonry::system::System;
use masonry_report::summary;
use nalgebra::Vector2;

const BRICK: f64 = 5e6;
const MORTAR: f64 = 8e5;

fn scene(title: &str, brick: Material, mortar: Material) -> Scene {
    Scene::new(title, M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .material("brick", brick)
        .material("mortar", mortar)
}

/// Three bricks, with films between them and below the lowest.
#[test]
fn a_column_of_bricks_and_films_shortens_by_the_sum() {
    let (h, t, pressure) = (0.3, 0.01, 1e3);
    let brick = |name: &str, k: f64| {
        let low = t + k * (h + t);
        rectangle(name, "brick", [0.0, 0.4], [low, low + h]).mesh([2, 1])
    };
    let top = 3.0 * (h + t);
    for points in [PointRule::Vertices, PointRule::NodalPairs, PointRule::Gauss] {
        let column = scene("Column", Material::elastic(BRICK, 0.0), Material::elastic(MORTAR, 0.0))
            .joint("bed", Joint::mu(0.6).mortar(t, "mortar"))
            .block(brick("1", 0.0))
            .block(brick("2", 1.0))
            .block(brick("3", 2.0))
            .support(Support::new("floor", [0.0, 0.0], [0.4, 0.0], "bed"))
            .load(Load::pressure("top", [0.0, top], [0.4, top], pressure))
            .contact_points(points);
        let expected = -pressure * (3.0 * h / BRICK + 3.0 * t / MORTAR);
        for route in ROUTES {
            let outcome = solved_by(&column, route);
            let near = rounding(route);
            for u in &displacements(&outcome, "3")[3..] {
                assert_close(u.y, expected, near);
            }
            let films = &state(&outcome).films;
            assert_eq!(films.len(), outcome.model.contacts.len());
            for film in films {
                assert!((film.sigma_y / 1e3 + pressure).abs() < 10.0 * near * pressure);
                assert!(film.tau.abs() < 1e4 * near * pressure);
            }
            let work = 0.5 * pressure * 0.4 * 0.25 * -expected;
            assert_close(state(&outcome).strain_energy / 1e3, work, near);
        }
    }
}

/// A rigid block on a film, pressed, and sheared without a moment about the middle of the film: side
/// loads take that of the load on top.
fn sheared(share: f64) -> Scene {
    let (b, h, t, pressure, mu) = (0.4, 0.3, 0.02, 50.0, 0.6);
    let tau = share * mu * pressure;
    let side = tau * (h + 0.5 * t) / h;
    scene("Film in shear", Material::rigid(), Material::elastic(MORTAR, 0.2))
        .joint("floor", Joint::mu(mu).mortar(t, "mortar"))
        .block(rectangle("block", "brick", [0.0, b], [t, t + h]))
        .support(Support::new("floor", [-1.0, 0.0], [1.0, 0.0], "floor"))
        .load(Load::traction("top", [0.0, t + h], [b, t + h], [tau, -pressure]))
        .load(Load::traction("left", [0.0, t], [0.0, t + h], [0.0, -side]))
        .load(Load::traction("right", [b, t], [b, t + h], [0.0, side]))
}

#[test]
fn a_film_in_shear_is_a_spring_up_to_the_bound_of_friction() {
    for share in [0.5, -0.999] {
        let outcome = solved(&sheared(share));
        let tau = share * 0.6 * 50.0;
        let shear_modulus = MORTAR / 2.4;
        // Plane stress, and no strain along the joint.
        let across = MORTAR / (1.0 - 0.04);
        for u in displacements(&outcome, "block") {
            assert_close(u.x, tau * 0.02 / shear_modulus, 1e-11);
            assert_close(u.y, -50.0 * 0.02 / across, 1e-11);
        }
        for (film, contact) in state(&outcome).films.iter().zip(&state(&outcome).contacts) {
            assert_close(film.tau / 1e3, tau, 1e-11);
            assert_close(film.sigma_y / 1e3, -50.0, 1e-11);
            assert_eq!((film.film, contact.status), (FilmId(0), PointStatus::Stick));
        }
    }
    assert!(!stands(&sheared(1.001)) && !stands(&sheared(-1.001)));
}

/// `p = N / b (1 + 6 e / b)` at the edges of a rigid block on a film, so at the two Gauss points, which
/// integrate the film exactly, by the distance from the middle.
#[test]
fn pressure_below_an_eccentric_load_within_the_kern() {
    let (b, t) = (0.6, 0.02);
    let base = scene("Kern", Material::rigid(), Material::elastic(MORTAR, 0.0))
        .joint("floor", Joint::mu(0.5).mortar(t, "mortar"))
        .block(rectangle("block", "brick", [0.0, b], [t, 0.5]))
        .support(Support::new("floor", [0.0, 0.0], [b, 0.0], "floor"))
        .contact_points(PointRule::Gauss);
    for e in [0.0, 0.05, 0.1] {
        let loaded = [0.5 * b + e - 0.15, 0.5 * b + e + 0.15].map(|x: f64| [x.min(b), 0.5]);
        let outcome =
            solved(&base.clone().load(Load::pressure("top", loaded[0], loaded[1], 100.0)));
        for film in &state(&outcome).films {
            let x = outcome.model.contacts[film.contact.index()].position.x - 0.5 * b;
            let expected = -100.0 * 0.3 / b * (1.0 + 12.0 * e * x / (b * b));
            assert_close(film.sigma_y / 1e3, expected, 1e-10);
        }
    }
}

/// Four courses of three bricks, pushed to the side, with joints of thickness `t`.
fn wall(t: f64, mortared: bool) -> Scene {
    let class = || if mortared { Joint::mu(0.7).mortar(t, "mortar") } else { Joint::mu(0.7) };
    let brick = Brick { length: 0.2, height: 0.1 };
    let (width, height) = (3.0 * (0.2 + t) - t, 4.0 * (0.1 + t) - t);
    scene("Wall", Material::elastic(BRICK, 0.15), Material::elastic(MORTAR, 0.2))
        .joint("bed", class())
        .joint("head", class())
        .joint("floor", Joint::mu(0.7))
        .wall(Wall::running_bond("wall", "brick", brick, width, 4).mesh([2, 1]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .load(Load::pressure("top", [0.0, height], [width, height], 100.0))
        .load(Load::traction("side", [0.0, 0.0], [0.0, height], [30.0, 0.0]))
}

fn moved(outcome: &Outcome) -> Vec<f64> {
    state(outcome).displacements.iter().flatten().flat_map(|u| [u.x, u.y]).collect()
}

#[test]
fn a_film_without_thickness_is_a_dry_joint() {
    let (dry, zero) = (solved(&wall(0.0, false)), solved(&wall(0.0, true)));
    assert_eq!(moved(&dry), moved(&zero));
    assert!(state(&zero).films.is_empty());
    assert!(zero.model.joints.iter().all(|joint| joint.film.is_none()));
    assert!(zero.model.contacts.iter().all(|contact| contact.film.is_none()));
    let dry = moved(&dry);
    let largest = dry.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    let change = |t| -> Vec<f64> {
        moved(&solved(&wall(t, true))).iter().zip(&dry).map(|(u, v)| (u - v) / t).collect()
    };
    // Per thickness the change is the same, but for what is of second order.
    let changes = [1e-6, 1e-5, 1e-4, 1e-3].map(change);
    let rate = changes[0].iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    assert!(rate > largest);
    let apart: Vec<f64> =
        changes[1..].iter().map(|change| common::difference(&changes[0], change)).collect();
    assert!(apart[0] < 1e-3, "{apart:?}");
    for pair in apart.windows(2) {
        let order = (pair[1] / pair[0]).log10();
        assert!((order - 1.0).abs() < 0.1, "{apart:?}");
    }
}

/// Displacements, seen from both faces of every film, and its forces belong together; all of it
/// balances, moments too.
#[test]
fn films_give_way_by_their_compliance() {
    let outcome = solved(&wall(0.02, true));
    let (model, state) = (&outcome.model, state(&outcome));
    let largest = moved(&outcome).iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    for (contact, s) in model.contacts.iter().zip(&state.contacts) {
        let joint = &model.joints[contact.joint.index()];
        let apart = recover::relative_displacement(model, &state.displacements, contact);
        let [normal, shear] = contact.film.map_or([0.0; 2], |film| film.compliance);
        assert!((apart.dot(&joint.normal) + normal * s.t_n - s.y_n).abs() < 1e-10 * largest);
        assert!((apart.dot(&joint.tangent()) + shear * s.t_t - s.y_t).abs() < 1e-10 * largest);
    }
    let (sum, load) = (summary::total_reaction(&outcome), summary::applied_load(model));
    assert!((sum.force + load.force).norm() < 1e-9 * load.force.norm());
    assert!((sum.moment + load.moment).abs() < 1e-9 * load.moment.abs());
}

/// The whole turned or moved as one body strains no film.
#[test]
fn rigid_motions_strain_no_film() {
    let model = Model::from_scene(&wall(0.02, true)).unwrap();
    let motion = |p: nalgebra::Point2<f64>| Vector2::new(0.3 - p.y, 0.7 + p.x);
    let moved: Vec<Vec<Vector2<f64>>> = model
        .blocks
        .iter()
        .map(|block| block.mesh.as_ref().unwrap().nodes.iter().map(|p| motion(*p)).collect())
        .collect();
    let between_blocks = model.contacts.iter().filter(|contact| contact.a.is_some());
    assert!(between_blocks.clone().all(|contact| contact.film.is_some()));
    for contact in between_blocks {
        assert!(recover::relative_displacement(&model, &moved, contact).norm() < 1e-14);
    }
    let system = System::new(&model).unwrap();
    let mut y = vec![0.0; system.rows.len()];
    for (body, u) in system.bodies.iter().zip(&moved) {
        for row in &body.rows {
            y[row.row] += row.entries.iter().map(|(k, c)| c * u[k / 2][k % 2]).sum::<f64>();
        }
    }
    for (row, y) in system.rows.iter().zip(&y) {
        let contact = &model.contacts[row.contact.index()];
        assert!(contact.a.is_none() || y.abs() < 1e-14);
    }
}

/// Elastic bricks in mortar, and rigid ones, which the films alone let move.
#[test]
fn all_routes_have_the_same_answer() {
    let mut rigid = wall(0.02, true);
    rigid.materials.insert("brick".to_owned(), Material::rigid());
    for scene in [wall(0.02, true), rigid] {
        let reference = solved(&scene.clone().route(Route::Lemke));
        let largest = moved(&reference).iter().fold(0.0, |m: f64, u| m.max(u.abs()));
        assert!(largest > 0.0);
        for route in routes_for(&scene) {
            let other = solved_by(&scene, route);
            assert_eq!(other.plan.order, other.solve.order);
            for (a, b) in moved(&reference).iter().zip(&moved(&other)) {
                assert!((a - b).abs() < 1e-7 * largest, "{route:?}: {a:e} and {b:e}");
            }
            let energy = state(&reference).strain_energy;
            assert_close(state(&other).strain_energy, energy, 1e-7);
            assert_eq!(state(&other).films.len(), state(&reference).films.len());
        }
    }
}

#[test]
fn the_sparse_problem_has_the_same_answer() {
    let outcome = solved(&wall(0.02, true));
    let system = System::new(&outcome.model).unwrap();
    let sparse = Sparse::new(&system).unwrap();
    let with_free_faces = Sparse::with_free_faces(&system).unwrap();
    let solution = InteriorPoint::default().solve(&sparse.problem).unwrap();
    assert!(solution.is_solved());
    let found = sparse.problem.recover(&solution.t, &solution.y);
    let observer = &mut |_: &_| ControlFlow::Continue(());
    let refused = alm::solve(&sparse.problem, &AlmSettings::default(), observer).unwrap_err();
    assert!(matches!(refused, AlmError::Compliance { contact: 0 }), "{refused}");
    let augmented =
        alm::solve(&with_free_faces.problem, &AlmSettings::default(), observer).unwrap();
    assert_eq!(augmented.status, lcp::Status::Solved);
    let largest = moved(&outcome).iter().fold(0.0, |m: f64, u| m.max(u.abs()));
    for (k, u) in state(&outcome).displacements.iter().enumerate() {
        for (found, tolerance) in [(&found, 1e-7), (&augmented.state, 1e-5)] {
            for (node, other) in u.iter().zip(sparse.of_block(k, &found.u).chunks(2)) {
                let error = (node - Vector2::new(other[0], other[1])).amax();
                assert!(error < tolerance * largest, "{error:e} of {largest:e}");
            }
        }
    }
}

fn by_points(name: &str) -> Outcome {
    solved_by(&panels::scene(name), Route::Interior)
}

static SQUARE: LazyLock<Outcome> = LazyLock::new(|| by_points("panel_square_mortar"));
static RECTANGULAR: LazyLock<Outcome> = LazyLock::new(|| by_points("panel_rectangular_mortar"));

/// Bricks and films of the panels, and 24 dry joints at the walls and feet.
#[test]
fn panels_have_the_bricks_and_films_of_the_paper() {
    for (name, bricks, films) in
        [("panel_square_mortar", 126, 335), ("panel_rectangular_mortar", 71, 180)]
    {
        let model = Model::from_scene(&panels::scene(name)).unwrap();
        let filled: Vec<_> = model.joints.iter().filter_map(|joint| joint.film).collect();
        assert_eq!(
            (model.blocks.len(), filled.len(), model.joints.len()),
            (bricks, films, films + 24)
        );
        assert!(filled.iter().enumerate().all(|(k, film)| film.id == FilmId::new(k)));
        let corners = || model.blocks.iter().flat_map(|block| &block.corners);
        let size = corners().fold([0.0, 0.0], |[x, y]: [f64; 2], p| [x.max(p.x), y.max(p.y)]);
        assert!((size[0] - 1.3).abs() < 1e-14 && (size[1] - 1.3).abs() < 1e-14);
        for joint in &model.joints {
            let [face_a, face_b] = joint.faces();
            let across = (face_b[0] - face_a[0]).dot(&joint.normal);
            let expected = if matches!(joint.a, Body::Block(_)) { 0.02 } else { 0.0 };
            assert!((across - expected).abs() < 1e-14);
        }
        assert!(model.contacts.iter().all(|contact| contact.gap <= 0.0));
    }
}

#[test]
fn panels_in_mortar_balance() {
    for (outcome, load) in [(&*SQUARE, 11e3), (&*RECTANGULAR, 12e3)] {
        let named = |name: &str| outcome.reactions.iter().find(|r| r.support == name).unwrap();
        assert_close(outcome.reactions.iter().map(|r| r.fy).sum(), load, 1e-9);
        let (left, right) = (named("left wall"), named("right wall"));
        assert!((left.fx + right.fx).abs() <= 1e-9 * left.fx);
        for wall in [left, right] {
            assert!(wall.fy.abs() <= wall.fx.abs() * (1.0 + 1e-9));
        }
        let (sum, load) = (summary::total_reaction(outcome), summary::applied_load(&outcome.model));
        assert!((sum.moment + load.moment).abs() < 1e-9 * load.moment.abs());
    }
}

#[test]
fn the_plan_and_the_files_tell_of_films() {
    let effect = |outcome: &Outcome| {
        let effects = outcome.plan.effects.iter();
        effects.clone().find(|effect| effect.name == "mortar films").unwrap().clone()
    };
    let films = effect(&SQUARE);
    assert!(films.on);
    assert!(films.because.contains("bed, head: 335 films"), "{}", films.because);
    let text = masonry_report::table::report(&SQUARE);
    assert!(text.contains("film compression") && text.contains("film shear"), "{text}");
    let csv = |outcome: &Outcome| masonry_report::csv::contacts(&outcome.model, state(outcome));
    let head = "mu,status,film_sigma_y_kN/m2,film_tau_kN/m2";
    assert!(csv(&SQUARE).lines().next().is_some_and(|line| line.ends_with(head)));

    let model = Model::from_scene(&panels::scene("panel_square_mortar")).unwrap();
    let points = model.contacts.iter().filter(|contact| contact.film.is_some()).count();
    for (route, unknowns) in [(Route::Lemke, 0), (Route::Interior, 0), (Route::Alm, 2 * points)] {
        let plan = Plan::of(&panels::scene("panel_square_mortar").route(route), &model);
        let films = plan.effects.iter().find(|effect| effect.name == "mortar films").unwrap();
        assert_eq!(films.unknowns, unknowns, "{route:?}");
    }

    let dry = solved(&wall(0.0, false));
    let films = effect(&dry);
    assert!(!films.on && films.because.contains("dry"), "{}", films.because);
    assert!(!csv(&dry).contains("film"));
    assert!(!masonry_report::table::report(&dry).contains("film compression"));
    let system = System::new(&dry.model).unwrap();
    assert!(system.rows.iter().all(|row| row.compliance <= 0.0));
    let unknowns: usize = system.bodies.iter().map(|body| body.load.len()).sum();
    assert_eq!(Sparse::new(&system).unwrap().problem.displacements(), unknowns);
    assert_eq!(block_named(&dry.model, "wall/1/1").index(), 0);
}
