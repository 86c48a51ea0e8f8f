//! Scenes with one mistake each, and the whole message that the program prints for it: `broken_scenes.txt`.
//!
//! Run with `UPDATE_MESSAGES=1` after a message was changed on purpose, and read what has become of the file.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

const TOP: &str = "title = \"Broken\"\nthickness = 0.5\ngravity = [0.0, -9.81]\n\
                   units = { length = \"m\", force = \"kN\" }\n\
                   materials.stone.density = 2000.0\njoints = { bed.mu = 0.6, head.mu = 0.6 }\n";
const FLOOR: &str =
    "[[supports]]\nname = \"floor\"\nfrom = [-1.0, 0.0]\nto = [9.0, 0.0]\njoint = \"bed\"\n";

/// A wall of these keys on a floor.
fn wall(keys: &str) -> String {
    format!(
        "{TOP}{FLOOR}[[walls]]\nname = \"wall\"\nmaterial = \"stone\"\norigin = [0.0, 0.0]\n\
         brick = {{ length = 0.4, height = 0.2 }}\n{keys}\n"
    )
}

/// A wall of ten courses with these openings.
fn openings(list: &str) -> String {
    wall(&format!("width = 4.0\ncourses = 10\nopenings = [{list}]"))
}

/// An arch of these keys on its own supports.
fn arch(keys: &str) -> String {
    format!(
        "{TOP}[[arches]]\nname = \"arch\"\nmaterial = \"stone\"\njoint = \"bed\"\nspringing = \"bed\"\n{keys}\n"
    )
}

/// A ring of eight voussoirs, half a metre thick.
fn ring(shape: &str) -> String {
    arch(&format!("thickness = 0.5\nvoussoirs = 8\n{shape}"))
}

/// An arch between these joints.
fn lines(list: &str) -> String {
    arch(&format!("shape = \"joints\"\nlines = [{list}]"))
}

/// A block of these corners on a floor.
fn block(corners: &str, more: &str) -> String {
    format!(
        "{TOP}{FLOOR}[[blocks]]\nname = \"block\"\nmaterial = \"stone\"\ncorners = {corners}\n{more}\n"
    )
}

const SQUARE: &str = "[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]";

/// What is wrong, and the scene.
type Broken = Vec<(&'static str, String)>;

fn scenes() -> Broken {
    [walls(), of_openings(), arches(), voussoirs(), blocks(), texts()].concat()
}

/// Bonds and courses.
fn walls() -> Broken {
    vec![
        ("a wall that is turned by no number", wall("width = 1.0\ncourses = 2\nturn_deg = inf")),
        ("a wall without a width", wall("courses = 3")),
        ("a wall without courses", wall("width = 2.0\ncourses = 0")),
        ("a wall of negative width", wall("width = -2.0\ncourses = 3")),
        ("a bond that there is not", wall("width = 2.0\ncourses = 3\nbond = \"dutch\"")),
        (
            "a bond of courses that are a list",
            wall("courses = [[1, 1], [0.5, 1, 0.5]]\nbond = \"english\""),
        ),
        ("a course without bricks", wall("courses = [[1, 1], []]")),
        ("a brick without length", wall("courses = [[1, 1], [0.5, 0.0, 0.5]]")),
        (
            "bricks in the place of others",
            wall("width = 2.0\ncourses = 3")
                + &wall("width = 2.0\ncourses = 3")[(TOP.len() + FLOOR.len())..]
                    .replace("name = \"wall\"", "name = \"second\""),
        ),
    ]
}

/// Openings and lintels.
fn of_openings() -> Broken {
    vec![
        ("an opening wider than the wall", openings("{ x = 0.4, width = 5.0, courses = 4 }")),
        (
            "an opening that reaches beyond the wall",
            openings("{ x = 3.0, width = 1.2, courses = 4 }"),
        ),
        ("an opening before the wall", openings("{ x = -0.4, width = 0.8, courses = 4 }")),
        (
            "an opening higher than the wall",
            openings("{ x = 1.0, width = 0.8, course = 8, courses = 4 }"),
        ),
        ("an opening without a width", openings("{ x = 1.0, width = 0.0, courses = 4 }")),
        ("an opening without courses", openings("{ x = 1.0, width = 0.8, courses = 0 }")),
        (
            "an opening below the wall",
            openings("{ x = 1.0, width = 0.8, course = 0, courses = 4 }"),
        ),
        (
            "a lintel that rests on nothing",
            openings("{ x = 1.0, width = 0.8, courses = 4, bearing = 0.0 }"),
        ),
        (
            "a lintel of an unknown material",
            openings("{ x = 1.0, width = 0.8, courses = 4, lintel = { material = \"oak\" } }"),
        ),
        (
            "a lintel with joints of an unknown class",
            openings("{ x = 1.0, width = 0.8, courses = 4, lintel = { joint = \"bearing\" } }"),
        ),
        (
            "a flat arch without a skew",
            openings("{ x = 1.0, width = 0.8, courses = 4, lintel = { voussoirs = 7 } }"),
        ),
        (
            "a flat arch that leans too far",
            openings(
                "{ x = 1.0, width = 0.8, courses = 4, lintel = { voussoirs = 7, skew_deg = -85.0 } }",
            ),
        ),
        (
            "a flat arch with a bearing",
            openings(
                "{ x = 1.0, width = 0.8, courses = 4, bearing = 0.2, lintel = { voussoirs = 7, skew_deg = 9 } }",
            ),
        ),
        (
            "a flat arch higher than its wall",
            openings(
                "{ x = 1.0, width = 0.8, courses = 8, lintel = { voussoirs = 7, skew_deg = 10.0, courses = 3 } }",
            ),
        ),
        (
            "a lintel that has nothing to rest on at the left end",
            openings("{ x = 0.0, width = 0.8, courses = 4 }"),
        ),
        (
            "a lintel that has too little to rest on at the right end",
            openings("{ x = 3.1, width = 0.8, courses = 4 }"),
        ),
        (
            "a lintel that rests over another opening",
            openings(
                "{ x = 0.8, width = 0.8, courses = 4 }, { x = 1.7, width = 0.8, courses = 5 }",
            ),
        ),
        (
            "openings that run into each other",
            openings(
                "{ x = 1.0, width = 0.8, courses = 4 }, { x = 1.6, width = 0.8, courses = 3 }",
            ),
        ),
        (
            "an opening that cuts the lintel of another",
            openings(
                "{ x = 1.0, width = 0.8, courses = 4 }, { x = 1.2, width = 0.4, course = 5, courses = 2 }",
            ),
        ),
    ]
}

/// Shapes of arches.
fn arches() -> Broken {
    vec![
        ("a rise larger than the radius", ring("shape = \"segmental\"\nspan = 4.0\nrise = 3.0")),
        ("an arc without a rise", ring("shape = \"segmental\"\nspan = 4.0")),
        (
            "an arc with two rises",
            ring("shape = \"segmental\"\nspan = 4.0\nrise = 1.0\nembrace_deg = 90.0"),
        ),
        (
            "an arc of more than half a circle",
            ring("shape = \"segmental\"\nspan = 4.0\nembrace_deg = 200.0"),
        ),
        ("an arc of no angle", ring("shape = \"segmental\"\nspan = 4.0\nembrace_deg = 0.0")),
        ("an arc that does not rise", ring("shape = \"segmental\"\nspan = 4.0\nrise = 0.0")),
        ("an arch of no rings", ring("shape = \"segmental\"\nspan = 4.0\nrise = 1.0\nrings = 0")),
        (
            "a joint between the rings of one ring",
            ring("shape = \"segmental\"\nspan = 4.0\nrise = 1.0\nring_joint = \"bed\""),
        ),
        ("an arch without a span", ring("shape = \"semicircular\"")),
        ("an arch of negative span", ring("shape = \"semicircular\"\nspan = -4.0")),
        (
            "a semicircular arch with a rise",
            ring("shape = \"semicircular\"\nspan = 4.0\nrise = 2.0"),
        ),
        ("a pointed arch without a point", ring("shape = \"pointed\"\nspan = 4.0\nrise = 1.5")),
        (
            "a pointed arch with a keystone",
            arch("thickness = 0.5\nvoussoirs = 9\nshape = \"pointed\"\nspan = 4.0\nrise = 3.0"),
        ),
        ("a flat arch that leans too far", ring("shape = \"flat\"\nspan = 4.0\nskew_deg = 85.0")),
        (
            "a flat arch that does not lean as it should",
            ring("shape = \"flat\"\nspan = 4.0\nskew_deg = -5.0"),
        ),
    ]
}

/// Voussoirs, joints and piers.
fn voussoirs() -> Broken {
    let semicircular = "shape = \"semicircular\"\nspan = 4.0";
    let on_piers = |piers: &str| ring(&format!("{semicircular}\npiers = {{ {piers} }}"));
    let upright = "[[0.0, 0.0], [0.0, 1.0]]";
    vec![
        (
            "an arch without voussoirs",
            arch(&format!("thickness = 0.5\nvoussoirs = 0\n{semicircular}")),
        ),
        (
            "half a circle of one voussoir",
            arch(&format!("thickness = 0.5\nvoussoirs = 1\n{semicircular}")),
        ),
        (
            "an arch that does not say how many voussoirs it has",
            arch(&format!("thickness = 0.5\n{semicircular}")),
        ),
        (
            "an arch without thickness",
            arch(&format!("thickness = 0.0\nvoussoirs = 8\n{semicircular}")),
        ),
        ("an arch of a shape that there is not", ring("shape = \"horseshoe\"\nspan = 4.0")),
        (
            "an arch on a class of joints that there is not",
            ring(semicircular).replace("springing = \"bed\"", "springing = \"abutment\""),
        ),
        (
            "an elastic arch without a mesh",
            ring(semicircular)
                .replace("thickness = 0.5\ngravity", "plane = \"stress\"\nthickness = 0.5\ngravity")
                .replace(
                    "materials.stone.density = 2000.0",
                    "materials.stone = { E = 1e6, nu = 0.2 }",
                ),
        ),
        ("an arch of one joint", lines(upright)),
        ("an arch of no joints", lines("")),
        ("joints that cross", lines(&format!("{upright}, [[1.0, 0.0], [-0.5, 1.0]]"))),
        ("joints from right to left", lines(&format!("[[1.0, 0.0], [1.0, 1.0]], {upright}"))),
        (
            "joints that begin at the extrados",
            lines("[[0.0, 1.0], [0.0, 0.0]], [[1.0, 1.0], [1.0, 0.0]]"),
        ),
        ("a joint without length", lines(&format!("{upright}, [[1.0, 0.5], [1.0, 0.5]]"))),
        (
            "lines of an arch with another shape",
            ring(&format!("{semicircular}\nlines = [{upright}]")),
        ),
        ("a pier narrower than the springing", on_piers("width = 0.4, height = 1.0, courses = 2")),
        ("a pier without height", on_piers("width = 1.0, height = 0.0, courses = 2")),
        ("a pier without courses", on_piers("width = 1.0, height = 1.0, courses = 0")),
        (
            "piers below joints that lean inwards",
            lines("[[0.0, 0.0], [0.5, 1.0]], [[2.0, 0.0], [1.5, 1.0]]")
                .replace("lines", "piers = { width = 1.0, height = 1.0, courses = 2 }\nlines"),
        ),
    ]
}

/// Single blocks, and names.
fn blocks() -> Broken {
    vec![
        ("corners clockwise", block("[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]", "")),
        (
            "a block whose edges cross",
            block("[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]", ""),
        ),
        (
            "a block in the air",
            block(
                SQUARE,
                &format!(
                    "[[blocks]]\nname = \"cloud\"\nmaterial = \"stone\"\ncorners = {}",
                    SQUARE.replace("1.0]", "4.0]").replace("0.0]", "3.0]")
                ),
            ),
        ),
        ("a load that grows and is not there", block(SQUARE, "[limit]\ngroup = \"wind\"")),
        (
            "friction given twice",
            block(SQUARE, "").replace("bed.mu = 0.6", "bed = { mu = 0.6, phi_deg = 30.0 }"),
        ),
    ]
}

/// Lines that are long, and texts and numbers that are no good to a terminal.
fn texts() -> Broken {
    let corners = "[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], ".repeat(1000);
    vec![
        ("a list on one long line", block(&format!("[{corners}\"corner\", {corners}]"), "")),
        ("a name that rings the bell", block(SQUARE, "").replace("\"block\"", "\"bl\\u0007ck\"")),
        ("a title that clears the screen", block(SQUARE, "").replace("Broken", "\\u001b[2J")),
        (
            "a number of three hundred digits",
            block(SQUARE, "").replace("bed.mu = 0.6", "bed.mu = -1e300"),
        ),
    ]
}

/// What the program prints for a scene.
fn message(directory: &Path, scene: &str) -> String {
    let path = directory.join("scene.toml");
    fs::write(&path, scene).unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_masonry")).arg("plan").arg(&path).output().unwrap();
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!((run.status.code(), run.stdout.len()), (Some(2), 0), "{scene}{text}");
    text.replace(&format!("{}/", directory.display()), "")
}

#[test]
fn every_broken_scene_has_its_message() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("broken_scenes");
    fs::create_dir_all(&directory).unwrap();
    let mut found = String::new();
    for (what, scene) in scenes() {
        let message = message(&directory, &scene);
        assert!(message.starts_with("error: scene.toml, line "), "{what}: {message}");
        let _ = writeln!(found, "# {what}\n{message}");
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/broken_scenes.txt");
    if std::env::var_os("UPDATE_MESSAGES").is_some() {
        fs::write(&path, &found).unwrap();
    }
    let expected = fs::read_to_string(&path).unwrap();
    for (found, expected) in found.split("\n# ").zip(expected.split("\n# ")) {
        assert_eq!(found, expected);
    }
    assert_eq!(found.len(), expected.len());
}
