//! What accuracy costs: a record for every combination, errors against a reference, what fails included; and
//! the program that writes it all.

mod words;

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::LazyLock;
use std::time::Duration;

use lcp::Status;
use masonry::analysis::study::{End, Record, Settings, Study, StudyError, study};
use masonry::model::Plane;
use masonry::scene::{Block, Brick, Joint, Material, Movement, Route, Scene, Stage, Support, Wall};
use masonry::units::Units;
use masonry_report::study as output;

use crate::common::walls::leaning_wall;

const ROUTES: [Route; 5] = [Route::Lemke, Route::Interior, Route::Qp, Route::Pgs, Route::Alm];

/// A rigid block on a floor, leaning by `alpha`; it stands up to 0.2.
fn block(alpha: f64) -> Scene {
    Scene::new("Block", Units::SI)
        .thickness(1.0)
        .gravity([10.0 * alpha, -10.0])
        .material("stone", Material::rigid().density(2000.0))
        .joint("floor", Joint::mu(0.7))
        .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
        .support(Support::new("floor", [-1.0, 0.0], [1.0, 0.0], "floor"))
}

fn settings() -> Settings {
    Settings {
        routes: ROUTES.to_vec(),
        tolerances: vec![1e-3, 1e-6, 1e-12],
        meshes: vec![1, 2, 4],
        // Times are not compared.
        repeats: 1,
        ..Settings::default()
    }
}

/// The wall by all routes, for all tests that only read it.
static WALL: LazyLock<Study> = LazyLock::new(|| studied(&leaning_wall(), &settings()));

fn studied(scene: &Scene, settings: &Settings) -> Study {
    study(scene, settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn by(study: &Study, route: Route, mesh: u32) -> Vec<&Record> {
    study.records.iter().filter(|it| it.route == route && it.mesh == mesh).collect()
}

fn worst(record: &Record) -> f64 {
    record.errors.unwrap().worst().unwrap()
}

#[test]
fn every_combination_has_its_record_and_errors_fall_with_the_tolerance() {
    let settings = settings();
    let mut told = Vec::new();
    let study = study(&leaning_wall(), &settings, &mut |at| {
        told.push(at);
        ControlFlow::Continue(())
    });
    let study = study.unwrap();

    let combination = |it: &Record| (it.mesh, it.route.name(), it.tolerance.to_bits());
    let combinations: BTreeSet<_> = study.records.iter().map(combination).collect();
    assert_eq!(study.records.len(), 3 * ROUTES.len() * 3);
    assert_eq!(combinations.len(), study.records.len(), "each once");
    assert!(told.len() >= study.records.len());
    assert!(study.is_solved());
    assert_eq!(study.routes(), ROUTES);

    for mesh in [1, 2, 4] {
        for route in ROUTES {
            let records = by(&study, route, mesh);
            for record in &records {
                assert!(record.end.is_solved(), "{record:?}");
                assert!(record.residual.unwrap() <= record.tolerance);
                assert!(record.seconds.unwrap() > 0.0 && record.iterations.unwrap() > 0);
                assert!(worst(record) <= 1e3 * record.tolerance, "{record:?}");
            }
            let errors: Vec<f64> = records.iter().map(|record| worst(record)).collect();
            assert!(errors.is_sorted_by(|a, b| *b <= a.max(1e-12)), "{route:?}: {errors:?}");
        }
    }
    // Methods that converge to their residual leave something undone.
    for route in [Route::Pgs, Route::Alm] {
        let records = by(&study, route, 1);
        assert!(worst(records[0]) > 1e-8 && worst(records[2]) < 1e-9, "{records:?}");
    }
}

#[test]
fn the_reference_has_no_error_and_another_route_confirms_it() {
    let study = &*WALL;
    for mesh in &study.meshes {
        let reference = mesh.reference.as_ref().unwrap();
        assert!(reference.residual <= reference.tolerance && reference.tolerance <= 1e-12);
        assert!(reference.balance <= 1e-10);
        let other = reference.confirmed.as_ref().unwrap();
        assert_ne!(other.route, reference.route);
        assert!(other.errors.worst().unwrap() <= 1e-9);
        let distance = other.refined.unwrap_or_else(|| panic!("{reference:?}"));
        assert!(distance <= 1e-13, "{other:?}");
        // To its tightest tolerance the route of the reference finds the same, up to rounding.
        let records = by(study, reference.route, mesh.factor);
        assert!(worst(records[2]) <= 1e-12, "{:?}", records[2]);
    }
}

#[test]
fn the_reference_is_refined_and_verified() {
    let study = &*WALL;
    for mesh in &study.meshes {
        let reference = mesh.reference.as_ref().unwrap();
        let verified = reference.verified.as_ref().unwrap();
        assert!(verified.holds && verified.is_better(), "{verified:?}");
        assert!(verified.residual < 1e-24 && verified.residual < reference.residual);
        assert!(verified.margin.unwrap() > -1e-15 && verified.digits >= 14.0);
        assert!(verified.shift <= 1e-12 && verified.passes > 0);
        let distance = verified.distance.unwrap();
        assert!(distance > 0.0 && distance <= 1e-10, "the route ends at rounding: {verified:?}");
        // Against it even the route's own answer has an error.
        assert!(by(study, reference.route, mesh.factor).iter().all(|it| worst(it) < 1e-10));
    }
}

/// Of rigid blocks everything is known in fractions of the weight.
#[test]
fn the_refined_reference_of_a_closed_form_is_exact() {
    let study = studied(&block(0.1), &settings());
    let reference = study.meshes[0].reference.as_ref().unwrap();
    let verified = reference.verified.as_ref().unwrap();
    assert!(verified.is_better() && verified.digits >= 28.0, "{verified:?}");
    assert!(verified.residual < 1e-29 && verified.shift.abs() <= 0.0);
    assert!(reference.confirmed.as_ref().unwrap().refined.unwrap() < 1e-28);
}

#[test]
fn pivots_are_counted_once_for_all_tolerances_that_they_reach() {
    let study = &*WALL;
    for mesh in [1, 2, 4] {
        let records = by(study, Route::Lemke, mesh);
        for (loose, tight) in records.iter().zip(&records[1..]) {
            assert!(tight.residual.unwrap() <= tight.tolerance);
            if loose.residual.unwrap() <= tight.tolerance {
                assert_eq!((tight.seconds, tight.iterations), (loose.seconds, loose.iterations));
            }
        }
        assert_eq!(records[0].seconds, records[1].seconds, "the first two are one: {records:?}");
    }
}

#[test]
fn a_load_history_is_studied_at_its_end() {
    let moved = Movement { x: 0.0, y: -1e-4, turn: 0.0 };
    let brick = Brick { length: 0.2, height: 0.1 };
    let scene = Scene::new("Settling", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .gravity([0.0, -9.81])
        .material("brick", Material::elastic(1e8, 0.15).density(2000.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, 0.4, 2).mesh([1, 1]))
        .support(Support::new("left", [0.0, 0.0], [0.2, 0.0], "bed"))
        .support(Support::new("right", [0.2, 0.0], [0.4, 0.0], "bed"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("settlement").steps(2).moves("right", moved));
    let routes = vec![Route::Lemke, Route::Interior];
    let study = studied(&scene, &Settings { routes, ..settings() });
    for mesh in &study.meshes {
        let reference = mesh.reference.as_ref().unwrap();
        assert!(reference.verified.as_ref().unwrap().is_better(), "{reference:?}");
        let [x, y] = mesh.values.unwrap().displacement;
        assert!(x.hypot(y) > 5e-5);
    }
    for route in [Route::Lemke, Route::Interior] {
        for record in by(&study, route, 1) {
            assert!(record.end.is_solved() && worst(record) < 1e-8, "{record:?}");
        }
    }
}

#[test]
fn finer_meshes_come_nearer_to_the_finest() {
    let study = &*WALL;
    let [coarse, fine, finest] = &study.meshes[..] else { panic!("three meshes") };
    assert_eq!([coarse.factor, fine.factor, finest.factor], [1, 2, 4]);
    // Of half bricks, half a length of one element is still one.
    assert!(coarse.elements < fine.elements && fine.elements < finest.elements);
    assert_eq!(finest.errors, None, "nothing to compare with");
    let [coarse, fine] = [coarse, fine].map(|mesh| mesh.errors.unwrap());
    for (coarse, fine) in [(coarse.energy, fine.energy), (coarse.displacement, fine.displacement)] {
        assert!(fine.unwrap() > 0.0 && fine < coarse, "{fine:?} {coarse:?}");
    }
    assert!(fine.worst() < coarse.worst());
}

#[test]
fn the_thrust_is_that_of_the_closed_form() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/wedge.toml");
    let study = studied(&Scene::read(&path).unwrap(), &settings());
    let angle = 20.0_f64.to_radians();
    let (top, bottom) = (1.0, 1.0 - 2.0 * angle.tan());
    let weight = 0.5 * (top + bottom) * 1000.0 * 9.81;
    let values = study.meshes[0].values.unwrap();
    let expected = weight / (2.0 * angle.tan());
    assert!((values.thrust - expected).abs() <= 1e-10 * expected, "{values:?}, not {expected}");
}

#[test]
fn a_route_that_does_not_treat_the_scene_is_recorded() {
    let study = studied(&block(0.1), &settings());
    assert_eq!(study.meshes.len(), 1, "rigid blocks have no mesh to refine");
    assert_eq!(study.records.len(), ROUTES.len() * 3);
    for record in by(&study, Route::Alm, 1) {
        assert!(matches!(&record.end, End::Refused(why) if why.contains("rigid")), "{record:?}");
        assert!(record.seconds.is_some() && record.errors.is_none() && record.residual.is_none());
    }
    for record in by(&study, Route::Lemke, 1) {
        let errors = record.errors.unwrap();
        assert!(record.end.is_solved() && errors.force.unwrap() <= 1e-12);
        assert_eq!((errors.stress, errors.energy), (None, None), "nothing is elastic");
    }
    let sentences = output::summary(&study);
    assert!(sentences.iter().any(|it| it.starts_with("alm refuses the scene")), "{sentences:?}");
}

#[test]
fn a_mesh_that_cannot_be_made_is_recorded() {
    let settings = Settings { routes: vec![Route::Interior], meshes: vec![1, 2000], ..settings() };
    let study = studied(&leaning_wall(), &settings);
    let [mesh, impossible] = &study.meshes[..] else { panic!("two meshes") };
    assert!(mesh.refusal.is_none() && mesh.reference.is_some() && mesh.errors.is_none());
    assert!(impossible.refusal.as_ref().unwrap().contains("elements"));
    assert!(impossible.reference.is_none() && impossible.values.is_none());
    for record in by(&study, Route::Interior, 2000) {
        assert!(matches!(&record.end, End::Refused(_)) && record.errors.is_none(), "{record:?}");
    }
    assert!(output::table(&study).contains("Mesh 2000: "));
}

#[test]
fn without_time_there_is_no_answer_and_what_is_harder_is_not_tried() {
    let settings = Settings { time_limit: Duration::ZERO, ..settings() };
    let study = studied(&leaning_wall(), &settings);
    assert!(!study.is_solved());
    assert_eq!(study.records.len(), 3 * ROUTES.len() * 3);
    for record in &study.records {
        let is_first = record.mesh == 1 && record.tolerance > 5e-4;
        if is_first {
            assert_eq!(record.end, End::Ended(Status::TimeLimit), "{record:?}");
            assert!(record.seconds.is_some());
        } else {
            assert!(matches!(record.end, End::Skipped(_)) && record.seconds.is_none());
        }
        assert!(record.errors.is_none());
    }
    assert!(study.meshes.iter().all(|mesh| mesh.reference.is_none() && mesh.errors.is_none()));
    let text = output::table(&study);
    assert!(text.contains("There is no reference") && text.contains("TimeLimit"), "{text}");
    assert!(text.contains("Not tried: alm on mesh 1, 2, 4, since the time ran out"), "{text}");
}

/// The solves of the reference come first, and then the routes in their order.
#[test]
fn an_interrupted_study_keeps_what_was_solved() {
    let settings = Settings {
        routes: vec![Route::Interior, Route::Pgs],
        tolerances: vec![1e-6],
        meshes: vec![1, 2],
        ..Settings::default()
    };
    let study = study(&leaning_wall(), &settings, &mut |at| {
        if at.route == Route::Pgs { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let study = study.unwrap();
    assert!(study.is_interrupted && study.is_solved());
    let [solved, skipped @ ..] = &study.records[..] else { panic!("no records") };
    assert!(solved.end.is_solved() && solved.errors.is_some());
    assert_eq!(skipped.len(), 3);
    for record in skipped {
        assert!(record.end.reason().unwrap().contains("interrupted"), "{record:?}");
    }
    assert!(study.meshes[0].reference.is_some() && study.meshes[1].reference.is_none());
    let text = output::table(&study);
    assert!(text.contains("Interrupted: 3 of 4 solves are missing."), "{text}");
}

#[test]
fn settings_out_of_range_are_refused() {
    let refused = |settings: Settings| {
        study(&leaning_wall(), &settings, &mut |_| ControlFlow::Continue(())).unwrap_err()
    };
    let empty = refused(Settings { routes: Vec::new(), ..settings() });
    assert!(matches!(empty, StudyError::Empty { what: "route" }));
    for tolerances in [vec![1e-4, 0.0], vec![1.0], vec![f64::NAN]] {
        let error = refused(Settings { tolerances, ..settings() });
        assert!(matches!(error, StudyError::Tolerance(_)), "{error}");
    }
    assert!(matches!(
        refused(Settings { meshes: vec![1, 0], ..settings() }),
        StudyError::NoElements
    ));
    let error =
        study(&leaning_wall().thickness(-1.0), &settings(), &mut |_| ControlFlow::Continue(()))
            .unwrap_err();
    assert!(matches!(error, StudyError::Scene(_)));
}
