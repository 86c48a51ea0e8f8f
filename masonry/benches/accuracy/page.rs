//! `docs/accuracy.md` with its picture, the further tables in `docs/data/`, and a section of `docs/performance.md`.

use std::fmt::Write as _;
use std::path::Path;

use lcp::Status;
use masonry::analysis::study::{End, Mesh, MeshErrors, Record, Study};
use masonry::scene::Route;
use masonry_report::study;

use super::tables::{self, seconds};
use super::{Panel, TOLERANCES, common, data, machine, pictures, sentences, springs};

/// The picture on the page is of the first panel.
const PICTURE: &str = "docs/pictures/accuracy_panel_rectangular_routes.svg";
/// Where the others are drawn.
const FURTHER: &str = "target/accuracy";

const MEANINGS: &str = "
## What the words mean

* **Tolerance**: the largest residual of a solution with status `Solved`.
* **Algebraic error**: the error of the solver: the distance from a reference solution on the same mesh. It is the largest of three distances, those of contact
  forces, stresses and strain energy, each relative to its largest value. The reference is refined in double-double arithmetic (about 31 digits), and its
  inequalities are checked in it.
* **Error of the mesh**: the distance between the references on this mesh and on the finest one. No solver can reduce it. The true error is larger, since the
  finest mesh has an error too. If the error is of order `p` in the element size, the true one is `1 / (1 - 2^-p)` times the given value for a mesh half as fine
  as the finest, and `1 / (1 - 4^-p)` times for one a quarter as fine: 2 and 1.3 times for `p = 1`, 3.4 and 2 times for `p = 1/2`.
* **Extrapolated** errors take this into account. They are relative to the limit of the three finest meshes by Richardson's rule,
  `v_3 + (v_3 - v_2)^2 / ((v_2 - v_1) - (v_3 - v_2))`. Their cells are empty if the differences do not decrease at a rate between the orders 0.5 and 2.5; only
  finer meshes would help there. A single value may be near that of the finest mesh by accident, so sentences and pictures use the largest of the three.
* **Time** is that of a whole solve, from the scene to the checked solution. If a route did not solve the problem, its status (`TimeLimit`, `IterationLimit`,
  `AlmostSolved`) replaces the error. A time may exceed the limit, since a factorisation or a program is not interrupted. `Skipped` was not tried; the further
  tables say why.

## Further numbers and pictures

[Further tables](data/accuracy.md) have the other meshes, the references, the cost of the last digits and the effect of soft springs. `cargo bench --bench accuracy`
measures all this; with `-- --write` it writes this page and the tables, and draws the other pictures into `target/accuracy/`. `masonry study SCENE --out DIR`
makes such a [study](reference/study.md) of any scene.
";

const TABLES: &str = "\
# Accuracy: further tables

The tables behind [the page on accuracy](../accuracy.md), which says what the words mean. Written by `cargo bench --bench accuracy -- --write`.
";

const HOW_TO_READ: &str = "
## How to read the tables

* **References.** The margin is the smallest margin of the inequalities of the contact law, relative to the largest force or displacement. Except for rounding it is not negative for a solution; if it is small, another state of a contact is near. Certain digits are those not affected by rounding errors of the data; redundant contacts, whose gaps contradict each other in the last digits, reduce their number. The distances, in the forces on the nodes, are those of the route's solution in `f64` from its refinement, and of the refined solution of another route from that refinement.
* **The last digits.** A route in `f64` must find the states of all contacts, and includes its own refinement. If only the states are known, one factorisation is needed, and solves with it. The error of one solve is large because its factors have springs in place of rigid contacts, 1e8 times as stiff as the bodies; without them redundant contacts would make the matrix singular. Further solves remove the effect of the springs: in `f64` down to its rounding errors, and with compensated refinement (residuals in double-double arithmetic) further. Redundant contacts need more solves: if their gaps contradict each other in the last digits of the data, the residual stops decreasing, is attributed to the data, and the solves start again, finally with softer springs. Errors are distances from the reference in the forces on the nodes; they are known only to its certain digits.
* **Soft springs** on all displacements, an option of quadratic programs, change the solution until they are re-centred. The columns give the share of the load that they carry before that, and their bias, the change of the displacements. Both are measured by additional solves with springs at rest in the initial position; they are missing if no time is left for these solves, or if they fail.
";

/// Writes all files.
pub(crate) fn write(root: &Path, panels: &[Panel], walls: &[Study]) {
    let machine = machine::machine();
    save(root, "docs/accuracy.md", &page(panels, walls, &machine));
    save(root, "docs/data/accuracy.md", &further(panels, walls, &machine));
    let shown = study::accuracy(&panels[0].study).expect("something was solved");
    save(root, PICTURE, &shown);
    for panel in panels {
        let pictures = [
            ("routes", study::accuracy(&panel.study)),
            ("mesh", pictures::mesh(&panel.study)),
            ("digits", pictures::digits(panel)),
            ("springs", pictures::springs(panel)),
        ];
        for (what, picture) in pictures {
            let file = format!("{FURTHER}/{}_{what}.svg", panel.name);
            match picture {
                Some(picture) => save(root, &file, &picture),
                // That of an earlier run, if there is one, is no longer true.
                None => drop(std::fs::remove_file(root.join(file))),
            }
        }
        for (file, table) in data::files(panel) {
            save(root, &format!("docs/data/{file}"), &table);
        }
    }
    let title = "Square walls, one element a brick: time and size";
    let sizes = pictures::sizes(title, walls, TOLERANCES).expect("something was solved");
    save(root, &format!("{FURTHER}/sizes.svg"), &sizes);
    common::write_if_asked(
        "docs/performance.md",
        "accuracy",
        &short(&panels[0].study, walls, &machine),
    );
}

/// A picture, three sentences, the tables that most readers want, and what they mean.
fn page(panels: &[Panel], walls: &[Study], machine: &str) -> String {
    let first = &panels[0].study;
    let mesh = first.meshes.first().map_or("", |mesh| &mesh.name);
    let picture = PICTURE.trim_start_matches("docs/");
    let mut text = format!(
        "# What accuracy costs\n\n\
         ![Algebraic error against time, one line for each route]({picture})\n\n\
         *{}, on {mesh}: algebraic error against time, one line for each route and one marker for each tolerance. The lower left is best.*\n\n",
        first.title
    );
    let sentences = [
        sentences::of_tolerance(panels),
        sentences::of_mesh(panels),
        sentences::of_time(panels, walls),
    ];
    text += &list(&sentences);
    let _ = write!(text, "\n{machine}");
    for panel in panels {
        let study = &panel.study;
        let _ = writeln!(text, "\n## {}\n", study.title);
        if let Some(mesh) = study.meshes.first() {
            text += &by_tolerance(study, mesh);
        }
        text += "Error of the mesh:\n\n";
        text += &tables::meshes(panel);
        text += &tables::accident(study);
    }
    text += &of_walls(walls);
    text + MEANINGS
}

/// The tables that a reader of the page may want to see.
fn further(panels: &[Panel], walls: &[Study], machine: &str) -> String {
    let mut text = format!("{TABLES}\n{machine}");
    for panel in panels {
        let study = &panel.study;
        let _ = writeln!(text, "\n## {}\n", study.title);
        text += &list(&study::summary(study));
        let limit = in_the_limit(panel);
        if !limit.is_empty() {
            text += &list(&[limit]);
        }
        text += "\n";
        let mut meshes: Vec<_> = study.meshes.iter().skip(1).collect();
        meshes.sort_by_key(|mesh| mesh.factor);
        for mesh in meshes {
            text += &by_tolerance(study, mesh);
        }
        text += &tables::not_tried(study);
        text += "The references, refined in double-double arithmetic:\n\n";
        text += &tables::references(study);
        text += "\nCost of the last digits, compared with a whole solve in `f64`:\n\n";
        text += &tables::refinings(panel);
        let _ = writeln!(text, "\nSoft springs, with a tolerance of {:e}:\n", springs::TOLERANCE);
        text += &tables::springs(panel);
        let files = data::files(panel);
        let files: Vec<String> =
            files.iter().map(|(file, _)| format!("[{file}]({file})")).collect();
        let _ = writeln!(text, "All numbers: {}.", files.join(", "));
    }
    text += "\n## Size\n\n";
    for wall in walls {
        let skipped = tables::not_tried(wall);
        if !skipped.is_empty() {
            let _ = write!(text, "{}. {skipped}", wall.title);
        }
    }
    text.trim_end().to_owned() + "\n" + HOW_TO_READ
}

fn by_tolerance(study: &Study, mesh: &Mesh) -> String {
    let heading = format!(
        "**{0} x {0} elements a square, {1} contact points**: time, and algebraic error if solved\n\n",
        mesh.factor, mesh.contact_points
    );
    heading + &tables::by_tolerance(study, mesh.factor)
}

/// What the error of the scene's own mesh comes to when the finest is not taken for exact.
fn in_the_limit(panel: &Panel) -> String {
    let error = panel.study.meshes.first().and_then(|mesh| mesh.errors?.worst());
    let limit =
        panel.extrapolated.first().and_then(MeshErrors::worst).filter(|it| Some(*it) > error);
    limit.map_or_else(String::new, |it| {
        format!(
            "Relative to the extrapolated limit of the meshes the error of this mesh is {it:.1e}."
        )
    })
}

fn save(root: &Path, file: &str, text: &str) {
    let path = root.join(file);
    std::fs::create_dir_all(path.parent().expect("files are in folders"))
        .expect("a folder can be made");
    std::fs::write(path, text).expect("a file can be written");
}

fn list(sentences: &[String]) -> String {
    sentences.iter().fold(String::new(), |text, sentence| text + "* " + sentence + "\n")
}

fn of_walls(walls: &[Study]) -> String {
    let [loose, tight] = TOLERANCES;
    let mut text = format!(
        "\n## Size\n\nSquare walls in running bond on a full floor, one element a brick, `mu = 0.6`, under their weight and a load on top inclined by a tenth: time to {loose:e} and to {tight:e}, and the algebraic error of both.\n\n"
    );
    let routes = walls.first().map(Study::routes).unwrap_or_default();
    let names: Vec<&str> = routes.iter().map(|route| route.name()).collect();
    let _ = writeln!(text, "| wall | bricks | contact points | {} |", names.join(" | "));
    let _ = writeln!(text, "|---|--:|--:|{}", "---|".repeat(routes.len()));
    for wall in walls {
        let points = wall.meshes.first().map_or(0, |mesh| mesh.contact_points);
        let _ = write!(text, "| {} | {} | {points} |", wall.title, bricks(wall));
        for route in &routes {
            let records = wall.on_first_mesh().filter(|it| it.route == *route);
            let cells: Vec<String> = records.map(tables::cell).collect();
            let _ = write!(text, " {} |", cells.join("; "));
        }
        text += "\n";
    }
    text
}

/// The table of `docs/performance.md`: one line a route.
fn short(panel: &Study, walls: &[Study], machine: &str) -> String {
    let shown: Vec<&Study> = walls.iter().skip(1).step_by(2).collect();
    let mut text = format!(
        "| route | rectangular panel, {} bricks, to 1e-4 | to 1e-8 | to 1e-12 |",
        bricks(panel)
    );
    for wall in &shown {
        let _ = write!(text, " wall of {} bricks, to 1e-8 |", bricks(wall));
    }
    let _ = writeln!(text, "\n|---|---|---|---|{}", "---|".repeat(shown.len()));
    for route in panel.routes() {
        let of_panel = [1e-4, 1e-8, 1e-12].map(|tolerance| at(panel, route, tolerance));
        let of_walls = shown.iter().map(|wall| at(wall, route, 1e-8));
        let cells: Vec<String> = of_panel.into_iter().chain(of_walls).collect();
        let _ = writeln!(text, "| `{}` | {} |", route.name(), cells.join(" | "));
    }
    let meaning = format!(
        "> {}: stopped by the limit of the bench; too large: not tried, since its dense matrices would be too large; not reached: it ended without a solution.",
        seconds(panel.time_limit.as_secs_f64())
    );
    // An escaped mark is no quotation.
    text + "\n\\" + &meaning + "\n" + machine
}

/// Every second course has one more, of which two are halves.
pub(crate) fn bricks(wall: &Study) -> usize {
    wall.meshes.first().map_or(0, |mesh| mesh.blocks)
}

fn at(study: &Study, route: Route, tolerance: f64) -> String {
    let near = |it: &&Record| it.route == route && (it.tolerance / tolerance).ln().abs() < 0.1;
    let Some(record) = study.on_first_mesh().find(near) else { return "-".to_owned() };
    match record.seconds.filter(|_| record.end.is_solved()) {
        Some(time) => match record.errors.and_then(|errors| errors.worst()) {
            Some(error) => format!("{} ({error:.0e})", seconds(time)),
            None => seconds(time),
        },
        None => without_answer(study, record),
    }
}

/// What stands in the place of a time. Of what was skipped on the first mesh either the order is too large, or the time
/// was too short for a looser tolerance.
fn without_answer(study: &Study, record: &Record) -> String {
    let too_long = format!("> {}", seconds(study.time_limit.as_secs_f64()));
    match &record.end {
        End::Ended(Status::TimeLimit) => too_long,
        End::Skipped(reason) if reason.contains("the time ran out") => too_long,
        End::Skipped(reason) if reason.contains("dense matrices") => "too large".to_owned(),
        _ => "not reached".to_owned(),
    }
}
