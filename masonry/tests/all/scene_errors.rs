//! Mistakes in scenes: each is found, shown at its line and column, and told how to mend.
mod combinations;
mod limit;
mod loads;
mod mortar;
mod places;
mod stages;

use masonry::model::Model;
use masonry::scene::{
    Block, Brick, Courses, Joint, Load, Material, Scene, SceneError, SceneErrorKind, Support, Wall,
};
use masonry::units::Units;

const GOOD: &str = r#"title = "Two walls of rubble"
plane = "strain"
thickness = 0.5
gravity = [0.0, -9.81]

[units]
length = "m"
force = "kN"

[materials.brick]
E = 1e6
nu = 0.2
density = 1800.0

[materials.stone]

[joints.bed]
mu = 0.6

[joints.head]
phi_deg = 30.0

[[walls]]
name = "wall"
material = "brick"
origin = [0.0, 0.0]
brick = { length = 0.2, height = 0.1 }
width = 1.0
courses = 3
mesh = [4, 2]

[[walls]]
name = "list"
material = "brick"
origin = [2.0, 0.0]
brick = { length = 0.2, height = 0.1 }
courses = [[1, 1], [0.5, 1, 0.5]]
mesh = [2, 1]

[[blocks]]
name = "lintel"
material = "stone"
corners = [[0.0, 0.3], [1.0, 0.3], [1.0, 0.5], [0.0, 0.5]]

[[supports]]
name = "floor"
from = [-1.0, 0.0]
to = [3.0, 0.0]
joint = "bed"

[[loads]]
name = "top"
from = [0.0, 0.5]
to = [1.0, 0.5]
pressure = 10.0

[contact]
gap_limit = 0.0

[solver]
tolerance = 1e-10
"#;

/// The corners of the lintel.
const CORNERS: &str = "[[0.0, 0.3], [1.0, 0.3], [1.0, 0.5], [0.0, 0.5]]";

/// The error of the good scene with one piece of text replaced.
fn error_of(piece: &str, replacement: &str) -> SceneError {
    assert_eq!(GOOD.matches(piece).count(), 1, "`{piece}` must occur once");
    let text = GOOD.replace(piece, replacement);
    Scene::from_toml(&text)
        .and_then(|scene| Model::from_scene(&scene))
        .err()
        .unwrap_or_else(|| panic!("`{replacement}` is not refused"))
}

/// Line and column at which `marked` stands in the good scene with `piece` replaced.
fn place_of(piece: &str, replacement: &str, marked: &str) -> (usize, usize) {
    let text = GOOD.replace(piece, replacement);
    let start = GOOD.find(piece).expect("the piece occurs");
    let at = start + text[start..].find(marked).expect("the mark occurs");
    let line_start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    (text[..at].matches('\n').count() + 1, text[line_start..at].chars().count() + 1)
}

/// Asserts the place (where `marked` stands), the key and words of the message.
fn assert_error(piece: &str, replacement: &str, marked: &str, key: &str, words: &[&str]) {
    let error = error_of(piece, replacement);
    let place = place_of(piece, replacement, marked);
    let message = error.to_string();
    assert_eq!((error.line(), error.column()), (Some(place.0), Some(place.1)), "{message}");
    assert_eq!(error.key(), key, "{message}");
    let head = format!("line {}, column {}\n", place.0, place.1);
    for word in words.iter().chain(&[head.as_str(), "^"]) {
        assert!(message.contains(word), "no `{word}` in\n{message}");
    }
}

#[test]
fn the_scene_without_a_mistake_is_good() {
    let scene = Scene::from_toml(GOOD).unwrap();
    let model = Model::from_scene(&scene).unwrap();
    assert_eq!(model.blocks.len(), 5 + 6 + 5 + 2 + 3 + 1);
}

#[test]
fn the_message_shows_the_line_with_carets() {
    let error =
        error_of("length = 0.2, height = 0.1 }\nwidth", "length = -0.2, height = 0.1 }\nwidth");
    let shown = "line 27, column 20\n   |\n27 | brick = { length = -0.2, height = 0.1 }\n   |                    ^^^^\n\
                 walls[0].brick.length: -0.2 is not allowed: give a finite number greater than zero";
    assert!(error.to_string().starts_with(shown), "{error}");
}

/// The parser gives up at the next bracket, two lines below.
#[test]
fn a_list_without_an_end_is_named_by_its_beginning() {
    let error = error_of("mu = 0.6", "mu = [0.6 # ]");
    assert_eq!(error.line(), Some(20), "{error}");
    assert!(error.to_string().contains("that begins in line 18 may lack its end"), "{error}");
    // A comma is missing in the same line; a key is wrong within a list that has an end.
    for (piece, replacement) in [
        ("mesh = [4, 2]", "mesh = [4 2]"),
        ("courses = 3", "courses = 3\nopenings = [\n  { widht = 0.2 },\n]"),
    ] {
        let error = error_of(piece, replacement);
        assert!(!error.to_string().contains("may lack its end"), "{error}");
    }
}

#[test]
fn text_that_does_not_fit_the_format() {
    for (piece, replacement, marked, words) in [
        ("nu = 0.2", "mu = 0.2", "mu", "unknown field `mu`, expected one of `E`, `nu`, `density`"),
        ("plane = \"strain\"", "plane = \"stain\"", "\"stain\"", "expected `stress` or `strain`"),
        ("plane = \"strain\"", "plane = \"stain\"", "\"stain\"", "did you mean `strain`?"),
        ("mu = 0.6", "mu = 0.6\ncohesoin = 1.0", "cohesoin", "did you mean `cohesion`?"),
        ("[[supports]]", "[[suports]]", "suports", "did you mean `supports`?"),
        ("thickness = 0.5", "thickness = \"a\"", "\"a\"", "expected f64"),
        ("thickness = 0.5", "thickness = ", "\n", "string values must be quoted"),
        ("courses = 3", "courses = \"3\"", "\"3\"", "a number of courses, or a list of courses"),
        ("courses = 3", "courses = -3", "-3", "a number of courses, or a list of courses"),
        ("[0.5, 1, 0.5]", "[0.5, \"1\", 0.5]", "\"1\"", "expected f64"),
        ("material = \"stone\"\n", "", "[[blocks]]", "missing field `material`"),
        ("mesh = [4, 2]", "mesh = [4, 2, 1]", "[4", "length 3, expected a list of exactly 2 items"),
        ("origin = [2.0, 0.0]", "origin = [2.0]", "[2", "length 1, expected a list of exactly 2"),
        ("[0.0, 0.5]]", "[0.0, 0.5, 0.0]]", "[0.0", "length 3, expected a list of exactly 2"),
        (
            "origin = [2.0, 0.0]\nbrick = {",
            "origin = [2.0, 0.0]\nbrick = [0.2, 0.1]\n#",
            "[0.2",
            "invalid type: sequence",
        ),
        ("mesh = [4, 2]", "mesh = [4, -2]", "-2", "expected u32"),
        ("mu = 0.6", "mu = 0.6\nstiffness = 4e6", "4e6", "a list of exactly 2 items"),
        (
            "mu = 0.6",
            "mu = 0.6\nstiffness = [4e6]",
            "[4e6]",
            "length 1, expected a list of exactly 2",
        ),
        ("mu = 0.6", "mu = 0.6\nstifness = [1, 1]", "stifness", "did you mean `stiffness`?"),
        ("gap_limit = 0.0", "points = \"corners\"", "\"corners\"", "`nodal_pairs`"),
        ("tolerance = 1e-10", "form = \"fast\"", "\"fast\"", "`stewart_trinkle`"),
        ("[joints.head]", "[joints.bed]", "bed", "duplicate key"),
        ("[joints.bed]\nmu = 0.6", "[joints]\nbed = [0.6]\n", "[0.6]", "expected a table such as"),
        ("[solver]\ntolerance = 1e-10", "[[solver]]", "[[solver]]", "expected a table such as"),
        ("force = \"kN\"", "force = \"kn\"", "\"kn\"", "`kN`"),
    ] {
        let error = error_of(piece, replacement);
        assert!(matches!(error.kind(), SceneErrorKind::Syntax { .. }), "{error:?}");
        let message = error.to_string();
        assert!(message.contains(words), "no `{words}` in\n{message}");
        if marked == "[[blocks]]" {
            assert!(error.line().is_some());
            continue;
        }
        let place = place_of(piece, replacement, marked);
        assert_eq!((error.line(), error.column()), (Some(place.0), Some(place.1)), "{message}");
    }
}

#[test]
fn names_that_refer_to_nothing() {
    assert_error(
        "material = \"stone\"",
        "material = \"stome\"",
        "\"stome\"",
        "blocks[0].material",
        &[
            "no material \"stome\"",
            "did you mean \"stone\"? there is \"brick\", \"stone\"",
            "[materials.stome]",
        ],
    );
    assert_error(
        "joint = \"bed\"",
        "joint = \"floor\"",
        "\"floor\"",
        "supports[0].joint",
        &["no joint class \"floor\"", "\"bed\", \"head\"", "[joints.floor]"],
    );
}

#[test]
fn names_that_are_empty_or_taken() {
    assert_error(
        "name = \"list\"",
        "name = \"wall\"",
        "\"wall\"",
        "walls[1].name",
        &["the wall name \"wall\" is taken by walls[0]"],
    );
    assert_error("name = \"top\"", "name = \" \"", "\" \"", "loads[0].name", &["name is empty"]);
    assert_error(
        "[[supports]]\nname = \"floor\"",
        "[[supports]]\nname = \"floor\"\nfrom = [0, 0]\nto = [1, 0]\njoint = \"bed\"\n[[supports]]\nname = \"floor\"  ",
        "\"floor\"  ",
        "supports[1].name",
        &["taken by supports[0]"],
    );
    assert_error(
        "name = \"lintel\"",
        "name = \"list/2/3\"",
        "[[0.0, 0.3]",
        "blocks[0].corners",
        &["the block name \"list/2/3\" is taken by walls[1].courses"],
    );
}

#[test]
fn numbers_out_of_their_range() {
    for (piece, key, bad) in [
        ("E = 1e6", "materials.brick.E", vec!["0", "-1.0", "nan", "inf", "1e300"]),
        ("nu = 0.2", "materials.brick.nu", vec!["0.5", "-1.0", "nan", "-inf"]),
        ("density = 1800.0", "materials.brick.density", vec!["0", "-5", "nan"]),
        ("thickness = 0.5", "thickness", vec!["0.0", "-0.5", "nan", "inf", "1e-320"]),
        ("mu = 0.6", "joints.bed.mu", vec!["-0.1", "nan", "inf"]),
        ("mu = 0.6\ncohesion", "joints.bed.cohesion", vec!["-0.1", "nan", "inf"]),
        ("mu = 0.6\ntension", "joints.bed.tension", vec!["-0.1", "nan", "inf"]),
        ("phi_deg = 30.0", "joints.head.phi_deg", vec!["-1", "90.0", "nan"]),
        ("width = 1.0", "walls[0].width", vec!["0", "-1.0", "nan", "inf"]),
        ("courses = 3", "walls[0].courses", vec!["0", "4000000000"]),
        ("pressure = 10.0", "loads[0].pressure", vec!["nan", "inf"]),
        ("gap_limit = 0.0", "contact.gap_limit", vec!["-0.1", "nan", "inf"]),
        ("tolerance = 1e-10", "solver.tolerance", vec!["0", "1.0", "nan"]),
    ] {
        let name = piece.split(" = ").next().unwrap();
        for value in bad {
            let replacement = format!("{name} = {value}");
            let replacement = match piece.split_once('\n') {
                Some((first, new)) => format!("{first}\n{new} = {value}"),
                None => replacement,
            };
            let piece = piece.split('\n').next().unwrap();
            assert_error(piece, &replacement, value, key, &[]);
        }
    }
    for (piece, replacement, marked, key) in [
        ("gravity = [0.0, -9.81]", "gravity = [0.0, nan]", "nan", "gravity[1]"),
        ("mesh = [4, 2]", "mesh = [4, 0]", "0]", "walls[0].mesh[1]"),
        ("mesh = [4, 2]", "mesh = [4000, 1]", "4000", "walls[0].mesh[0]"),
        ("[0.5, 1, 0.5]", "[0.5, 0, 0.5]", "0, 0.5", "walls[1].courses[1][1]"),
        ("[0.5, 1, 0.5]", "[0.5, inf]", "inf", "walls[1].courses[1][1]"),
        ("[0.5, 1, 0.5]", "[0.5, 1e6]", "1e6", "walls[1].courses[1][1]"),
        ("origin = [2.0, 0.0]", "origin = [inf, 0.0]", "inf", "walls[1].origin[0]"),
        ("[1.0, 0.3], [1.0, 0.5]", "[1.0, nan], [1.0, 0.5]", "nan", "blocks[0].corners[1][1]"),
        ("tolerance = 1e-10", "max_pivots = 0", "0", "solver.max_pivots"),
        ("tolerance = 1e-10", "max_steps = 0", "0", "solver.max_steps"),
        ("pressure = 10.0", "traction = [0.0, inf]", "inf", "loads[0].traction[1]"),
        ("to = [3.0, 0.0]", "to = [-inf, 0.0]", "-inf", "supports[0].to[0]"),
        ("mu = 0.6", "mu = 0.6\nstiffness = [0.0, 1.0]", "0.0, 1", "joints.bed.stiffness[0]"),
        ("mu = 0.6", "mu = 0.6\nstiffness = [1.0, -2.0]", "-2.0", "joints.bed.stiffness[1]"),
        ("mu = 0.6", "mu = 0.6\nstiffness = [inf, 2.0]", "inf", "joints.bed.stiffness[0]"),
        ("mu = 0.6", "mu = 0.6\nstiffness = [1.0, nan]", "nan", "joints.bed.stiffness[1]"),
    ] {
        assert_error(piece, replacement, marked, key, &[]);
    }
}

/// Keys of the solver that its route has no use for.
#[test]
fn keys_of_another_route() {
    for (replacement, marked, key, words) in [
        ("route = \"interior\"\nform = \"mixed\"", "\"mixed\"", "solver.form", "route = \"lemke\""),
        ("route = \"qp\"\nmax_pivots = 7", "7", "solver.max_pivots", "route = \"lemke\""),
        ("route = \"pgs\"\nmax_steps = 7", "7", "solver.max_steps", "route = \"interior\""),
        ("route = \"lemke\"\nsoft = 1e-4", "1e-4", "solver.soft", "route = \"qp\""),
        ("soft = 0.125", "0.125", "solver.soft", "route = \"pgs\""),
        ("route = \"pgs\"\nsoft = 2.0", "2.0", "solver.soft", "at most 1"),
    ] {
        assert_error("tolerance = 1e-10", replacement, marked, key, &[words]);
    }
    let unknown = r#"route = "simplex""#;
    assert_error("tolerance = 1e-10", unknown, "\"simplex\"", "", &["interior", "lemke", "pgs"]);
}

#[test]
fn keys_that_belong_together() {
    for (piece, replacement, marked, key, words) in [
        ("nu = 0.2\n", "", "", "materials.brick", "`nu` is missing, but needed with `E`"),
        ("E = 1e6\n", "", "0.2", "materials.brick.nu", "no meaning without `E`"),
        ("width = 1.0\n", "", "", "walls[0]", "`width` is missing"),
        (
            "width = 1.0\ncourses = 3",
            "width = 1.0\ncourses = [[1]]",
            "1.0",
            "walls[0].width",
            "no meaning if `courses` is a list",
        ),
        ("mesh = [4, 2]\n", "", "", "walls[0]", "add `mesh = [1, 1]`"),
        ("mu = 0.6", "mu = 0.6\nphi_deg = 1", "1", "joints.bed.phi_deg", "both `mu` and `phi_deg`"),
        ("mu = 0.6", "", "", "joints.bed", "neither `mu` nor `phi_deg`"),
        ("pressure = 10.0", "", "", "loads[0]", "none of `pressure`, `traction` and `earth`"),
        (
            "pressure = 10.0",
            "pressure = 1.0\ntraction = [0.0, 1.0]",
            "[0.0, 1.0]",
            "loads[0].traction",
            "both `pressure` and `traction`",
        ),
    ] {
        let error = error_of(piece, replacement);
        assert_eq!(error.key(), key);
        let message = error.to_string();
        assert!(message.contains(words), "no `{words}` in\n{message}");
        if marked.is_empty() {
            assert!(error.line().is_some() && error.column() == Some(1), "{message}");
        } else {
            let place = place_of(piece, replacement, marked);
            assert_eq!((error.line(), error.column()), (Some(place.0), Some(place.1)), "{message}");
        }
    }
}

#[test]
fn keys_missing_at_the_top() {
    for (piece, words) in [
        ("thickness = 0.5\n", "`thickness` is missing"),
        ("plane = \"strain\"\n", "`plane` is missing"),
        ("title = \"Two walls of rubble\"\n", "missing field `title`"),
    ] {
        let message = error_of(piece, "").to_string();
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn scenes_without_blocks_or_supports() {
    let nothing = Scene::new("nothing", Units::SI).thickness(1.0);
    assert!(matches!(nothing.check().unwrap_err().kind(), SceneErrorKind::Empty));
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let scene = Scene::new("floating", Units::SI)
        .thickness(1.0)
        .material("stone", Material::rigid())
        .block(Block::new("block", "stone", corners));
    let error = Model::from_scene(&scene).unwrap_err();
    assert!(matches!(error.kind(), SceneErrorKind::NoSupport), "{error}");
}

#[test]
fn a_scene_built_in_rust_tells_the_key_instead_of_the_line() {
    let brick = Brick { length: f64::NAN, height: 0.1 };
    let scene = Scene::new("built", Units::SI)
        .thickness(1.0)
        .material("stone", Material::rigid())
        .joint("bed", Joint::mu(0.5))
        .wall(Wall::running_bond("wall", "stone", brick, 1.0, 2))
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
        .load(Load::traction("wind", [0.0, 0.0], [0.0, 1.0], [1.0, 0.0]));
    let error = scene.check().unwrap_err();
    assert_eq!((error.line(), error.column(), error.file()), (None, None, None));
    assert_eq!(error.key(), "walls[0].brick.length");
    assert!(error.to_string().starts_with("walls[0].brick.length: NaN is not allowed"), "{error}");
}

#[test]
fn a_scene_changed_after_reading_tells_no_wrong_line() {
    let mut scene = Scene::from_toml(GOOD).unwrap();
    scene.walls.remove(0);
    scene.walls[0].courses = Courses::List(Vec::new());
    let error = scene.check().unwrap_err();
    assert_eq!((error.key().as_str(), error.line()), ("walls[0].courses", None));
}
