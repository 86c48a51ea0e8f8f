//! What tables, sentences and pictures of a study say.

use std::time::Duration;

use lcp::Status;
use masonry::analysis::study::{End, Record, Settings};
use masonry::scene::Route;
use masonry_report::study as output;

use super::{WALL, block, leaning_wall, settings, studied};

#[test]
fn meshes_have_names() {
    let names = vec!["one element a brick".to_owned()];
    let named = Settings { mesh_names: names, meshes: vec![1, 2, 4], ..settings() };
    let named = Settings { time_limit: Duration::ZERO, ..named };
    let study = studied(&leaning_wall(), &named);
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
    let mut study = WALL.clone();
    let failed = |it: &Record| it.route == Route::Pgs && (it.mesh != 2 || it.tolerance < 1e-7);
    for record in study.records.iter_mut().filter(|it| failed(it)) {
        record.end = End::Ended(Status::Stalled);
    }
    let routes = output::accuracy(&study).unwrap();
    assert!(
        routes.contains("pgs: Stalled") && routes.contains("1e-3 (first) to 1e-12"),
        "{routes}"
    );
    let cost = &output::summary(&study)[0];
    assert!(cost.ends_with("; pgs (Stalled) does not reach it."), "{cost}");
    let short = output::in_short(&study).unwrap();
    assert!(short.starts_with("On mesh 1 (that of the scene), "), "{short}");
    assert!(short.contains("below 1e-6") && short.contains("the error of the mesh is"), "{short}");
}
