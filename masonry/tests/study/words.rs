//! What tables, sentences and pictures of a study say.

use std::time::Duration;

use lcp::Status;
use masonry::analysis::study::{End, Record, Settings};
use masonry::report::{study as output, svg};
use masonry::scene::Route;

use super::{block, settings, studied, wall};

#[test]
fn meshes_have_names() {
    let names = vec!["one element a brick".to_owned()];
    let named = Settings { mesh_names: names, meshes: vec![1, 2, 4], ..settings() };
    let named = Settings { time_limit: Duration::ZERO, ..named };
    let study = studied(&wall(), &named);
    let names: Vec<&str> = study.meshes.iter().map(|mesh| mesh.name.as_str()).collect();
    assert_eq!(
        names,
        ["one element a brick", "mesh 2 (2 times as fine)", "mesh 4 (4 times as fine)"]
    );
    let text = output::table(&study);
    assert!(text.contains("ran out to 1e-3 on one element a brick"), "{text}");
    let study = studied(&block(0.1), &settings());
    assert_eq!(study.meshes[0].name, "mesh 1 (that of the scene)");
}

/// Pictures and sentences tell who has no answer, and where.
#[test]
fn routes_without_an_answer_are_named() {
    let mut study = studied(&wall(), &settings());
    let failed = |it: &Record| it.route == Route::Pgs && (it.mesh != 2 || it.tolerance < 1e-7);
    for record in study.records.iter_mut().filter(|it| failed(it)) {
        record.end = End::Ended(Status::Stalled);
    }
    let tightest = svg::mesh(&study).unwrap();
    assert!(tightest.contains("pgs, no answer on 1, 4<"), "{tightest}");
    let routes = svg::accuracy(&study).unwrap();
    assert!(
        routes.contains("pgs: Stalled") && routes.contains("1e-3 (first) to 1e-12"),
        "{routes}"
    );
    let cost = &output::summary(&study)[0];
    assert!(cost.ends_with("; pgs (Stalled) does not reach it."), "{cost}");
    let short = output::in_short(&study).unwrap();
    assert!(short.starts_with("On mesh 1 (that of the scene), "), "{short}");
    assert!(short.contains("below 1e-6") && short.contains("the mesh errs by"), "{short}");
}

#[test]
fn the_picture_of_springs_says_what_failed_and_needs_a_bias() {
    let mut study = studied(&wall(), &Settings { meshes: vec![1], ..settings() });
    study.springs[2].end = End::Ended(Status::Stalled);
    let picture = svg::springs(&study).unwrap();
    assert!(picture.contains("(Stalled).") && picture.contains("a residual of 1e-6"), "{picture}");
    for springs in &mut study.springs {
        springs.share = None;
    }
    let legend = |text: &str| text.contains("share of the load");
    assert!(legend(&picture) && !legend(&svg::springs(&study).unwrap()), "no line without points");
    for springs in &mut study.springs {
        springs.bias = None;
    }
    assert_eq!(svg::springs(&study), None);
    let rows = output::springs_csv(&study).unwrap();
    assert_eq!(rows.lines().count(), 1 + 3);
    assert!(rows.lines().nth(3).unwrap().contains(",Stalled,"), "{rows}");
}

/// The picture of the last digits has what the table has.
#[test]
fn the_last_digits_are_drawn_beside_the_route() {
    let mut study = studied(&wall(), &settings());
    let text = svg::digits(&study).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let lines: Vec<_> = document.descendants().filter_map(|it| it.attribute("points")).collect();
    let points = |count: usize| lines.iter().filter(|it| it.split(' ').count() == count).count();
    assert!(points(3) >= 4, "three meshes, and the routes on all: {lines:?}");
    let route = study.meshes[0].reference.as_ref().unwrap().route.name();
    assert!(text.contains("whole solves in") && text.contains(route));
    let table = output::table(&study);
    assert!(table.contains(&format!("all, by {route}")), "{table}");
    for mesh in &mut study.meshes {
        mesh.refinings.clear();
    }
    assert_eq!(svg::digits(&study), None);
}
