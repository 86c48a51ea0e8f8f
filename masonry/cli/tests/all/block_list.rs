//! Single blocks from a JSON list beside the scene.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use masonry::scene::{Scene, SceneErrorKind};
use masonry::units::Units;
use serde_json::Value;

/// Two leaning posts and a lintel.
const LIST: &str = r#"[
  { "material": "stone", "corners": [[0.0, 0.0], [0.6, 0.0], [0.5, 2.0], [0.1, 2.0]] },
  { "material": "stone", "corners": [[2.0, 0.0], [2.6, 0.0], [2.5, 2.0], [2.1, 2.0]] },
  { "name": "lintel", "material": "stone",
    "corners": [[0.0, 2.0], [2.6, 2.0], [2.6, 2.4], [0.0, 2.4]] }
]"#;

const SCENE: &str = "title = \"Portal\"\nthickness = 0.5\ngravity = [0.0, -10.0]\nblock_list = \"portal.json\"\n\
    units = { length = \"m\", force = \"kN\" }\nmaterials.stone.density = 2000.0\njoints.bed.mu = 0.6\n\
    [[supports]]\nname = \"floor\"\nfrom = [-1.0, 0.0]\nto = [4.0, 0.0]\njoint = \"bed\"\n\
    [[loads]]\nname = \"beam\"\nblock = \"lintel\"\nat = [1.3, 2.4]\nforce = [0.0, -5.0]\n";

/// The path of a scene with its list, in a directory of its own.
fn written(name: &str, scene: &str, list: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("block_list").join(name);
    fs::create_dir_all(&directory).unwrap();
    fs::write(directory.join("portal.json"), list).unwrap();
    let path = directory.join("scene.toml");
    fs::write(&path, scene).unwrap();
    path
}

fn masonry(command: &str, path: &Path) -> Output {
    let arguments = [command, path.to_str().unwrap(), "--json"];
    Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap()
}

#[test]
fn blocks_of_a_list_are_blocks() {
    let path = written("good", SCENE, LIST);
    let output = masonry("solve", &path);
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&result["verdict"], &result["plan"]["blocks"]), (&"stands".into(), &3.into()));
    // Two posts of 1 m2 and a lintel of 1.04 m2, half a metre thick, and the beam.
    let floor = result["reactions"]["floor"]["fy"].as_f64().unwrap();
    assert!((floor - (3.04 * 10.0 + 5.0)).abs() < 1e-9, "{floor}");

    let scene = Scene::read(&path).unwrap();
    let names: Vec<&str> = scene.blocks.iter().map(|block| block.name.as_str()).collect();
    assert_eq!(names, ["portal/1", "portal/2", "lintel"]);
    // As text the scene stands for itself.
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    // Blocks of the scene come first.
    let more = "[[blocks]]\nname = \"stone\"\nmaterial = \"stone\"\ncorners = [[3, 0], [4, 0], [4, 1], [3, 1]]\n";
    let scene = Scene::read(&written("more", &format!("{SCENE}{more}"), LIST)).unwrap();
    assert_eq!((scene.blocks.len(), scene.blocks[0].name.as_str()), (4, "stone"));
}

/// The message for a list in which a piece of text is another; `^` stands below the mistake.
#[track_caller]
fn assert_message(name: &str, piece: &str, other: &str, expected: &str) {
    assert_eq!(LIST.matches(piece).count(), 1, "`{piece}` must occur once");
    let path = written(name, SCENE, &LIST.replace(piece, other));
    let output = masonry("plan", &path);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    let message = String::from_utf8(output.stderr).unwrap();
    let message = message.replace(&format!("{}/", path.parent().unwrap().display()), "");
    assert_eq!(message, format!("error: portal.json, {expected}\n"));
}

#[test]
fn mistakes_in_a_list_have_their_place_in_it() {
    assert_message(
        "clockwise",
        "[[2.0, 0.0], [2.6, 0.0], [2.5, 2.0], [2.1, 2.0]]",
        "[[2.1, 2.0], [2.5, 2.0], [2.6, 0.0], [2.0, 0.0]]",
        "line 3, column 37\n  |\n\
         3 |   { \"material\": \"stone\", \"corners\": [[2.1, 2.0], [2.5, 2.0], [2.6, 0.0], [2.0, 0.0]] },\n  \
         |                                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n\
         blocks[1].corners: the corners of block \"portal/2\" run clockwise (area -1 m2): list them counter-clockwise",
    );
    assert_message(
        "material",
        "\"lintel\", \"material\": \"stone\"",
        "\"lintel\", \"material\": \"stole\"",
        "line 4, column 35\n  |\n\
         4 |   { \"name\": \"lintel\", \"material\": \"stole\",\n  \
         |                                   ^^^^^^^\n\
         blocks[2].material: there is no material \"stole\" in the scene; did you mean \"stone\"? there is \"stone\": \
         correct the name or add [materials.stole]",
    );
    assert_message(
        "key",
        "\"name\"",
        "\"nam\"",
        "line 4, column 9\n  |\n\
         4 |   { \"nam\": \"lintel\", \"material\": \"stone\",\n  \
         |         ^\n\
         unknown field `nam`; did you mean `name`? expected one of `name`, `material`, `corners`, `mesh`",
    );
    assert_message(
        "corner",
        "[2.6, 2.4], [0.0, 2.4]",
        "[2.6, 2.4, 0.0], [0.0, 2.4]",
        "line 5, column 55\n  |\n\
         5 |     \"corners\": [[0.0, 2.0], [2.6, 2.0], [2.6, 2.4, 0.0], [0.0, 2.4]] }\n  \
         |                                                       ^\n\
         invalid length 3, expected a list of exactly 2 items",
    );
}

#[test]
fn a_list_that_is_not_there_is_named() {
    let path = written("missing", &SCENE.replace("portal.json", "gate.json"), LIST);
    let output = masonry("plan", &path);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("scene.toml, line 4, column 14"), "{message}");
    assert!(message.contains("cannot read the list of blocks gate.json: "), "{message}");
    assert!(message.contains("name a JSON list or a drawing, relative to the scene"), "{message}");
    // Of a scene that is built in Rust nobody reads it.
    let mut built = Scene::new("built", Units::SI).thickness(1.0);
    built.block_list = Some("portal.json".into());
    let error = built.check().unwrap_err();
    assert!(matches!(error.kind(), SceneErrorKind::BlockList { .. }), "{error}");
}

/// The list is read for the scene: no picture takes its place. Names of files reach no terminal raw.
#[test]
fn a_list_is_not_overwritten() {
    let path = written("kept", SCENE, LIST);
    let list = path.with_file_name("portal.json");
    let draw = |out: &str| {
        let arguments = ["draw", path.to_str().unwrap(), "--out", out];
        let output = Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, errors) = draw(list.to_str().unwrap());
    assert!(code == Some(2) && errors.contains("is read for the scene"), "{errors}");
    assert_eq!(fs::read_to_string(list).unwrap(), LIST);
    let (code, errors) = draw("missing\u{1b}[2J/picture.svg");
    assert!(code == Some(2) && errors.contains("missing\\u{1b}[2J/picture.svg"), "{errors}");
}

/// A DXF file in millimetres: lines, and closed polylines of more than two points, each on a layer.
fn dxf(shapes: &[(&str, &[[u32; 2]])]) -> String {
    let mut text =
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
            .to_owned();
    for (handle, (layer, points)) in (1..).zip(shapes) {
        if let [[x, y], [u, v]] = points {
            let _ = write!(
                text,
                "0\nLINE\n5\n{handle}\n8\n{layer}\n10\n{x}\n20\n{y}\n11\n{u}\n21\n{v}\n"
            );
            continue;
        }
        let _ = write!(text, "0\nLWPOLYLINE\n5\n{handle}\n8\n{layer}\n70\n1\n");
        for [x, y] in *points {
            let _ = write!(text, "10\n{x}\n20\n{y}\n");
        }
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

/// The portal as a drawing, its lintel a millimetre too high, with a line along the joint on the left post.
const DRAWING: [(&str, &[[u32; 2]]); 5] = [
    ("stone", &[[0, 0], [600, 0], [500, 2000], [100, 2000]]),
    ("stone", &[[2000, 0], [2600, 0], [2500, 2000], [2100, 2000]]),
    ("oak", &[[0, 2001], [2600, 2001], [2600, 2400], [0, 2400]]),
    ("joint-smooth", &[[0, 2000], [600, 2000]]),
    ("support_pier", &[[1900, 0], [2700, 0]]),
];

fn drawn(name: &str, shapes: &[(&str, &[[u32; 2]])], more: &str) -> PathBuf {
    let scene = SCENE.replace("portal.json", "portal.dxf").replace("lintel", "oak/1");
    let scene = scene.replace("[-1.0, 0.0]\nto = [4.0, 0.0]", "[0.0, 0.0]\nto = [0.6, 0.0]");
    let scene =
        scene.replace("joints.bed", &format!("{more}materials.oak.density = 700.0\njoints.bed"));
    let path = written(name, &scene, LIST);
    fs::write(path.with_file_name("portal.dxf"), dxf(shapes)).unwrap();
    path
}

const SMOOTH: &str = "joints.smooth.mu = 0.3\njoints.support.mu = 0.6\ncontact.tolerance = 0.01\n";

#[test]
fn a_list_may_be_a_drawing() {
    let path = drawn("drawing", &DRAWING, SMOOTH);
    let output = masonry("solve", &path);
    let result: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{output:?}"));
    assert_eq!((&result["verdict"], &result["plan"]["joints"]), (&"stands".into(), &4.into()));
    // What was changed of the drawing is told.
    let warnings: Vec<&str> =
        result["warnings"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    let moved = "Reading the drawing portal.dxf: 3 x corners were moved so that blocks meet exactly, by up to 0.000";
    assert!(warnings.iter().any(|it| it.starts_with(moved)), "{warnings:?}");
    let planned = String::from_utf8(masonry("plan", &path).stderr).unwrap();
    assert!(planned.contains(&format!("warning: {moved}")), "{planned}");
    let up = ["floor", "pier"].map(|name| result["reactions"][name]["fy"].as_f64().unwrap());
    // Half a metre thick: two posts of stone, the lintel of oak from 2000.5 mm, and the beam in the middle.
    let half = 0.5 * (0.5 * (20.0 * 2.0 * 1.0 + 7.0 * 2.6 * 0.4) + 5.0);
    // How two points on each post share the lintel is not unique; corners were moved by half a millimetre.
    assert!((up[0] + up[1] - 2.0 * half).abs() < 0.01, "{up:?} instead of {half}");

    let scene = masonry_import::read_scene(&path).unwrap();
    let names: Vec<&str> = scene.blocks.iter().map(|block| block.name.as_str()).collect();
    assert_eq!(names, ["stone/1", "stone/2", "oak/1"]);
    assert_eq!((scene.between.len(), scene.between[0].joint.as_str()), (1, "smooth"));
    assert_eq!(scene.supports[1].name, "pier");
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    assert_eq!(scene.files().nth(1), Some(path.with_file_name("portal.dxf").as_path()));
}

/// A line that is drawn twice is one support, and so is one on the floor of the scene.
#[test]
fn supports_of_a_drawing_count_once() {
    let mut shapes = DRAWING.to_vec();
    shapes.push(("support_again", &[[1900, 0], [2700, 0]]));
    shapes.push(("support_floor_again", &[[0, 0], [600, 0]]));
    let output = masonry("solve", &drawn("supports_twice", &shapes, SMOOTH));
    let result: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{output:?}"));
    assert_eq!((&result["verdict"], &result["plan"]["joints"]), (&"stands".into(), &4.into()));
    assert_eq!(result["reactions"].as_object().unwrap().len(), 2);
}

#[test]
fn mistakes_in_a_drawing_have_the_entity() {
    let message = |path: &Path| {
        let output = masonry("plan", path);
        assert_eq!(output.status.code(), Some(2));
        let message = String::from_utf8(output.stderr).unwrap();
        message.replace(&format!("{}/", path.parent().unwrap().display()), "")
    };
    let mut shapes = DRAWING;
    shapes[1].0 = "marble";
    let unknown = message(&drawn("marble", &shapes, SMOOTH));
    assert!(
        unknown.starts_with("error: portal.dxf, LWPOLYLINE 2 (line ")
            && unknown.contains("no material \"marble\""),
        "{unknown}"
    );
    let mut shapes = DRAWING;
    shapes[2].1 = &[[0, 1900], [2600, 1900], [2600, 2400], [0, 2400]];
    let overlap = message(&drawn("overlap", &shapes, SMOOTH));
    assert!(overlap.contains("scene.toml, line 4, column 14"), "{overlap}");
    assert!(
        overlap.contains("LWPOLYLINE 1 (line ") && overlap.contains("overlap by 0.1 m"),
        "{overlap}"
    );
    // The drawing was found: no other is asked for.
    assert!(!overlap.contains("name a JSON list"), "{overlap}");
    assert!(overlap.contains("; in a scene the tolerance is `contact.tolerance`"), "{overlap}");
    let bad = drawn("ending", &DRAWING, SMOOTH);
    let text = fs::read_to_string(&bad).unwrap().replace("portal.dxf", "portal.dwg");
    fs::write(&bad, text).unwrap();
    fs::write(bad.with_file_name("portal.dwg"), "AC1032").unwrap();
    let bad = message(&bad);
    assert!(
        bad.contains("portal.dwg: a drawing must be a .dxf, .svg, .obj or .json file"),
        "{bad}"
    );
}

/// A device may have no end, and a pipe no beginning.
#[cfg(unix)]
#[test]
fn devices_and_pipes_are_no_lists() {
    let path = written("pipe", &SCENE.replace("portal.json", "pipe.dxf"), LIST);
    let pipe = path.with_file_name("pipe.dxf");
    let _ = fs::remove_file(&pipe);
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let words = "it is a device or a pipe, and not a file";
    let message = |output: Output| {
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8(output.stderr).unwrap()
    };
    let listed = message(masonry("plan", &path));
    assert!(listed.contains(&format!("the list of blocks pipe.dxf: {words}")), "{listed}");
    let scene = message(masonry("plan", Path::new("/dev/zero")));
    assert!(scene.contains(&format!("cannot read the scene: {words}")), "{scene}");
    let import = ["import", pipe.to_str().unwrap()];
    let output = Command::new(env!("CARGO_BIN_EXE_masonry")).args(import).output().unwrap();
    assert!(message(output).contains(words));
}

#[test]
fn two_drawings_are_two_files() {
    let path = written("one", SCENE, LIST);
    let one = path.with_file_name("one.dxf");
    let one = one.to_str().unwrap();
    let draw = ["draw", path.to_str().unwrap(), "--out", one, "--dxf", one];
    let output = Command::new(env!("CARGO_BIN_EXE_masonry")).args(draw).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("is both --out and --dxf: choose two files"), "{message}");
    assert!(output.status.code() == Some(2) && !Path::new(one).exists());
}
