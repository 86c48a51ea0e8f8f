//! `masonry limit` against published values and closed forms.

mod growth;

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use masonry::analysis::limit::{
    Bracket, Laws, least_thickness_observed, limit, limit_observed, ranges_observed,
};
use masonry::scene::Scene;
use masonry_report::limit::range_json;
use serde_json::Value;

fn masonry(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap()
}

/// A scene in a directory of its own.
fn written(name: &str, scene: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("limit").join(name);
    fs::create_dir_all(&directory).unwrap();
    let path = directory.join("scene.toml");
    fs::write(&path, scene).unwrap();
    path
}

fn given(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

/// The object that a command prints, and its code.
#[track_caller]
fn object(path: &Path, more: &[&str]) -> (Value, i32) {
    let arguments = [&["limit", path.to_str().unwrap(), "--json"], more].concat();
    let output = masonry(&arguments);
    let text = String::from_utf8(output.stdout).unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    let object = serde_json::from_str(&text).unwrap_or_else(|_| panic!("{text}{errors}"));
    (object, output.status.code().unwrap())
}

/// The factor is the expected one by both laws, and proved of associated flow.
#[track_caller]
fn assert_factor(path: &Path, expected: f64) {
    let object = assert_associative(path, expected);
    let stands = object["path"]["load_factor"].as_f64().unwrap();
    assert!((stands / expected - 1.0).abs() < 1e-4, "path {stands} of {expected}");
}

/// The factor of associated flow is the expected one and proved, and that of the path is not above it.
#[track_caller]
fn assert_associative(path: &Path, expected: f64) -> Value {
    let (object, code) = object(path, &[]);
    let found = &object["associative"];
    let number = |key: &str| found[key].as_f64().unwrap();
    assert_eq!((&found["answer"], &found["proved"], code), (&"fails".into(), &true.into(), 0));
    for key in ["load_factor", "bound"] {
        let error = (number(key) / expected - 1.0).abs();
        assert!(error < 1e-4, "{key} {} of {expected}", number(key));
    }
    assert!(number("load_factor") <= number("bound"));
    let path = &object["path"];
    let stands = path["load_factor"].as_f64().unwrap();
    assert!(stands <= number("bound") && path["decided"] == true, "{stands}");
    assert!(path["falls"].as_f64().unwrap() > stands && path["mechanism"].is_object());
    assert_eq!(path["last_stable"]["load_factor"], path["load_factor"]);
    assert!((number("bound") - number("load_factor") - number("gap")).abs() < 1e-15);
    assert!(found["mechanism"].is_object());
    object
}

/// A scene of single blocks on a floor, and more.
fn blocks(mu: f64, corners: &[[[f64; 2]; 4]], more: &str) -> String {
    let blocks = corners.iter().enumerate().map(|(k, corners)| {
        format!("[[blocks]]\nname = \"{k}\"\nmaterial = \"stone\"\ncorners = {corners:?}\n")
    });
    format!(
        "title = \"Blocks\"\nthickness = 1.0\ngravity = [0.0, -10.0]\n\
         units = {{ length = \"m\", force = \"kN\" }}\n\
         materials.stone.density = 1000.0\njoints.bed.mu = {mu}\n{}\
         [[supports]]\nname = \"floor\"\nfrom = [-1.0, 0.0]\nto = [1.0, 0.0]\njoint = \"bed\"\n{more}",
        blocks.collect::<String>()
    )
}

/// `n` equal blocks on top of each other.
fn stack(n: u32, breadth: f64, height: f64) -> Vec<[[f64; 2]; 4]> {
    (0..n)
        .map(|k| [f64::from(k) * height, f64::from(k + 1) * height])
        .map(|[low, high]| [[0.0, low], [breadth, low], [breadth, high], [0.0, high]])
        .collect()
}

const SIDEWAYS: &str = "[[loads]]\nname = \"sideways\"\nacceleration = [10.0, 0.0]\n";

/// M. C. Ferris and F. Tin-Loi, International Journal of Mechanical Sciences 43 (2001) 209-224, print 0.64286, 0.580 and 0.404.
/// The digits are those of a linear program set up independently.
#[test]
fn walls_of_ferris_and_tin_loi() {
    for (number, factor) in [(1, 0.642_859), (2, 0.579_999), (3, 0.403_694)] {
        let path = given(&format!("ferris_wall_{number}.toml"));
        let (object, _) = object(&path, &["--law", "associative"]);
        let found = object["associative"]["load_factor"].as_f64().unwrap();
        assert!((found / factor - 1.0).abs() < 1e-4 && object["path"].is_null(), "{found}");
    }
}

/// They print 0.640, 0.563 and 0.356 for joints that do not open when they slide.
#[test]
fn walls_of_ferris_and_tin_loi_along_a_path() {
    let walls = [(1, 0.640, 0.642_859), (2, 0.563, 0.579_999), (3, 0.356, 0.403_694)];
    for (number, factor, bound) in walls {
        let path = given(&format!("ferris_wall_{number}.toml"));
        let object = assert_associative(&path, bound);
        let path = &object["path"];
        let stands = path["load_factor"].as_f64().unwrap();
        assert!((stands / factor - 1.0).abs() < 0.01, "{stands} of {factor}");
        let sentence = object["sentence"].as_str().unwrap();
        assert!(sentence.contains("(path)") && sentence.contains("(proved)"), "{sentence}");
        // Factors grow, and every event is between two of them.
        let factors: Vec<f64> = path["curve"]
            .as_array()
            .unwrap()
            .iter()
            .map(|it| it["load_factor"].as_f64().unwrap())
            .collect();
        assert!(factors.is_sorted() && factors[0].abs() <= 0.0);
        let events = path["events"].as_array().unwrap();
        assert!(!events.is_empty());
        for event in events {
            let [after, before] = ["after", "before"].map(|key| event[key].as_f64().unwrap());
            assert!(after < before && before <= stands, "{event}");
        }
        // The weight is balanced, and its share to the side.
        let floor = &path["last_stable"]["reactions"]["floor"];
        let (fx, fy) = (floor["fx"].as_f64().unwrap(), floor["fy"].as_f64().unwrap());
        assert!((fx / fy + stands).abs() < 1e-8, "{fx} {fy}");
    }
}

/// A block of 10 kN slides at `mu` times its weight, 3 kN, over a gap of a millimetre. Then it leans on a second one of
/// 13 kN, and both slide at 6.9 kN.
#[test]
fn events_are_located() {
    let one = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let two = [[1.001, 0.0], [2.301, 0.0], [2.301, 1.0], [1.001, 1.0]];
    let load = "[[loads]]\nname = \"push\"\nblock = \"0\"\nat = [0.0, 0.1]\nforce = [1.0, 0.0]\n\
                [joints.head]\nmu = 0.0\n[contact]\ngap_limit = 0.01\n";
    let scene = blocks(0.3, &[one, two], load).replace("to = [1.0, 0.0]", "to = [4.0, 0.0]");
    let object = assert_associative(&written("events", &scene), 6.9);
    let path = &object["path"];
    assert!((path["load_factor"].as_f64().unwrap() / 6.9 - 1.0).abs() < 1e-3, "{path}");
    let events = path["events"].as_array().unwrap();
    let slides = |it: &&Value| it["change"] == "slides" && it["between"][1] == "0";
    let event = events.iter().find(slides).unwrap();
    let [after, before] = ["after", "before"].map(|key| event[key].as_f64().unwrap());
    assert!(after <= 3.0 && 3.0 <= before && before - after < 6.9e-3, "{event}");
}

#[test]
fn a_law_that_is_not_asked_for_is_null() {
    let path = written("law", &blocks(0.3, &stack(1, 1.0, 1.0), SIDEWAYS));
    let (object, code) = object(&path, &["--law", "path"]);
    assert!(object["associative"].is_null() && code == 0);
    let stands = object["path"]["load_factor"].as_f64().unwrap();
    assert!((stands - 0.3).abs() < 1e-4, "{stands}");
    assert_eq!(object["path"]["dry_joints"], 1);
}

/// It slides at `mu` and tips over at breadth by height.
#[test]
fn a_block_slides_or_tips() {
    for (breadth, mu, factor) in [(0.2, 0.7, 0.2), (0.6, 0.5, 0.5)] {
        let scene = blocks(mu, &stack(1, breadth, 1.0), SIDEWAYS);
        assert_factor(&written(&format!("block_{breadth}"), &scene), factor);
    }
}

/// `min(mu, b / (n h))`.
#[test]
fn a_stack_slides_or_tips() {
    for (n, factor) in [(2, 0.6), (3, 0.6), (5, 0.4), (10, 0.2)] {
        let scene = blocks(0.6, &stack(n, 1.0, 0.5), SIDEWAYS);
        assert_factor(&written(&format!("stack_{n}"), &scene), factor);
    }
}

/// A plank of a metre and 1 kN lies on three quarters of its length: a force at its end tips it at its weight.
#[test]
fn an_overhang_tips() {
    let plank = [[0.25, 0.0], [1.25, 0.0], [1.25, 0.1], [0.25, 0.1]];
    let load = "[[loads]]\nname = \"end\"\nblock = \"0\"\nat = [1.25, 0.1]\nforce = [0.0, -1.0]\n";
    assert_factor(&written("overhang", &blocks(0.6, &[plank], load)), 1.0);
}

/// Four blocks of a metre, each 0.2 m farther out than the one below, and a force of the weight of one at the tip. Above the
/// joint below three of them it acts at 0.6 m from the edge, their weight at 0.1 m: `3 * 0.1 / 0.6`.
#[test]
fn a_corbel_tips() {
    let corbel: Vec<[[f64; 2]; 4]> = [0.0, 0.25, 0.5, 0.75]
        .into_iter()
        .map(|low| (0.8 * low, low, low + 0.25))
        .map(|(x, low, high)| [[x, low], [x + 1.0, low], [x + 1.0, high], [x, high]])
        .collect();
    let load = "[[loads]]\nname = \"tip\"\nblock = \"3\"\nat = [1.6, 1.0]\nforce = [0.0, -2.5]\n";
    assert_factor(&written("corbel", &blocks(0.6, &corbel, load)), 0.5);
}

/// A load on an edge: `mu` times the weight of 10 kN over 1 m2 of the side. Elastic blocks carry what rigid ones do.
#[test]
fn a_load_on_an_edge_pushes_rigid_and_elastic_blocks() {
    let load = "[[loads]]\nname = \"push\"\nfrom = [0.0, 0.0]\nto = [0.0, 1.0]\npressure = 2.0\nfactor = 0.5\n";
    let rigid = blocks(0.3, &stack(1, 1.0, 1.0), load);
    assert_factor(&written("edge", &rigid), 3.0);
    let elastic = rigid
        .replace(
            "materials.stone.density = 1000.0",
            "plane = \"stress\"\nmaterials.stone = { density = 1000.0, E = 1e6, nu = 0.2 }",
        )
        .replace("material = \"stone\"", "material = \"stone\"\nmesh = [3, 3]");
    assert_factor(&written("elastic", &elastic), 3.0);
}

/// The weight of 10 kN and a tensile strength of 2 kN/m2 under 1 m2 hold a pull of 12 kN; cohesion holds a push of
/// `mu W + c A`.
#[test]
fn strength_adds_to_the_limit() {
    let strong = |load: &str| {
        let glued = "joints.bed = { mu = 0.5, cohesion = 3.0, tension = 2.0 }";
        blocks(0.5, &stack(1, 1.0, 1.0), load).replace("joints.bed.mu = 0.5", glued)
    };
    let at = |force: &str| {
        format!("[[loads]]\nname = \"pull\"\nblock = \"0\"\nat = [0.5, 0.0]\nforce = {force}\n")
    };
    assert_factor(&written("pull", &strong(&at("[0.0, 1.0]"))), 12.0);
    assert_factor(&written("glue", &strong(&at("[1.0, 0.0]"))), 8.0);
}

#[test]
fn what_presses_on_the_floor_has_no_limit() {
    let load = "[[loads]]\nname = \"top\"\nfrom = [0.0, 1.0]\nto = [1.0, 1.0]\npressure = 1.0\n";
    let (object, code) = object(&written("press", &blocks(0.3, &stack(1, 1.0, 1.0), load)), &[]);
    let found = &object["associative"];
    assert_eq!((&found["answer"], &found["proved"]), (&"does not fail".into(), &true.into()));
    assert!(found["load_factor"].is_null() && code == 0);
    assert!(object["sentence"].as_str().unwrap().contains("carry any factor (proved)"));
    let path = &object["path"];
    assert!(path["falls"].is_null() && path["load_factor"].as_f64().unwrap() > 100.0);
}

/// Loads of a millionth and of a million times the size have factors that are as much larger and smaller. Without friction
/// nothing is carried to the side.
#[test]
fn factors_follow_the_size_of_what_grows() {
    for (push, factor) in [("1e-5", 2e5), ("1e7", 2e-7)] {
        let load = SIDEWAYS.replace("10.0", push);
        assert_factor(&written(push, &blocks(0.7, &stack(1, 0.2, 1.0), &load)), factor);
    }
    let (object, code) =
        object(&written("smooth", &blocks(0.0, &stack(2, 1.0, 1.0), SIDEWAYS)), &[]);
    let [stands, bound] = [("path", "load_factor"), ("associative", "bound")]
        .map(|(law, key)| object[law][key].as_f64().unwrap());
    assert!(stands.abs() <= 0.0 && bound < 1e-5 && code == 0, "{stands} {bound}");
}

/// The observer ends the search as soon as the bracket is narrower than it was asked for.
#[test]
fn an_interrupted_search_keeps_its_bracket() {
    let scene = Scene::read(&given("ferris_wall_1.toml")).unwrap();
    let mut told = Bracket::default();
    let limit = limit_observed(&scene, Laws::Both, &mut |at| {
        told = at;
        if at.stands.is_some_and(|stands| stands > 0.3) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .unwrap();
    let path = limit.path.unwrap();
    assert!(limit.is_interrupted && !path.decided);
    assert_eq!(Bracket { stands: path.load_factor, falls: path.falls }, told);
    let [stands, falls] = [told.stands, told.falls].map(Option::unwrap);
    assert!(0.3 < stands && stands < 0.64 && 0.64 < falls, "{stands} {falls}");
    // Rounded down.
    let stands = (1e4 * stands).floor() / 1e4;
    assert_eq!(
        limit.sentence,
        format!(
            "Interrupted. Known so far of \"sideways\": stands up to {stands:.4} (path), cannot stand above 0.6429 (proved)."
        )
    );
    // Before anything was known, and in the search for a thickness.
    let limit = limit_observed(&scene, Laws::Both, &mut |_| ControlFlow::Break(())).unwrap();
    assert_eq!(limit.sentence, "Interrupted before anything was known of \"sideways\".");
    let arch = String::from_utf8(masonry(&["new", "arch"]).stdout).unwrap();
    let arch = Scene::from_toml(&arch).unwrap();
    let found = least_thickness_observed(&arch, "arch", &mut |at| match at {
        Bracket { stands: Some(_), falls: Some(_) } => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    })
    .unwrap();
    assert!(found.is_interrupted && !found.proved && found.stands > found.falls);
    assert!(found.sentence.starts_with("Interrupted. Arch \"arch\" stands at a thickness of "));
}

#[test]
fn an_interrupted_range_has_open_ends() {
    let arch = Scene::read(&given("arch_semicircular.toml")).unwrap();
    let range = ranges_observed(&arch, &mut |_| ControlFlow::Break(())).unwrap();
    let json: Value = serde_json::from_str(&range_json(&range).unwrap()).unwrap();
    assert_eq!(json["interrupted"], true);
    assert!(json["sentence"].as_str().unwrap().starts_with("Interrupted. "));
    let ends = json["range"].as_object().unwrap().values().next().unwrap();
    assert_eq!(ends["fx"]["min"]["value"], Value::Null);
}

#[test]
fn what_falls_without_the_group_is_said_with_the_proof() {
    let scene = blocks(0.3, &stack(1, 1.0, 1.0), SIDEWAYS).replace("[0.0, -10.0]", "[4.0, -10.0]");
    let (object, code) = object(&written("falls", &scene), &[]);
    let found = &object["associative"];
    assert_eq!(
        (&found["answer"], &found["proved"]),
        (&"falls without the group".into(), &true.into())
    );
    assert!(found["load_factor"].is_null() && found["mechanism"].is_object() && code == 1);
}

#[test]
fn pictures_and_the_object_are_written() {
    let path = given("ferris_wall_3.toml");
    let out = written("pictures", "").with_file_name("out");
    let (object, _) = object(&path, &["--out", out.to_str().unwrap()]);
    assert_eq!(
        object["files"],
        serde_json::json!([
            "forces.svg",
            "mechanism.svg",
            "path_forces.svg",
            "path_mechanism.svg",
            "path.svg",
            "limit.json"
        ])
    );
    for name in ["forces.svg", "mechanism.svg", "path_forces.svg", "path_mechanism.svg", "path.svg"]
    {
        let text = fs::read_to_string(out.join(name)).unwrap();
        roxmltree::Document::parse(&text).unwrap();
    }
    let kept: Value =
        serde_json::from_str(&fs::read_to_string(out.join("limit.json")).unwrap()).unwrap();
    assert_eq!(kept["associative"], object["associative"]);
    // The resultant of the floor carries the weight, and the share of it to the side.
    let floor = &object["associative"]["reactions"]["floor"];
    let (fx, fy) = (floor["fx"].as_f64().unwrap(), floor["fy"].as_f64().unwrap());
    assert!((fx / fy + object["associative"]["load_factor"].as_f64().unwrap()).abs() < 1e-8);
}

#[test]
fn a_group_that_is_not_clear_is_a_mistake() {
    let block = |loads: &str| blocks(0.3, &stack(1, 1.0, 1.0), loads);
    let second = SIDEWAYS.replace("sideways", "wind");
    let zero = SIDEWAYS.replace("[10.0, 0.0]", "[0.0, 0.0]");
    let weightless =
        block("").replace("materials.stone.density = 1000.0\n", "materials.stone = {}\n");
    let cases: [(&str, String, &[&str], &str); 7] = [
        ("weightless", weightless, &[], "the blocks have no weight"),
        ("weight", block(SIDEWAYS), &["--group", "gravit"], "did you mean \"gravity\"?"),
        ("none", block("").replace("gravity = [0.0, -10.0]\n", ""), &[], "has no loads"),
        (
            "two",
            block(&[SIDEWAYS, &second].concat()),
            &[],
            "several groups of loads, \"sideways\", \"wind\"",
        ),
        ("zero", block(&zero), &[], "are zero"),
        ("name", block(SIDEWAYS), &["--group", "sidways"], "did you mean \"sideways\"?"),
        ("support", block(SIDEWAYS), &["--group", "floor"], "\"floor\" is a support"),
    ];
    for (name, scene, more, message) in cases {
        let path = written(&format!("mistake_{name}"), &scene);
        let output = masonry(&[&["limit", path.to_str().unwrap()], more].concat());
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.is_empty()), (Some(2), true), "{errors}");
        assert!(errors.contains(message), "{errors}");
    }
    // The one with a factor is meant where there are several.
    let factor = second + "factor = 0.5\n";
    let (object, _) = object(&written("factor", &block(&[SIDEWAYS, &factor].concat())), &[]);
    assert_eq!(object["group"], "wind");
}

/// Forces of a block between two walls are unlimited to the side, and up to what they hold up: a block of 10 kN that leans
/// on one wall without friction, on a floor with `mu = 0.3`, is pushed by at most 3 kN.
#[test]
fn ranges_of_reactions() {
    let wall = "[[supports]]\nname = \"wall\"\nfrom = [1.0, 0.0]\nto = [1.0, 1.0]\njoint = \"smooth\"\n\
                [joints.smooth]\nmu = 0.0\n";
    let scene = blocks(0.3, &stack(1, 1.0, 1.0), wall);
    let (single, code) = object(&written("range", &scene), &["--range"]);
    assert_eq!(single["interrupted"], false);
    let wall_fx = &single["range"]["wall"]["fx"];
    let value = |end: &Value| end["value"].as_f64().unwrap();
    assert!((value(&wall_fx["min"]) + 3.0).abs() < 1e-5 && value(&wall_fx["max"]).abs() < 1e-5);
    assert!((value(&single["range"]["floor"]["fy"]["max"]) - 10.0).abs() < 1e-5 && code == 0);
    // Cohesion of 3 kN/m2 adds 3 kN to the friction.
    let glued = scene.replace("joints.bed.mu = 0.3", "joints.bed = { mu = 0.3, cohesion = 3.0 }");
    let (glued, _) = object(&written("range_glued", &glued), &["--range"]);
    let least = &glued["range"]["wall"]["fx"]["min"];
    let bound = least["bound"].as_f64().unwrap();
    assert!((value(least) + 6.0).abs() < 1e-5 && (bound + 6.0).abs() < 1e-5, "{least}");
    let second = wall
        .lines()
        .take(5)
        .collect::<Vec<_>>()
        .join("\n")
        .replace("wall", "left")
        .replace("[1.0", "[0.0");
    let (both, _) = object(&written("range_two", &(scene + &second + "\n")), &["--range"]);
    assert_eq!(both["range"]["left"]["fx"]["max"]["unlimited"], true);
    assert!(value(&both["range"]["left"]["fx"]["min"]).abs() < 1e-5);
}

/// A bar that only a pull could keep between two posts which lean outwards falls freely, whatever the load: a place a
/// million metres below is no state of rest.
#[test]
fn a_free_fall_is_no_rest() {
    let scene = Scene::from_toml(
        r#"title = "A keystone upside down"
plane = "stress"
thickness = 1
gravity = [0, -9.81]
units = { length = "m", force = "kN" }
materials.stone = { density = 1000, E = 1e7, nu = 0.2 }
joints.s = { mu = 0.84 }
supports = [
  { name = "left", from = [-1.1547, 0], to = [-0.692819784648, 0.8], joint = "s" },
  { name = "right", from = [0.692819784648, 0.8], to = [1.1547, 0], joint = "s" }]
blocks = [{ name = "bar", material = "stone", mesh = [8, 4], corners = [
  [-1.1547, 0], [1.1547, 0], [0.692819784648, 0.8], [-0.692819784648, 0.8]] }]
loads = [{ name = "extra", block = "bar", at = [0, 0.2], force = [0, -1] }]
"#,
    )
    .unwrap();
    let path = limit(&scene).unwrap().path.unwrap();
    assert_eq!((path.load_factor, path.falls), (None, Some(0.0)));
    assert!(path.mechanism.is_some());
}

/// A block of jelly that is pressed together by many times its height rests all the same.
#[test]
fn what_a_soft_block_takes_is_no_fall() {
    let scene = Scene::from_toml(
        r#"title = "A soft block"
plane = "stress"
thickness = 1
gravity = [0, -10]
units = { length = "m", force = "N" }
materials.jelly = { density = 1000, E = 100, nu = 0 }
joints.s = { mu = 0.5 }
supports = [{ name = "floor", from = [-1, 0], to = [2, 0], joint = "s" }]
blocks = [{ name = "block", material = "jelly", mesh = [1, 1], corners = [[0, 0], [1, 0], [1, 1], [0, 1]] }]
loads = [{ name = "push", block = "block", at = [0, 0.1], force = [1000, 0] }]
"#,
    )
    .unwrap();
    let path = limit(&scene).unwrap().path.unwrap();
    // It slides at half its weight.
    assert!((path.load_factor.unwrap() - 5.0).abs() < 0.05 * 5.0, "{:?}", path.load_factor);
}
