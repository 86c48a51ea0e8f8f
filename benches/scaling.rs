//! Verdicts on walls that are hard to decide, and what they cost: friction at and near critical values, tilts near the
//! limit, open bases, settlements; rigid and elastic bricks.
//!
//! `cargo bench --bench scaling` prints a table of walls of about a thousand bricks; with `-- --write` it also puts it into
//! `docs/data/scaling.md`, and a summary into `docs/scaling.md`; `--courses 100` does the same for walls of ten thousand
//! bricks. `-- --sizes 10,32,100` prints how time and memory grow with the courses of a wall and the bricks in each, and writes the
//! same two files and a picture. `-- --steps 20,80` prints how far settlements in these numbers of steps differ, and `--write`
//! puts that into `docs/scaling.md`. Walls that a run leaves out keep the lines that they have there. `--mu 0.5,1`, `--bricks
//! rigid,2x1` and `--case settlement` choose a part. Bound to one core (`taskset -c 0`) all is on one thread.

mod common;
#[path = "common/machine.rs"]
mod machine;
#[path = "scaling/row.rs"]
mod row;
#[path = "scaling/sizes.rs"]
mod sizes;
#[path = "common/sparse.rs"]
mod sparse;
#[path = "scaling/steps.rs"]
mod steps;
#[path = "scaling/table.rs"]
mod table;
#[path = "scaling/walls.rs"]
mod walls;

use row::{HEAD, Row, yardstick};
use sizes::Sizes;
use table::Table;
use walls::{Case, Wall};

const FRICTION: &str = "0.3,0.5,0.6,0.7,0.9999,1,1.0001,1.3";
/// Elastic bricks have dry joints, or hard ones that do not give way.
const BRICKS: &str = "rigid,1x1,2x1,1x1 hard,2x1 hard";
/// Courses, and bricks in each.
const COURSES: &str = "32";
const CASES: [Case; 10] = [
    Case::Lean,
    Case::OpenBase,
    Case::Tilt(0.5),
    Case::Tilt(0.9),
    Case::Tilt(0.99),
    Case::Tilt(1.01),
    Case::Tilt(1.3),
    Case::Settlement(1),
    Case::Settlement(5),
    Case::Settlement(20),
];

fn main() {
    if !common::is_bench() {
        return;
    }
    if common::is_asked("--steps") {
        let computed = settlements();
        common::rewrite_if_asked("docs/scaling.md", "steps", |before| {
            steps::table(&computed, before)
        });
    } else if common::is_asked("--sizes") {
        let defaults = [&option("--sizes", sizes::SIZES)[..], sizes::FRICTION, sizes::BRICKS];
        let computed = rows(defaults, &sizes::CASES);
        let sizes = Sizes::new(&computed, "");
        println!("\n{}\n{}", sizes.exponents(), sizes.whole());
        common::rewrite_if_asked("docs/data/scaling.md", "sizes", |before| {
            let sizes = Sizes::new(&computed, before);
            common::write_if_asked("docs/scaling.md", "sizes", &sizes.exponents());
            if let Some(picture) = sizes.drawn() {
                let file = common::root().join("docs/pictures/scaling.svg");
                std::fs::write(file, picture).expect("the file can be written");
            }
            sizes.whole() + "\n" + &machine::machine()
        });
    } else {
        let courses = option("--courses", COURSES);
        let block = if courses == COURSES { "scaling" } else { "large" };
        let computed = rows([&courses, FRICTION, BRICKS], &CASES);
        let mut summary = String::new();
        common::rewrite_if_asked("docs/data/scaling.md", block, |before| {
            let cases = CASES.map(|case| case.to_string());
            let table = Table::new(&computed, before, (&cases, BRICKS));
            summary = table.summary();
            table.whole() + "\n" + &machine::machine()
        });
        common::write_if_asked("docs/scaling.md", block, &summary);
    }
}

/// Rows of settlements in the numbers of steps that are asked for; those of each wall are printed when they are there.
fn settlements() -> String {
    let counts: Vec<u32> = option("--steps", "20,80")
        .split(',')
        .map(|it| it.parse().expect("a number of steps"))
        .collect();
    let settled = [("--courses", "10,20,32"), ("--mu", "0.3,0.6,1"), ("--bricks", "rigid,1x1,2x1")];
    let [courses, friction, bricks] = settled.map(|(name, default)| option(name, default));
    let mut table = String::new();
    for courses in courses.split(',') {
        for mu in friction.split(',') {
            for bricks in bricks.split(',') {
                let courses = courses.parse().expect("a number of courses");
                let wall = wall(courses, mu.parse().expect("a coefficient of friction"), bricks);
                let rows = steps::rows(&wall, bricks, &counts);
                print!("{rows}");
                table += &rows;
            }
        }
    }
    table
}

/// Rows of walls of these courses, friction and bricks where options choose no others; each is printed when it is there.
fn rows([courses, friction, bricks]: [&str; 3], all: &[Case]) -> Vec<Row> {
    let (friction, bricks) = (option("--mu", friction), option("--bricks", bricks));
    let case = option("--case", "");
    let cases = || all.iter().copied().filter(|it| it.to_string().contains(&case));
    let is_tilted = cases().any(|it| matches!(it, Case::Tilt(_)));
    let mut rows = Vec::new();
    print!("{HEAD}");
    for courses in courses.split(',') {
        let courses = courses.parse().expect("a number of courses");
        for mu in friction.split(',') {
            let mu = mu.parse().expect("a coefficient of friction");
            let rigid = Wall { courses, mu, mesh: None, joints: None };
            let limit = if is_tilted { rigid.largest_tilt() } else { 0.0 };
            for bricks in bricks.split(',') {
                let wall = wall(courses, mu, bricks);
                let yardstick = yardstick(&wall);
                for case in cases() {
                    let row = Row::of(&wall, bricks, (case, limit), yardstick);
                    println!("{row}");
                    rows.push(row);
                }
            }
        }
    }
    rows
}

/// What follows an option of the command, unless that is another option, or nothing.
fn option(name: &str, default: &str) -> String {
    let given = std::env::args().skip_while(|it| it != name).nth(1);
    given.filter(|it| !it.starts_with("--")).unwrap_or_else(|| default.to_owned())
}

/// A wall of bricks with a name of [`BRICKS`].
fn wall(courses: u32, mu: f64, bricks: &str) -> Wall {
    let (mesh, is_hard) = bricks.strip_suffix(" hard").map_or((bricks, false), |it| (it, true));
    let mesh = mesh
        .split_once('x')
        .map(|(nx, ny)| [nx, ny].map(|count| count.parse().expect("elements of a brick")));
    let joints = if is_hard || mesh.is_none() { None } else { walls::DRY };
    Wall { courses, mu, mesh, joints }
}
