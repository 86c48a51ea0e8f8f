//! The page of HTML: whole, without a network, and in a browser.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// A stack of two blocks that is pushed after its weight has come on it, in three steps.
const STACK: &str = r#"
title = "Two blocks <pushed>"
plane = "stress"
thickness = 1.0
gravity = [0.0, -10.0]
units = { length = "m", force = "kN" }
materials.stone = { E = 1e6, nu = 0.2, density = 2000 }
joints = { bed.mu = 0.5, head.mu = 0.5 }

[[walls]]
name = "stack"
material = "stone"
origin = [0.0, 0.0]
brick = { length = 0.5, height = 0.25 }
courses = [[1], [1]]
mesh = [2, 1]

[[supports]]
name = "floor"
from = [0.0, 0.0]
to = [0.5, 0.0]
joint = "bed"

[[loads]]
name = "push"
from = [0.0, 0.25]
to = [0.0, 0.5]
traction = [2.0, 0.0]

[[stages]]
name = "weight"

[[stages]]
name = "push"
steps = 3
loads = { push = 1.0 }
"#;

fn directory(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("page").join(name);
    let _ = fs::remove_dir_all(&directory);
    fs::create_dir_all(&directory).unwrap();
    directory
}

/// The page that a command writes.
#[track_caller]
fn page(name: &str, command: &str, scene: &Path, more: &[&str]) -> (PathBuf, String) {
    let directory = directory(name);
    let path = directory.join("page.html");
    let mut run = Command::new(env!("CARGO_BIN_EXE_masonry"));
    run.arg(command).arg(scene).arg("--report").arg(&path).arg("--json").args(more);
    let output = run.output().unwrap();
    let object: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    let files = object["files"].as_array().unwrap();
    assert!(files.iter().any(|it| it == "page.html"), "{files:?}");
    let text = fs::read_to_string(&path).unwrap();
    (path, text)
}

fn stack(name: &str) -> (PathBuf, String) {
    let scene = directory(&format!("{name}-scene")).join("stack.toml");
    fs::write(&scene, STACK).unwrap();
    page(name, "solve", &scene, &[])
}

fn given(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

#[track_caller]
fn assert_whole(page: &str) {
    // Nothing is fetched: the only addresses are names.
    let addresses = page.replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "src=", "href=", "url(", "@import"] {
        assert!(!addresses.contains(word), "{word}");
    }
    assert!(page.contains("default-src 'none'"));
    assert!(!page.split("<script>").next().unwrap().contains("NaN"));
    let place = |text: &str| page.find(text).unwrap_or_else(|| panic!("no {text}"));
    let order = ["<h1>", "<dl class=\"figures\">", "<section id=\"pictures\">", "<table>", "<pre>"];
    let places = order.map(place);
    assert!(places.is_sorted(), "{places:?}");
}

#[test]
fn a_history_has_a_picture_of_every_kind_for_every_step() {
    let (_, page) = stack("history");
    assert_whole(&page);
    assert!(page.contains("<h1>The wall stands in all 4 steps"), "the verdict");
    assert!(page.contains("Two blocks &lt;pushed&gt;"));
    for (picture, frames) in
        [("forces", 4), ("principal_stresses", 4), ("deformed", 4), ("scene", 1)]
    {
        let figure = page.split(&format!("<figure data-picture=\"{picture}\"")).nth(1).unwrap();
        let figure = figure.split("</figure>").next().unwrap();
        assert_eq!(figure.matches("<div class=\"frame\"").count(), frames, "{picture}");
    }
    assert!(page.contains("load history</title>"), "the curves");
    assert!(page.contains("<h2>Steps</h2>") && page.contains("<h2>Joints</h2>"));
}

#[test]
fn limit_loads_and_thicknesses_have_pages() {
    let (_, page_) = page("limit", "limit", &given("ferris_wall_1.toml"), &[]);
    assert_whole(&page_);
    for text in ["cannot stand above", "data-picture=\"mechanism\"", "data-picture=\"path_forces\""]
    {
        assert!(page_.contains(text), "{text}");
    }
    // It opens on the motion that its headline is about, with the load and its factor.
    let opened = page_.split("<button").nth(1).unwrap();
    assert!(opened.contains("data-picture=\"path_mechanism\""), "{opened}");
    let mechanism = page_.split("<figure data-picture=\"path_mechanism\"").nth(1).unwrap();
    let mechanism = mechanism.split("</figure>").next().unwrap();
    assert!(mechanism.contains("data-load=\"1\"") && mechanism.contains("(factor 0."), "the load");
    assert!(page_.contains("Joints of the mechanism"));
    assert!(page_.contains("load factor along the path"));

    let scene = given("arch_semicircular.toml");
    let (_, page_) = page("thickness", "limit", &scene, &["--thickness", "arch"]);
    assert_whole(&page_);
    assert!(page_.contains("data-picture=\"mechanism\"") && page_.contains("stands at"));
}

/// The colour of a page is the verdict on the scene as it is given.
#[test]
fn the_page_of_a_least_thickness_says_whether_the_scene_stands() {
    let text = fs::read_to_string(given("arch_semicircular.toml")).unwrap();
    let weight = text.split("[[loads]]").next().unwrap();
    for (thickness, verdict) in [("0.2", "stands"), ("0.05", "falls")] {
        let name = format!("thickness_{verdict}");
        let path = directory(&name).with_extension("toml");
        fs::write(&path, weight.replace("thickness = 0.2", &format!("thickness = {thickness}")))
            .unwrap();
        let (_, page) = page(&name, "limit", &path, &["--thickness", "arch"]);
        assert!(page.contains(&format!("<header class=\"{verdict}\">")), "{verdict}");
    }
}

#[test]
fn a_page_that_cannot_be_written_is_refused_before_the_work() {
    for (page, why) in
        [("/nowhere/page.html", "its directory does not exist"), ("/", "it is a directory")]
    {
        for (command, scene) in [("solve", "block_on_floor.toml"), ("limit", "ferris_wall_1.toml")]
        {
            let mut run = Command::new(env!("CARGO_BIN_EXE_masonry"));
            let output =
                run.arg(command).arg(given(scene)).args(["--report", page]).output().unwrap();
            assert_eq!(output.status.code(), Some(2));
            let errors = String::from_utf8(output.stderr).unwrap();
            let wanted = format!("cannot write the page {page}: {why}; choose another --report");
            assert!(errors.contains(&wanted), "{errors}");
            assert!(output.stdout.is_empty(), "nothing was computed");
        }
    }
}

/// The program that renders pages, if there is one.
fn browser() -> Option<&'static str> {
    let is_there = |name: &&str| Command::new(name).arg("--version").output().is_ok();
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(is_there)
}

/// The document after its scripts have run.
fn rendered(browser: &str, path: &Path) -> String {
    let profile = path.with_extension("profile");
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg("--dump-dom")
        .arg(format!("file://{}", path.display()))
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn switches_sliders_and_tables_work_in_a_browser() {
    let Some(browser) = browser() else {
        // Past the capture of the test harness, which hides what a test prints that passes.
        let missing =
            "not tested: there is no chromium on this machine, in which the page could be operated";
        writeln!(std::io::stderr(), "{missing}").unwrap();
        return;
    };
    let (path, text) = stack("browser");
    let listener = "<body><script>addEventListener(\"error\", (it) => { (window.errors ??= []).push(it.message); });</script>";
    let probe = format!("<script>{}</script></body>", include_str!("page/probe.js"));
    fs::write(&path, text.replace("<body>", listener).replace("</body>", &probe)).unwrap();
    let document = rendered(browser, &path);
    let log = document.split("<pre id=\"probe\">").nth(1);
    let log = log.and_then(|it| it.split("</pre>").next());
    let log = log.unwrap_or_else(|| panic!("the page was not operated:\n{document}"));
    let log = log.replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">");
    let log: Value = serde_json::from_str(&log).unwrap();
    assert_eq!(log["errors"], serde_json::json!([]));

    let state = |name: &str| -> (Vec<&str>, &str) {
        let it = &log[name];
        assert_eq!(it["pictures"], it["pressed"], "{name}");
        let pictures = it["pictures"].as_array().unwrap().iter();
        (pictures.map(|it| it.as_str().unwrap()).collect(), it["step"].as_str().unwrap())
    };
    assert_eq!(state("opened"), (vec!["forces"], "push 3/3"));
    assert_eq!(log["opened"]["scale"], Value::Null, "forces have no scale of displacements");
    assert_eq!(state("deformed"), (vec!["deformed"], "push 3/3"));
    assert_eq!(state("first"), (vec!["deformed"], "weight 1/1"));
    assert_eq!(state("forces"), (vec!["forces"], "weight 1/1"));
    assert_eq!(state("addressed"), (vec!["scene"], "push 1/3"));
    assert_eq!(log["first"]["frames"], serde_json::json!(["weight 1/1"]));
    assert!(log["first"]["hash"].as_str().unwrap().contains("picture=deformed&step=0"));

    // The mark of the step in the curves follows the slider.
    let marks = log["marks"].as_array().unwrap();
    assert_eq!(marks.len(), 4);
    assert_eq!(log["opened"]["mark"], marks[3]);
    assert_eq!(log["first"]["mark"], marks[0]);

    // Displacements go with the slider: none at zero, twice those of the file at its end.
    let corner = |name: &str, of: &str| -> [f64; 2] {
        [0, 1].map(|k| log[name]["corner"][of][k].as_f64().unwrap())
    };
    let before = corner("deformed", "before");
    let (once, twice) = (corner("deformed", "now"), corner("twice", "now"));
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    assert!(distance(corner("still", "now"), before) < 0.02);
    assert!(distance(once, before) > 1.0);
    for k in 0..2 {
        assert!((twice[k] - before[k] - 2.0 * (once[k] - before[k])).abs() < 0.02);
    }
    assert_eq!(log["still"]["scale"], "magnified 0 times");
    let legend = log["twice"]["corner"]["legend"].as_array().unwrap();
    assert!(legend.contains(&log["twice"]["scale"]), "paper has no sliders: {legend:?}");

    let column = |name: &str| -> Vec<f64> {
        log[name].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect()
    };
    let (ascending, mut descending) = (column("ascending"), column("descending"));
    assert!(ascending.is_sorted() && ascending.len() == 2, "{ascending:?}");
    descending.reverse();
    assert_eq!(ascending, descending);
}
