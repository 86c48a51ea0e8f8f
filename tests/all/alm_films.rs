//! Whole films in the augmented Lagrangian method: panels of the paper with one element per brick, closed forms
//! of energy, bonded panels known from elsewhere, contact points as the limit of stiff bricks, and films that are
//! brought up to date as printed.

mod printed;
#[path = "../../masonry/tests/all/common/updating.rs"]
mod updating;

use crate::common;

use std::ops::ControlFlow;

use common::films::film_stresses;
use common::{
    M_KN, all_displacements, all_stresses, assert_close, difference, panels, solved, state,
};
use lcp::{Contact2d, Status};
use masonry::analysis::outcome::Reaction;
use masonry::data::state::PointStatus;
use masonry::model::joints::PointRule;
use masonry::model::{Model, Plane};
use masonry::paper::alm::{AlmAnswer, AlmError, AlmSettings, MortaredState, MortaredWall};
use masonry::scene::{Brick, Films, Joint, Load, Material, Route, Scene, Support, Wall};
use masonry_report::summary;
use nalgebra::{DMatrix, DVector};
use printed::{Updated, Updates};
use updating::{Settling, Updating};

const PANELS: [&str; 2] = ["panel_square_mortar", "panel_rectangular_mortar"];

/// A panel of the paper with this many elements per brick.
fn panel(name: &str, mesh: [u32; 2]) -> Model {
    let mut scene = panels::scene(name);
    scene.walls[0].mesh = Some(mesh);
    let scene = scene.contact_points(PointRule::Gauss).films(Films::Strips);
    Model::from_scene(&scene).unwrap()
}

fn answer(wall: &MortaredWall, tolerance: f64) -> AlmAnswer {
    let settings = AlmSettings { tolerance, ..AlmSettings::default() };
    let answer = wall.solve(&settings, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(answer.status, Status::Solved, "{:?}", answer.convergence.last());
    answer
}

fn stresses(state: &MortaredState) -> Vec<f64> {
    state.state.stresses.iter().flat_map(|it| it.sigma).collect()
}

/// Unlike with contact points, the displacements of the bricks are all unknowns there are.
#[test]
fn panels_with_one_element_per_brick() {
    for (name, bricks) in PANELS.into_iter().zip([126, 71]) {
        let model = panel(name, [1, 1]);
        let wall = MortaredWall::new(&model).unwrap();
        assert_eq!(wall.without_films().displacements(), 8 * bricks);
        let [rough, fine, finest] = [1e-4, 1e-8, 1e-10].map(|tolerance| answer(&wall, tolerance));
        let last = fine.convergence.last().unwrap();
        assert!(last.unbalance <= 1e-8 && last.attempt == 1, "{last:?}");
        assert!(fine.residuals.worst() <= 1e-8, "{:?}", fine.residuals);
        // A few states of films are left to find when the force is balanced to 1e-4.
        assert!(fine.factorisations < rough.factorisations + 5);
        let [rough, fine, finest] = [rough, fine, finest].map(|answer| wall.state(&answer));
        let exact = stresses(&finest);
        assert!(difference(&exact, &stresses(&rough)) < 3e-4);
        assert!(difference(&exact, &stresses(&fine)) < 3e-8);

        // The static law is of first degree, so that the work of the loads is twice the energy and what
        // sliding takes.
        let dissipated = fine.film_dissipation + fine.contact_dissipation;
        assert!(fine.film_dissipation > 0.0 && fine.contact_dissipation > 0.0);
        assert_close(2.0 * fine.state.strain_energy + dissipated, fine.work, 1e-8);

        let load = summary::applied_load(&model);
        let sum = |part: fn(&Reaction) -> f64| -> f64 { fine.reactions.iter().map(part).sum() };
        assert_close(sum(|it| it.fy), -load.force.y, 1e-7);
        assert!((sum(|it| it.m) + load.moment).abs() < 1e-7 * load.moment.abs());
        let named = |name: &str| fine.reactions.iter().find(|it| it.support == name).unwrap();
        let (left, right) = (named("left wall"), named("right wall"));
        assert_close(left.fx, -right.fx, 1e-6);
        assert_close(left.fy, right.fy, 1e-6);

        let points = || fine.films.iter().flat_map(|film| &film.points);
        for state in [PointStatus::Open, PointStatus::Stick, PointStatus::Slip] {
            assert!(points().any(|point| point.contact == state), "{state:?}");
        }
        assert!(points().all(|point| point.stress.y <= 0.0 && point.dissipation >= 0.0));
    }
}

/// The same strips as contact points with bars beside them, in a complementarity problem that has nothing in
/// common with this method but the elements of the bricks: one answer, but for where force is shifted between the
/// two faces of a lower corner brick.
#[test]
fn strips_as_by_complementarity() {
    for name in ["panel_square_mortar_open", "panel_rectangular_mortar_open"] {
        let outcome = solved(&panels::scene(name).route(Route::Interior));
        let wall = MortaredWall::new(&outcome.model).unwrap();
        let whole = wall.state(&answer(&wall, 1e-9));
        let in_films: Vec<f64> = whole
            .films
            .iter()
            .flat_map(|film| &film.points)
            .flat_map(|point| [point.stress.x, point.stress.y, point.stress.z])
            .collect();
        for (what, expected, found) in [
            ("stresses", all_stresses(&outcome), stresses(&whole)),
            ("films", film_stresses(&outcome), in_films),
            ("sides", panels::sides(&outcome.reactions), panels::sides(&whole.reactions)),
        ] {
            let apart = difference(&expected, &found);
            assert!(apart < 1e-8, "{name}, {what}: {apart:e}");
        }
        assert_close(whole.state.strain_energy, state(&outcome).strain_energy, 1e-8);
    }
}

/// Films are divided at the nodes of both bricks.
#[test]
fn finer_bricks_change_little() {
    let [coarse, fine] = [[1, 1], [4, 2]].map(|mesh| {
        let wall = MortaredWall::new(&panel(PANELS[1], mesh)).unwrap();
        let state = wall.state(&answer(&wall, 1e-6));
        (wall.films().len(), state)
    });
    assert!(coarse.0 == 180 && fine.0 > 2 * 180);
    assert!(fine.1.work > coarse.1.work);
    assert_close(fine.1.work, coarse.1.work, 0.1);
}

/// Displacements with all films bonded and some held, as the loads make them.
fn bonded(problem: &Contact2d, is_held: &[bool]) -> DVector<f64> {
    let n = problem.displacements();
    let mut k = DMatrix::zeros(n, n);
    problem.stiffness().triplet_iter().for_each(|e| k[(e.row, e.col)] += e.val);
    let mut f = DVector::from_column_slice(problem.loads());
    for j in (0..n).filter(|j| is_held[*j]) {
        k.row_mut(j).fill(0.0);
        k.column_mut(j).fill(0.0);
        (k[(j, j)], f[j]) = (1.0, 0.0);
    }
    k.cholesky().unwrap().solve(&f)
}

/// Found independently by another program, with the load on the joints of the top course, too.
#[test]
fn bonded_panels_have_the_known_displacement_and_energy() {
    for (name, foot, largest, energy) in [
        (PANELS[0], 0.1, 7.761_484_33e-5, 2.941_520_80e-4),
        (PANELS[1], 0.2, 7.876_108_11e-5, 3.167_844_15e-4),
    ] {
        let model = panel(name, [1, 1]);
        let wall = MortaredWall::new(&model).unwrap();
        let problem = wall.with_parts(&wall.bonded()).unwrap();
        let nodes: Vec<_> =
            model.blocks.iter().flat_map(|it| it.mesh.as_ref().unwrap().nodes.clone()).collect();
        let is_held: Vec<bool> = nodes
            .iter()
            .flat_map(|p| {
                let in_foot = p.x < foot + 1e-9 || p.x > 1.3 - foot - 1e-9;
                [p.x < 1e-9 || p.x > 1.3 - 1e-9 || (p.y < 1e-9 && in_foot); 2]
            })
            .collect();
        let u = bonded(&problem, &is_held);
        let work: f64 = u.iter().zip(problem.loads()).map(|(u, f)| u * f).sum();
        assert!((u.amax() / largest - 1.0).abs() < 1e-8, "{:e} against {largest:e}", u.amax());
        assert!((0.5e-3 * work / energy - 1.0).abs() < 1e-8, "{work:e} against {energy:e}");
    }
}

/// Four courses pushed to the side; the films are soft against the bricks.
fn stiff(brick: f64) -> Scene {
    let t = 0.02;
    let class = || Joint::mu(0.7).mortar(t, "mortar");
    let shape = Brick { length: 0.2, height: 0.1 };
    let (width, height) = (3.0 * (0.2 + t) - t, 4.0 * (0.1 + t) - t);
    Scene::new("Wall", M_KN)
        .plane(Plane::Stress)
        .thickness(0.25)
        .material("brick", Material::elastic(brick, 0.15))
        .material("mortar", Material::elastic(8e5, 0.2))
        .joint("bed", class())
        .joint("head", class())
        .joint("floor", Joint::mu(0.7))
        .wall(Wall::running_bond("wall", "brick", shape, width, 4).mesh([1, 1]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .load(Load::pressure("top", [0.0, height], [width, height], 100.0))
        .load(Load::traction("side", [0.0, 0.0], [0.0, height], [30.0, 0.0]))
        .contact_points(PointRule::Gauss)
}

/// Bricks that do not stretch their films along the joint leave the terms without work that contact points lack.
#[test]
fn contact_points_are_the_limit_of_stiff_bricks() {
    let errors = [5e7, 5e8].map(|brick| {
        let scene = stiff(brick);
        let by_points = solved(&scene.clone().route(Route::Interior));
        let strips = Model::from_scene(&scene.films(Films::Strips)).unwrap();
        let wall = MortaredWall::new(&strips).unwrap();
        let state = wall.state(&answer(&wall, 1e-8));
        let whole: Vec<f64> =
            state.state.displacements.iter().flatten().flat_map(|u| [u.x, u.y]).collect();
        difference(&all_displacements(&by_points), &whole)
    });
    assert!(errors[0] < 0.02 && errors[1] < 0.2 * errors[0], "{errors:?}");
}

/// Dropping a part with all it carries makes forces jump: the updates of the printed method come back after two,
/// shorter ones go on moving, and neither is called solved. The criterion of the law has no jump and settles.
#[test]
fn films_updated_as_printed_do_not_settle() {
    let wall = MortaredWall::new(&panel(PANELS[1], [1, 1])).unwrap();
    let settings = AlmSettings::default();
    let by = |updates: Updates| Updated::of(&wall, &settings, &updates);
    let printed = by(Updates::default());
    assert_eq!(printed.settling, Settling::Cycle { period: 2 });
    assert_eq!((printed.status, printed.answer.status), (Status::Cycling, Status::Solved));
    // A twelfth of all films comes and goes.
    assert!(printed.moved[10..].iter().all(|moved| *moved > 0.05), "{:?}", printed.moved);

    let relaxations: &[f64] = if cfg!(feature = "long-tests") { &[0.5, 0.2] } else { &[0.5] };
    for &relaxation in relaxations {
        let relaxed = by(Updates { relaxation, ..Updates::default() });
        assert_eq!((relaxed.status, relaxed.settling), (Status::IterationLimit, Settling::Moving));
        // What moves becomes less by the relaxation, not by the updates.
        let late = &relaxed.moved[20..];
        assert!(late.iter().all(|moved| *moved > 0.005 * relaxation), "{late:?}");
    }

    let settled = by(Updates { updating: Updating::Pointwise, ..Updates::default() });
    assert_eq!((settled.status, settled.settling), (Status::Solved, Settling::Settled));
    assert!(settled.moved.windows(2).skip(4).all(|moved| moved[1] < 0.5 * moved[0]));
    assert!(settled.parts.iter().any(Option::is_none));
    assert!(settled.parts.iter().flatten().all(|[from, to]| from < to));
}

#[test]
fn misuse_is_said() {
    let mut rigid = stiff(5e7).films(Films::Strips);
    rigid.materials.insert("brick".to_owned(), Material::rigid());
    let error = MortaredWall::new(&Model::from_scene(&rigid).unwrap()).unwrap_err();
    assert!(matches!(error, AlmError::Rigid { .. }), "{error}");
    assert!(error.to_string().contains("elastic modulus"));
}
