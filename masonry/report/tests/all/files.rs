//! Files of a report, written and read back.

use std::fs;
use std::path::{Path, PathBuf};

use crate::synthetic::{self, Wall};
use masonry_report::svg::ReferenceLines;
use masonry_report::{OutputError, OutputFormat, ReportOptions, write_all};
use nalgebra::Point2;

/// A directory of its own for each test, empty at the start.
fn directory(name: &str) -> PathBuf {
    let dir = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("output").join(name);
    let _ = fs::remove_dir_all(&dir);
    dir
}

fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).expect("the directory was made");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("it can be listed").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn reference() -> ReferenceLines {
    ReferenceLines {
        origins: [Point2::new(0.2, 0.0), Point2::new(0.8, 0.0)],
        angle: 45_f64.to_radians(),
        label: "arctan(l / 2h) = 45° from the vertical".to_owned(),
    }
}

#[test]
fn a_solved_scene_gives_every_file_and_no_other() {
    let dir = directory("solved");
    let outcome = synthetic::solved(Wall::PANEL);
    let options = ReportOptions { reference: Some(reference()), ..ReportOptions::default() };
    let written = write_all(&outcome, &dir, &options).unwrap();
    let expected = [
        "contacts.csv",
        "cracks.svg",
        "deformed.svg",
        "forces.svg",
        "panel.vtu",
        "principal_stresses.svg",
        "report.txt",
        "result.json",
        "scene.svg",
    ];
    assert_eq!(names(&dir), expected);
    assert_eq!(written.len(), expected.len());
    assert_eq!(written.last(), Some(&dir.join("result.json")));
}

#[test]
fn an_unsolved_scene_gives_what_is_known() {
    let dir = directory("unsolved");
    write_all(&synthetic::unsolved(Wall::PANEL), &dir, &ReportOptions::default()).unwrap();
    let expected = ["mechanism.svg", "panel.vtu", "report.txt", "result.json", "scene.svg"];
    assert_eq!(names(&dir), expected);
}

#[test]
fn equal_outcomes_give_equal_bytes() {
    let (one, other) = (directory("first"), directory("second"));
    for dir in [&one, &other] {
        write_all(&synthetic::solved(Wall::PANEL), dir, &ReportOptions::default()).unwrap();
    }
    for name in names(&one) {
        assert_eq!(fs::read(one.join(&name)).unwrap(), fs::read(other.join(&name)).unwrap());
    }
}

#[test]
fn a_file_that_fails_is_named_and_the_others_are_written() {
    let dir = directory("blocked");
    // A directory in the place of a file cannot be replaced by a rename.
    fs::create_dir_all(dir.join("deformed.svg")).unwrap();
    let outcome = synthetic::solved(Wall::PANEL);
    let error = write_all(&outcome, &dir, &ReportOptions::default()).unwrap_err();
    let OutputError::Files { written, failed } = &error else { panic!("{error}") };
    assert_eq!(failed.len(), 1);
    assert_eq!(failed[0].0, dir.join("deformed.svg"));
    assert_eq!(written.len(), 8);
    assert!(error.to_string().contains("deformed.svg"), "{error}");
    assert!(names(&dir).iter().all(|name| !name.contains("tmp")), "{:?}", names(&dir));

    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(dir.join("result.json")).unwrap()).unwrap();
    let files = json["files"].as_array().unwrap();
    assert!(!files.contains(&"deformed.svg".into()));
}

#[test]
fn a_directory_that_cannot_be_made_is_named() {
    let dir = directory("file_in_the_way");
    fs::create_dir_all(&dir).unwrap();
    fs::write(dir.join("file"), "").unwrap();
    let below = dir.join("file").join("below");
    let error =
        write_all(&synthetic::solved(Wall::PANEL), &below, &ReportOptions::default()).unwrap_err();
    assert!(matches!(&error, OutputError::Directory { path, .. } if *path == below), "{error}");
}

#[test]
fn only_the_formats_asked_for_are_written() {
    let dir = directory("one_format");
    let options = ReportOptions { formats: vec![OutputFormat::Csv], reference: None };
    write_all(&synthetic::solved(Wall::PANEL), &dir, &options).unwrap();
    assert_eq!(names(&dir), ["contacts.csv"]);
}
