//! The program: exit codes, and what goes to standard output and what to standard error.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::common::BALANCE;

/// A block on a floor, leaning by `alpha`; it stands up to 0.2.
fn block(alpha: f64) -> String {
    format!(
        "title = \"Block\"\n\
         thickness = 1.0\n\
         gravity = [{}, -10.0]\n\
         units = {{ length = \"m\", force = \"kN\" }}\n\
         materials.stone.density = 2000.0\n\
         joints.floor.mu = 0.7\n\
         [[blocks]]\n\
         name = \"block\"\n\
         material = \"stone\"\n\
         corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]\n\
         [[supports]]\n\
         name = \"floor\"\n\
         from = [-1.0, 0.0]\n\
         to = [1.0, 0.0]\n\
         joint = \"floor\"\n",
        10.0 * alpha
    )
}

/// A panel of 2 x 2 bricks between walls, without a floor.
const NO_FLOOR: &str = r#"
title = "Panel without a floor"
plane = "stress"
thickness = 1.0
units = { length = "m", force = "kN" }
materials.brick = { E = 1e5, nu = 0.15 }
joints = { bed.mu = 1.0, head.mu = 1.0, wall.mu = 1.0 }

[[walls]]
name = "panel"
material = "brick"
origin = [0.0, 0.0]
brick = { length = 0.1, height = 0.1 }
width = 0.2
courses = 2
mesh = [1, 1]

[[supports]]
name = "left wall"
from = [0.0, 0.0]
to = [0.0, 0.2]
joint = "wall"

[[supports]]
name = "right wall"
from = [0.2, 0.0]
to = [0.2, 0.2]
joint = "wall"

[[loads]]
name = "top"
from = [0.0, 0.2]
to = [0.2, 0.2]
pressure = 10.0
"#;

/// An empty directory of this test alone.
fn directory(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(test);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    fs::create_dir_all(&path).unwrap();
    path
}

fn written(directory: &Path, scene: &str) -> String {
    let path = directory.join("scene.toml");
    fs::write(&path, scene).unwrap();
    path.to_str().unwrap().to_owned()
}

fn masonry(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap()
}

/// The one JSON object on standard output.
fn object(output: &Output) -> Value {
    let text = std::str::from_utf8(&output.stdout).unwrap();
    let value: Value = serde_json::from_str(text).unwrap();
    assert!(value.is_object());
    value
}

fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

/// Every file that the object lists is there.
fn assert_files(object: &Value, directory: &Path) {
    let files = object["files"].as_array().unwrap();
    assert!(!files.is_empty());
    for file in files {
        let path = directory.join(file.as_str().unwrap());
        assert!(path.metadata().unwrap().len() > 0, "{}", path.display());
    }
}

#[test]
fn plan_says_what_will_be_built() {
    let directory = directory("plan");
    let scene = written(&directory, &block(0.1));
    let output = masonry(&["plan", &scene, "--route", "lemke", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
    let plan = object(&output);
    assert_eq!(plan["blocks"], 1);
    assert_eq!(plan["contact_points"], 2);
    assert_eq!(plan["frictional_points"], 2);
    assert_eq!(plan["order"], 6);
    let effects = plan["effects"].as_array().unwrap();
    let is_on = |name: &str| effects.iter().find(|it| it["name"] == name).unwrap()["on"] == true;
    assert!(is_on("friction") && is_on("self weight") && !is_on("deformation"));
    for effect in effects {
        let [because, cost] = ["because", "cost"].map(|key| effect[key].as_str().unwrap());
        assert!(!because.is_empty());
        assert_eq!(cost == "none", effect["on"] == false, "{effect}");
    }

    let text = masonry(&["plan", &scene]);
    assert_eq!(text.status.code(), Some(0));
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.starts_with("Block\n") && text.contains("friction"), "{text}");
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 1, "a plan writes nothing");
}

#[test]
fn a_solved_scene_is_one_object_and_code_zero() {
    let directory = directory("solved");
    let scene = written(&directory, &block(0.1));
    let out = directory.join("out").join("deeper");
    let output = masonry(&["solve", &scene, "--out", out.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    let result = object(&output);
    assert_eq!(result["status"], "Solved");
    // Three motions of the block, and two edges of the friction cone at each of two points.
    assert_eq!(result["order"], 7);
    assert_eq!(result["verdict"], "stands");
    assert_eq!(result["evidence"], "admissible forces");
    assert!(result["sentence"].as_str().unwrap().starts_with("The wall stands: "));
    assert!(result["plan"].is_object() && result.get("reason").is_none());
    for key in ["equation", "feasibility", "complementarity"] {
        assert!(result["residuals"][key].as_f64().unwrap() <= 1e-10, "{key}");
    }
    for key in BALANCE {
        assert!(result["balance"][key].as_f64().unwrap() <= 1e-9, "{key}");
    }
    // 0.2 m2 of 2000 kg/m3 in a field of 10 m/s2, centred at (0.1, 0.5).
    assert_eq!(result["units"]["force"], "kN");
    assert!((result["reactions"]["floor"]["fy"].as_f64().unwrap() - 4.0).abs() < 1e-12);
    assert!((result["reactions"]["floor"]["fx"].as_f64().unwrap() + 0.4).abs() < 1e-12);
    assert!((result["reactions"]["floor"]["m"].as_f64().unwrap() - 0.6).abs() < 1e-12);
    let contacts = ["open", "stick", "slip"].map(|key| result["contacts"][key].as_u64().unwrap());
    assert_eq!(contacts.iter().sum::<u64>(), 2);
    assert!(result["time_s"]["solve"].as_f64().unwrap() >= 0.0);
    assert_files(&result, &out);
    let saved: Value =
        serde_json::from_str(&fs::read_to_string(out.join("result.json")).unwrap()).unwrap();
    assert_eq!(saved, result);
}

#[test]
fn the_report_for_people_is_no_json() {
    let directory = directory("report");
    let scene = written(&directory, &block(0.1));
    let out = directory.join("out");
    let output = masonry(&["solve", &scene, "--out", out.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(serde_json::from_str::<Value>(&text).is_err());
    assert!(text.starts_with("The wall stands: "), "{text}");
    assert!(text.contains("Solved") && text.contains("result.json"), "{text}");
    let picture = fs::read_to_string(out.join("deformed.svg")).unwrap();
    assert!(picture.contains("Stands: Block"), "{picture}");
}

#[test]
fn what_is_not_solved_says_why_and_has_code_one() {
    // Walls that were prestressed could hold the panel, so that nothing proves that it falls; it moves and does not stop.
    let falls = ["falls", "no admissible forces", "The wall falls: "];
    let moves = ["falls", "motion", "The wall falls: its blocks do not come to rest"];
    for (name, scene, [verdict, evidence, sentence]) in
        [("tipped", block(0.21), falls), ("no_floor", NO_FLOOR.to_owned(), moves)]
    {
        let directory = directory(name);
        let scene = written(&directory, &scene);
        let out = directory.join("out");
        let output = masonry(&["solve", &scene, "--out", out.to_str().unwrap(), "--json"]);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        let result = object(&output);
        assert_ne!(result["status"], "Solved");
        assert_eq!((&result["verdict"], &result["evidence"]), (&verdict.into(), &evidence.into()));
        assert!(result["sentence"].as_str().unwrap().starts_with(sentence));
        // Only a proof is called one.
        let reason = result["reason"].as_str().unwrap();
        assert_eq!(reason.contains("proved"), evidence == "no admissible forces", "{reason}");
        for key in ["balance", "reactions", "contacts", "strain_energy", "max_displacement"] {
            assert!(result[key].is_null(), "{key}");
        }
        assert_files(&result, &out);
        assert!(out.join("mechanism.svg").exists());
        assert!(!out.join("contacts.csv").exists(), "there are no forces to list");
    }
}

/// The option takes the place of the key, and the answer is the same.
#[test]
fn a_route_can_be_chosen() {
    let directory = directory("route");
    let scene = written(&directory, &block(0.1));
    let out = directory.join("out");
    for (option, expected) in [
        ("auto", "forces"),
        ("forces", "forces"),
        ("lemke", "lemke"),
        ("interior", "interior"),
        ("qp", "qp"),
        ("pgs", "pgs"),
    ] {
        let plan = object(&masonry(&["plan", &scene, "--route", option, "--json"]));
        assert_eq!(plan["routes"][0]["route"], expected);
        assert_eq!(plan["routes"][0]["dense_numbers"] == 0, expected != "lemke");
        let out = out.to_str().unwrap();
        let output = masonry(&["solve", &scene, "--out", out, "--route", option, "--json"]);
        assert_eq!(output.status.code(), Some(0), "{option}: {}", stderr(&output));
        let result = object(&output);
        assert_eq!(result["route"], expected);
        assert_eq!(result["routes"][0]["end"], "Solved");
        assert!(!result["why"].as_str().unwrap().is_empty());
        let count = |key: &str| result[key].as_u64().unwrap();
        let work = if expected == "lemke" { "pivots" } else { "factorisations" };
        assert!(count(work) > 0 && count("iterations") + count("pivots") > 0, "{option}");
        assert!(result["memory_bytes"].as_u64().unwrap() > 0);
        assert!((result["reactions"]["floor"]["fy"].as_f64().unwrap() - 4.0).abs() < 1e-8);
        assert_eq!(result["soft"].is_object(), option == "pgs");
    }
    let falls = written(&directory, &block(0.3));
    let out = out.to_str().unwrap();
    let output = masonry(&["solve", &falls, "--out", out, "--route", "interior", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let result = object(&output);
    assert_eq!(result["status"], "NoEquilibrium");
    assert!(result["mechanism"]["block"].is_array());
    let report = fs::read_to_string(directory.join("out").join("report.txt")).unwrap();
    assert!(report.contains("loaded slowly"), "{report}");
    assert!(directory.join("out").join("mechanism.svg").exists());

    let limited = written(&directory, &block(0.1).replace("units", "solver.max_pivots = 9\nunits"));
    let output = masonry(&["solve", &limited, "--out", out, "--route", "qp"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("solver.max_pivots"), "{}", stderr(&output));
    assert_eq!(masonry(&["plan", &scene, "--route", "simplex"]).status.code(), Some(2));
}

/// The place of a mistake in a text, as messages give it.
fn place_of(text: &str, mistake: &str) -> String {
    let line = text.lines().position(|line| line.contains(mistake)).unwrap();
    let column = text.lines().nth(line).unwrap().find(mistake).unwrap();
    format!("line {}, column {}", line + 1, column + 1)
}

#[test]
fn a_mistake_in_a_scene_has_line_and_column_and_code_two() {
    let good = block(0.1);
    let cases = [
        ("number", good.replace("2000.0", "-3.0"), "-3.0"),
        ("key", good.replace("thickness", "thikness"), "thikness"),
        ("name", good.replace("joint = \"floor\"", "joint = \"flor\""), "\"flor\""),
        ("syntax", good.replace("thickness = 1.0", "thickness = one"), "one"),
        ("geometry", good.replace("to = [1.0, 0.0]", "to = [1.0, 0.5]"), "[[supports]]"),
    ];
    for (name, text, mistake) in cases {
        let directory = directory(&format!("mistake_{name}"));
        let scene = written(&directory, &text);
        let out = directory.join("out");
        for arguments in [
            &["solve", &scene, "--out", out.to_str().unwrap(), "--json"][..],
            &["plan", &scene, "--json"],
            &["draw", &scene],
        ] {
            let output = masonry(arguments);
            assert_eq!(output.status.code(), Some(2), "{arguments:?}");
            assert!(output.stdout.is_empty(), "{arguments:?}");
            let message = stderr(&output);
            assert!(message.contains("scene.toml"), "{message}");
            assert!(message.contains(&place_of(&text, mistake)), "{message}");
        }
        assert_eq!(fs::read_dir(&directory).unwrap().count(), 1, "nothing is written");
    }
}

#[test]
fn what_cannot_be_read_or_understood_has_code_two() {
    let directory = directory("unreadable");
    let missing = directory.join("missing.toml");
    let out = directory.join("out");
    let output =
        masonry(&["solve", missing.to_str().unwrap(), "--out", out.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    assert!(stderr(&output).contains("missing.toml"));
    assert!(!out.exists());

    for arguments in [&["solve"][..], &["frobnicate"], &["plan", "--no-such-option"]] {
        let output = masonry(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty());
    }
}

/// A block that nothing holds against sliding falls; pivots find it out before they start.
#[test]
fn a_block_that_can_slide_freely_has_code_two() {
    let directory = directory("free");
    let scene = written(&directory, &block(0.1).replace("mu = 0.7", "mu = 0.0"));
    let out = directory.join("out");
    let out = out.to_str().unwrap();
    let output = masonry(&["solve", &scene, "--out", out, "--route", "lemke", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let message = stderr(&output);
    assert!(message.contains("block \"block\" can slide"), "{message}");
    let output = masonry(&["solve", &scene, "--out", out, "--json"]);
    assert_eq!((output.status.code(), &object(&output)["verdict"]), (Some(1), &"falls".into()));
}

#[test]
fn draw_makes_a_picture() {
    let directory = directory("draw");
    let scene = written(&directory, &block(0.1));
    assert_eq!(masonry(&["draw", &scene]).status.code(), Some(0));
    let picture = directory.join("picture.svg");
    let output = masonry(&["draw", &scene, "--out", picture.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8(output.stdout).unwrap().trim(), picture.to_str().unwrap());
    for path in [directory.join("scene.svg"), picture] {
        let text = fs::read_to_string(path).unwrap();
        let svg = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(svg.root_element().tag_name().name(), "svg");
    }
}

/// The stages of a block that is pushed step by step until it tips at a factor of 1.
fn pushed(steps: u32, factor: f64) -> String {
    let push = "[[loads]]\nname = \"push\"\nfrom = [0.0, 0.0]\nto = [0.0, 1.0]\npressure = 0.8\n";
    let stages = "[[stages]]\nname = \"weight\"\n[[stages]]\nname = \"push\"\n";
    format!("{}{push}{stages}steps = {steps}\nloads = {{ push = {factor} }}\n", block(0.0))
}

#[test]
fn a_load_history_can_be_taken_up_where_it_stopped() {
    let directory = directory("history");
    let out = directory.join("out");
    let out_argument = out.to_str().unwrap();
    let solve = |scene: &str, more: &[&str]| {
        let scene = written(&directory, scene);
        let arguments = ["solve", &scene, "--out", out_argument, "--json"];
        masonry(&[&arguments, more].concat())
    };
    let output = solve(&pushed(4, 1.2), &[]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let result = object(&output);
    assert_files(&result, &out);
    let history = &result["history"];
    assert_eq!((&history["steps"], &history["solved"]), (&5.into(), &4.into()));
    assert_eq!(history["failed"], serde_json::json!({ "stage": "push", "step": 4, "of": 4 }));
    assert!(result["reason"].as_str().unwrap().contains("Step 4 of 4 of stage \"push\""));
    let number = |value: &Value| value.as_f64().unwrap();
    assert!((number(&history["records"][3]["loads"]["push"]) - 0.9).abs() < 1e-12);
    let reaction = &history["records"][3]["reactions"]["floor"];
    assert!((number(&reaction["fx"]) + 0.72).abs() < 1e-9);
    let table = fs::read_to_string(out.join("history.csv")).unwrap();
    assert_eq!(table.lines().count(), 5);

    // Three of four steps to 1.2 are done: a stage of other steps does not fit, one that comes after does.
    let output = solve(&pushed(5, 1.2), &["--resume"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("another step 1 of stage \"push\""), "{}", stderr(&output));
    let output = solve(&pushed(4, 1.2), &["--resume"]);
    assert_eq!(object(&output)["history"]["records"], history["records"]);
    fs::write(out.join("checkpoint.json"), "{}").unwrap();
    let output = solve(&pushed(4, 1.2), &["--resume"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("line 1, column 2: this is not a checkpoint"),
        "{}",
        stderr(&output)
    );
}
