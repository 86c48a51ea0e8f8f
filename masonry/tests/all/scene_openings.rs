//! Bonds and openings: where the bricks lie, and what is refused.

use masonry::Model;
use masonry::scene::bond::{JointThickness, PlacedBrick, bricks, bricks_in_mortar};
use masonry::scene::{Bond, Brick, Opening, Scene, Wall};

const BRICK: Brick = Brick { length: 0.4, height: 0.2 };

fn wall(bricks: f64, courses: u32) -> Wall {
    Wall::running_bond("wall", "stone", BRICK, bricks * BRICK.length, courses)
}

fn opening(x: f64, width: f64, course: u32, courses: u32) -> Opening {
    Opening { x, width, course, courses, bearing: None, lintel: None }
}

/// Lengths of the bricks of a course, in bricks.
fn lengths(wall: &Wall, course: usize) -> Vec<f64> {
    let of_course = bricks(wall).into_iter().filter(|brick| brick.course == course);
    of_course.map(|brick| (brick.high[0] - brick.low[0]) / BRICK.length).collect()
}

#[track_caller]
fn assert_lengths(wall: &Wall, course: usize, expected: &[f64]) {
    let found = lengths(wall, course);
    let same = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(same && found.len() == expected.len(), "course {course}: {found:?}");
}

#[test]
fn stack_bond_has_one_course() {
    let stack = wall(2.5, 2).bond(Bond::Stack);
    assert_lengths(&stack, 1, &[1.0, 1.0, 0.5]);
    assert_lengths(&stack, 2, &[1.0, 1.0, 0.5]);
}

/// The closers lie beside the corner headers, so that head joints never lie above each other.
/// Every header lies on the middle of a stretcher: Flemish bond, as the drawings of any textbook on brickwork have it.
#[test]
fn flemish_bond_has_headers_on_the_middle_of_stretchers() {
    let flemish = wall(4.0, 2).bond(Bond::Flemish);
    assert_lengths(&flemish, 1, &[1.0, 0.5, 1.0, 0.5, 1.0]);
    assert_lengths(&flemish, 2, &[0.5, 0.25, 1.0, 0.5, 1.0, 0.25, 0.5]);
    let middles = |course: usize, fraction: f64| -> Vec<f64> {
        let laid = bricks(&flemish);
        let of =
            laid.iter().filter(|it| it.course == course && (it.fraction - fraction).abs() < 1e-9);
        of.map(|it| 0.5 * (it.low[0] + it.high[0])).collect()
    };
    // The headers at the ends stand over the ends of stretchers.
    assert_eq!(middles(2, 0.5)[1..2], middles(1, 1.0)[1..2]);
    assert_eq!(middles(1, 0.5), middles(2, 1.0));
    assert_lengths(&wall(1.0, 2).bond(Bond::Flemish), 2, &[0.5, 0.25, 0.25]);
    assert_lengths(&wall(2.5, 2).bond(Bond::Flemish), 2, &[0.5, 0.25, 1.0, 0.25, 0.5]);
}

#[test]
fn english_bond_has_stretchers_headers_and_closers() {
    let english = wall(3.0, 2).bond(Bond::English);
    assert_lengths(&english, 1, &[1.0, 1.0, 1.0]);
    assert_lengths(&english, 2, &[0.5, 0.25, 0.5, 0.5, 0.5, 0.25, 0.5]);
    assert_lengths(&wall(2.5, 2).bond(Bond::English), 2, &[0.5, 0.25, 0.5, 0.5, 0.25, 0.5]);
    assert_lengths(&wall(0.5, 2).bond(Bond::English), 2, &[0.5]);
    for bond in [Bond::Running, Bond::English, Bond::Flemish] {
        let laid = bricks(&wall(4.0, 2).bond(bond));
        let ends = |course: usize| {
            let inner =
                laid.iter().filter(move |brick| brick.course == course && brick.high[0] < 1.5);
            inner.map(|brick| brick.high[0]).collect::<Vec<_>>()
        };
        let above = ends(1).iter().all(|x| ends(2).iter().all(|y| (x - y).abs() > 0.05));
        assert!(above, "{bond:?}");
    }
}

/// A window of one brick in the third and fourth of six courses, with half a brick of bearing: what the courses of a list
/// would be.
#[test]
fn an_opening_is_cut_and_has_a_lintel() {
    let window = wall(4.0, 6).opening(opening(0.6, 0.4, 3, 2));
    let list = Wall::from_courses(
        "wall",
        "stone",
        BRICK,
        vec![
            vec![1.0; 4],
            vec![0.5, 1.0, 1.0, 1.0, 0.5],
            vec![1.0, 0.5, -1.0, 0.5, 1.0],
            vec![0.5, 1.0, -1.0, 1.0, 0.5],
            vec![1.0, 2.0, 1.0],
            vec![0.5, 1.0, 1.0, 1.0, 0.5],
        ],
    );
    let places = |wall: &Wall| bricks(wall).iter().map(PlacedBrick::corners).collect::<Vec<_>>();
    assert_eq!(places(&window), places(&list));
    let lintels = bricks(&window).iter().filter(|it| it.lintel == Some(0)).count();
    assert_eq!(lintels, 1);
}

/// The jambs of a door 0.96 wide at 0.46 cut whole bricks at 0.15 and 0.45, and half ones at 0.65 and 0.95 of their lengths:
/// the shortest are laid as one with their neighbours.
#[test]
fn short_pieces_are_laid_as_one_with_their_neighbours() {
    let door = wall(4.0, 3).opening(opening(0.46, 0.96, 1, 2));
    assert_lengths(&door, 1, &[1.15, 0.45]);
    assert_lengths(&door, 2, &[0.5, 0.65, 0.45]);
    // The lintel of 0.96 + 0.4, and what is left of whole bricks beside it.
    assert_lengths(&door, 3, &[0.65, 3.4]);
}

/// With mortar the opening is as wide as it says, and head joints stand between lintel and bricks.
#[test]
fn openings_keep_their_width_in_mortar() {
    let joints = JointThickness { bed: 0.01, head: 0.02 };
    let wall = Wall::running_bond("wall", "stone", BRICK, 4.0 * 0.42 - 0.02, 4)
        .opening(opening(0.5, 0.63, 2, 1));
    let laid = bricks_in_mortar(&wall, joints);
    let row = |course: usize| -> Vec<&PlacedBrick> {
        laid.iter().filter(|it| it.course == course).collect()
    };
    let gap = row(2).windows(2).map(|pair| pair[1].low[0] - pair[0].high[0]).fold(0.0, f64::max);
    assert!((gap - 0.63).abs() < 1e-12, "{gap}");
    for pair in row(3).windows(2) {
        assert!((pair[1].low[0] - pair[0].high[0] - 0.02).abs() < 1e-12);
    }
    let lintel = row(3).into_iter().find(|brick| (brick.low[0] - 0.3).abs() < 1e-12);
    assert!(lintel.is_some_and(|it| (it.high[0] - 1.33).abs() < 1e-12), "{laid:?}");
}

fn scene(wall: &str) -> String {
    format!(
        "title = \"Wall\"\nthickness = 0.3\nunits = {{ length = \"m\", force = \"kN\" }}\nmaterials.stone = {{}}\n\
         joints = {{ bed.mu = 0.6, head.mu = 0.6 }}\n[[supports]]\nname = \"floor\"\nfrom = [0.0, 0.0]\nto = [4.0, 0.0]\n\
         joint = \"bed\"\n[[walls]]\nname = \"wall\"\nmaterial = \"stone\"\norigin = [0.0, 0.0]\n\
         brick = {{ length = 0.4, height = 0.2 }}\n{wall}"
    )
}

#[test]
fn a_wall_with_a_door_and_windows_is_a_model() {
    let wall = "width = 4.0\ncourses = 10\nbond = \"english\"\nopenings = [{ x = 0.6, width = 0.8, courses = 6 }, \
                { x = 2.2, width = 0.8, course = 4, courses = 3, bearing = 0.3 }]";
    let read = Scene::from_toml(&scene(wall)).unwrap();
    assert_eq!(Scene::from_toml(&read.to_toml().unwrap()).unwrap(), read);
    let model = Model::from_scene(&read).unwrap();
    let area: f64 = model.blocks.iter().map(|it| masonry::geometry::area(&it.corners)).sum();
    assert!((area - (4.0 * 2.0 - 0.8 * 1.2 - 0.8 * 0.6)).abs() < 1e-9, "{area}");
}

#[test]
fn impossible_openings_name_the_key_the_value_and_what_would_fit() {
    let cases = [
        (
            "{ x = 1.0, width = 3.5, courses = 2 }",
            "openings[0].width: an opening of 3.5 at x = 1 reaches beyond the wall, which is 4 wide: give a width of at most 3",
        ),
        (
            "{ x = 1.0, width = 0.8, course = 8, courses = 4 }",
            "openings[0].courses: an opening of 4 courses from course 8 on reaches beyond the 10 of the wall: give at most 3",
        ),
        (
            "{ x = 0.1, width = 0.8, courses = 4 }",
            "needs 0.2 of wall on its left to rest on, and has 0.1",
        ),
        (
            "{ x = 1.0, width = 0.8, courses = 4, bearing = 2.5 }",
            "needs 2.5 of wall on its left to rest on, and has 1",
        ),
        (
            "{ x = 1.0, width = 0.8, courses = 4 }, { x = 1.9, width = 0.8, courses = 3 }",
            "runs into openings[0] in course 4",
        ),
        (
            "{ x = 1.0, width = 0.8, courses = 4 }, { x = 1.5, width = 0.8, courses = 3 }",
            "runs into openings[0] in course 1",
        ),
        (
            "{ x = 1.0, width = 0.8, courses = 4 }, { x = 1.2, width = 0.3, course = 4, courses = 3 }",
            "in course 4",
        ),
        ("{ x = 1.0, width = 0.8, course = 0, courses = 4 }", "courses are counted from 1"),
        ("{ x = 1.0, width = 0.0, courses = 4 }", "openings[0].width: 0 is not allowed"),
        ("{ x = -1.0, width = 1.0, courses = 4 }", "openings[0].x: -1 is not allowed"),
        ("{ x = 1.0, width = 1.0, courses = 4, height = 2.0 }", "unknown field `height`"),
    ];
    for (openings, message) in cases {
        let text = scene(&format!("width = 4.0\ncourses = 10\nopenings = [{openings}]"));
        let error = Scene::from_toml(&text).unwrap_err().to_string();
        assert!(error.contains(message) && error.contains("line "), "{error}");
    }
    for key in ["bond = \"stack\"", "openings = [{ x = 1.0, width = 1.0, courses = 1 }]"] {
        let error = Scene::from_toml(&scene(&format!("courses = [[1, 1]]\n{key}"))).unwrap_err();
        assert!(error.to_string().contains("whose `courses` is a number"), "{error}");
    }
}
