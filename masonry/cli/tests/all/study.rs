//! The program that writes the tables and pictures of a study.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use masonry::Units;
use masonry::scene::{Block, Brick, Joint, Load, Material, Plane, Scene, Support, Wall};
use serde_json::Value;

/// The number of routes to the state of an elastic wall.
const ROUTES: usize = 5;

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

/// Two courses of elastic bricks between a floor and a load that leans.
fn leaning_wall() -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    Scene::new("Wall", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.1)
        .material("brick", Material::elastic(1e8, 0.15))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, 0.4, 2).mesh([1, 1]))
        .support(Support::new("floor", [0.0, 0.0], [0.4, 0.0], "bed"))
        .load(Load::traction("top", [0.0, 0.2], [0.4, 0.2], [500.0, -1e4]))
}

/// An empty directory of this test alone, with the scene in it.
fn with_scene(test: &str, scene: &Scene) -> (PathBuf, String) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("study").join(test);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    fs::create_dir_all(&path).unwrap();
    let file = path.join("scene.toml");
    fs::write(&file, scene.to_toml().unwrap()).unwrap();
    let file = file.to_str().unwrap().to_owned();
    (path, file)
}

fn masonry(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_masonry")).arg("study").args(arguments).output().unwrap()
}

const QUICK: [&str; 4] = ["--tolerances", "1e-4,1e-8", "--meshes", "1,2,3"];

fn saved_machine(object: &Value) -> &str {
    object["machine"].as_str().unwrap()
}

#[test]
fn the_program_writes_tables_and_pictures() {
    let (directory, scene) = with_scene("solved", &leaning_wall());
    let out = directory.join("out").join("deeper");
    let mut arguments = vec![scene.as_str(), "--out", out.to_str().unwrap(), "--json"];
    arguments.extend(QUICK);
    let run = masonry(&arguments);
    assert_eq!(run.status.code(), Some(0));
    assert!(run.stderr.is_empty());
    let object: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(object["records"].as_array().unwrap().len(), 3 * ROUTES * 2);
    assert_eq!(object["meshes"].as_array().unwrap().len(), 3);
    assert_eq!(object["units"]["thrust"], "N");
    assert_eq!(object["records"][0]["end"]["ended"], "Solved");
    let sentence = object["summary"][0].as_str().unwrap();
    assert!(sentence.starts_with("Compared with 1e-4, 1e-8 takes ") && sentence.contains("lemke"));

    let names: BTreeSet<&str> =
        object["files"].as_array().unwrap().iter().map(|it| it.as_str().unwrap()).collect();
    assert_eq!(names, BTreeSet::from(["accuracy.svg", "study.csv", "study.json"]));
    let text = fs::read_to_string(out.join("accuracy.svg")).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    let lines = document.descendants().filter(|it| it.has_tag_name("path"));
    let lines = lines.filter(|it| it.attribute("class").is_some_and(|it| it.starts_with("curve")));
    assert!(lines.count() >= 2 * ROUTES, "one of each route, and one in the legend");
    let table = fs::read_to_string(out.join("study.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 1 + 3 * ROUTES * 2);
    let columns = rows[0].split(',').count();
    assert!(rows.iter().all(|row| row.split(',').count() == columns));
    assert!(saved_machine(&object).contains("thread"));
    let saved: Value =
        serde_json::from_str(&fs::read_to_string(out.join("study.json")).unwrap()).unwrap();
    assert_eq!(saved["records"], object["records"]);
}

#[test]
fn what_does_not_stand_is_code_one_and_has_its_tables() {
    let (directory, scene) = with_scene("falls", &block(0.3));
    let out = directory.join("out");
    let mut arguments = vec![scene.as_str(), "--out", out.to_str().unwrap()];
    arguments.extend(QUICK);
    let run = masonry(&arguments);
    assert_eq!(run.status.code(), Some(1));
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(text.starts_with("Block: what accuracy costs") && text.contains("does not reach"));
    let files: BTreeSet<_> = fs::read_dir(&out)
        .unwrap()
        .map(|it| it.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.starts_with('.'))
        .collect();
    let expected = ["study.csv", "study.json"].map(str::to_owned);
    assert_eq!(files, BTreeSet::from(expected), "nothing to draw");
}

#[test]
fn without_a_directory_there_is_the_report_alone() {
    let (folder, scene) = with_scene("report_alone", &block(0.1));
    let output = masonry(&[&[scene.as_str()], &QUICK[..]].concat());
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("what accuracy costs") && !text.contains("wrote"), "{text}");
    assert_eq!(fs::read_dir(folder).unwrap().count(), 1);
}

#[test]
fn bad_input_is_code_two() {
    let (directory, scene) = with_scene("bad", &block(0.1));
    let out = directory.join("out");
    let out = out.to_str().unwrap();
    for arguments in [
        vec!["none.toml", "--out", out],
        vec![&scene, "--out", out, "--tolerances", "2"],
        vec![&scene, "--out", out, "--meshes", "0"],
        vec![&scene, "--out", out, "--routes", "fast"],
        vec![&scene, "--out", out, "--time-limit", "nan"],
        vec!["--out", out],
    ] {
        let run = masonry(&arguments);
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        assert!(run.stdout.is_empty() && !run.stderr.is_empty());
    }
    assert!(!Path::new(out).exists());
}
