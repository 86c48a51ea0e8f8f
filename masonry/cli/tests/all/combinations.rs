//! `masonry solve` and `masonry limit` on scenes with combinations of loads.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A block that tips at 8 times the wind under its roof, and without it at 0.2 of gravity.
const BLOCK: &str = r#"title = "Block"
thickness = 1.0
gravity = [0.0, -10.0]
units = { length = "m", force = "kN" }
materials.stone.density = 1000.0
joints.floor.mu = 0.9
blocks = [{ name = "block", material = "stone", corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]] }]
supports = [{ name = "ground", from = [-1.0, 0.0], to = [1.0, 0.0], joint = "floor" }]
loads = [
  { name = "roof", from = [0.0, 1.0], to = [0.2, 1.0], pressure = 10.0, mass = true },
  { name = "wind", from = [0.0, 0.0], to = [0.0, 1.0], traction = [0.1, 0.0] },
  { name = "quake", acceleration = [1.0, 0.0] },
]
"#;

/// The block with combinations, each a line, in a directory of its own.
fn written(name: &str, combinations: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("combinations").join(name);
    fs::create_dir_all(&directory).unwrap();
    let path = directory.join("scene.toml");
    fs::write(&path, format!("{BLOCK}combinations = [\n{combinations}\n]\n")).unwrap();
    path
}

fn masonry(command: &str, path: &Path, more: &[&str]) -> Output {
    let arguments = [&[command, path.to_str().unwrap()], more].concat();
    Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap()
}

#[track_caller]
fn object(output: &Output) -> Value {
    let text = String::from_utf8_lossy(&output.stdout);
    serde_json::from_str(&text)
        .unwrap_or_else(|_| panic!("{text}{}", String::from_utf8_lossy(&output.stderr)))
}

fn members<'a>(object: &'a Value, key: &str) -> Vec<&'a Value> {
    object["combinations"].as_array().unwrap().iter().map(|it| &it[key]).collect()
}

const STORM: &str = "{ name = \"storm\", loads = { roof = 1.0, wind = 1.5 } },";
const HURRICANE: &str = "{ name = \"hurricane\", loads = { roof = 1.0, wind = 9.0 } },";
const QUAKE: &str = "{ name = \"quake\", loads = { quake = 1.0, roof = 0.3 } },";

#[test]
fn the_worst_verdict_governs() {
    let path = written("verdicts", &[STORM, HURRICANE, QUAKE].concat());
    let output = masonry("solve", &path, &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    let found = object(&output);
    assert_eq!(members(&found, "combination"), ["storm", "hurricane", "quake", "quake, opposite"]);
    assert_eq!(members(&found, "verdict"), ["stands", "falls", "stands", "stands"]);
    assert_eq!(
        (&found["governs"], &found["result"]["verdict"]),
        (&"hurricane".into(), &"falls".into())
    );
    assert_eq!(found["result"]["title"], "Block, hurricane");

    let calm = written("calm", &[STORM, QUAKE].concat());
    let [out, report] = ["out", "page.html"].map(|it| calm.with_file_name(it));
    let more = ["--out", out.to_str().unwrap(), "--report", report.to_str().unwrap()];
    let output = masonry("solve", &calm, &more);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    // The quake takes more of the friction than the storm: 0.26 of 2.6 kN against 0.15 of 4 kN.
    assert!(text.starts_with("Combinations\n---") && text.contains("governs:"), "{text}");
    // Both directions are equal but for rounding.
    let result = fs::read_to_string(out.join("result.json")).unwrap();
    assert!(result.contains("\"title\": \"Block, quake"), "{result}");
    let page = fs::read_to_string(report).unwrap();
    assert!(
        page.contains("governs; this page shows it") && page.contains("<td>storm</td>"),
        "{page}"
    );
}

#[test]
fn the_smallest_factor_governs() {
    let path = written("limits", &[STORM, HURRICANE, QUAKE].concat());
    let out = path.with_file_name("limit");
    let more = ["--json", "--group", "wind", "--out", out.to_str().unwrap()];
    let wind = object(&masonry("limit", &path, &more));
    let file = fs::read_to_string(out.join("limit.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&file).unwrap(), wind);
    assert_eq!(members(&wind, "combination"), ["storm", "hurricane"]);
    assert_eq!((&wind["governs"], &wind["limit"]["group"]), (&"hurricane".into(), &"wind".into()));
    for (factor, expected) in members(&wind, "load_factor").into_iter().zip([8.0 / 1.5, 8.0 / 9.0])
    {
        assert!((factor.as_f64().unwrap() / expected - 1.0).abs() < 1e-4, "{factor}");
    }
    let both = object(&masonry("limit", &path, &["--json", "--group", "wind", "--both"]));
    let names = ["storm", "storm, opposite", "hurricane", "hurricane, opposite"];
    assert_eq!(members(&both, "combination"), names);
    let output = masonry("limit", &path, &["--group", "quake"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(text.contains("quake, opposite") && text.contains("Seismic check"), "{text}");
    assert!(!text.contains("acts in one direction") && !text.contains("storm"), "{text}");
    // Every line has its check: `a_0*` of the mechanism, and the least of all mechanisms of the limit.
    assert!(text.contains("least a_0* [m/s2]"), "{text}");
    let quake = object(&masonry("limit", &path, &["--json", "--group", "quake"]));
    for (found, least) in members(&quake, "a_0").into_iter().zip(members(&quake, "a_0_least")) {
        let [found, least] = [found, least].map(|it| it.as_f64().unwrap());
        assert!(found > least && least > 0.0, "{found} {least}");
    }
}

#[test]
fn what_takes_one_set_of_loads_says_so() {
    let path = written("refused", STORM);
    for (command, more) in [("limit", "--range"), ("study", "--meshes=1")] {
        let output = masonry(command, &path, &[more]);
        let errors = String::from_utf8(output.stderr).unwrap();
        let is_told = errors.contains("`masonry limit` take all, the latter without `--range`");
        assert!(output.status.code() == Some(2) && is_told, "{more}: {errors}");
    }
    let still = written("still", "{ name = \"still\", loads = { quake = 0.0 } }");
    let output = masonry("limit", &still, &["--group", "quake"]);
    let errors = String::from_utf8(output.stderr).unwrap();
    let is_told = errors.contains("\"quake\" acts in no combination");
    assert!(output.status.code() == Some(2) && is_told, "{errors}");
}
