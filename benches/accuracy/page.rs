//! `docs/accuracy.md` with its pictures and CSV, and the section of the README.

use std::fmt::Write as _;
use std::path::Path;

use lcp::Status;
use masonry::output::{study, svg};
use masonry::scene::Route;
use masonry::study::{End, Record, Study};

use super::tables::{self, seconds};
use super::{TOLERANCES, common, machine};

const HEAD: &str = "\
# What accuracy costs

Every route to the solution takes one number, the largest residual of an answer that is called solved. Two errors are kept apart here:

* The **algebraic error** is what a solver leaves undone: the distance of its contact forces, stresses and strain energy from the reference on the
  same mesh, the largest of the three, each relative to the largest one. The reference is refined with numbers of twice the digits, and its
  inequalities are checked in them.
* The **error of the mesh** is what no solver can mend: the distance of the reference from that on the finest mesh.

All times are those of whole solves, from the scene to the checked answer. The same for any scene: `masonry study SCENE --out DIR`. This page is written by
`cargo bench --bench accuracy -- --write`.
";

/// Writes all files.
pub(crate) fn write(root: &Path, panels: &[(&str, Study)], walls: &[Study]) {
    let machine = machine::machine();
    let mut text = format!("{HEAD}\n{machine}\n## In short\n\n");
    for (_, panel) in panels {
        let _ = writeln!(text, "{}:\n", panel.title);
        text += &list(&study::answer(panel));
        text += "\n";
    }
    for (name, panel) in panels {
        text += &of_panel(name, panel, &machine);
        let pictures = [
            ("routes", svg::accuracy(panel)),
            ("mesh", svg::mesh(panel)),
            ("springs", svg::springs(panel)),
        ];
        for (what, picture) in pictures {
            let file = format!("docs/pictures/accuracy_{name}_{what}.svg");
            if let Some(picture) = picture {
                save(root, &file, &picture);
            }
        }
        save(root, &format!("docs/data/accuracy_{name}.csv"), &study::csv(panel));
    }
    text += &of_walls(walls, &machine);
    let title = "Square walls, one element a brick: time and size";
    let sizes = svg::sizes(title, walls, TOLERANCES).expect("something was solved");
    save(root, "docs/pictures/accuracy_sizes.svg", &sizes);
    save(root, "docs/accuracy.md", &text);
    common::write_if_asked("README.md", "accuracy", &short(&panels[0].1, walls, &machine));
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

/// A picture with what is to be seen on it.
fn picture(file: &str, what: &str, machine: &str) -> String {
    format!("\n![{what}](pictures/{file})\n\n*{what}. {}*\n\n", machine.trim())
}

fn of_panel(name: &str, panel: &Study, machine: &str) -> String {
    let first = panel.meshes.first().map_or(0, |mesh| mesh.factor);
    let mut text = format!("## {}\n\n", panel.title);
    text += &list(&study::summary(panel));
    text += &picture(
        &format!("accuracy_{name}_routes.svg"),
        &format!(
            "Algebraic error against time on {first} x {first} elements a square, one line for each route"
        ),
        machine,
    );
    let mut meshes: Vec<_> = panel.meshes.iter().collect();
    meshes.sort_by_key(|mesh| mesh.factor);
    for mesh in meshes {
        let _ = writeln!(
            text,
            "**{0} x {0} elements a square, {1} contact points**: time, and algebraic error where it is solved\n",
            mesh.factor, mesh.contact_points
        );
        text += &tables::by_tolerance(panel, mesh.factor);
    }
    text += &tables::not_tried(panel);
    text += &picture(
        &format!("accuracy_{name}_mesh.svg"),
        "Error of the mesh in the strain energy against time, from coarse to fine",
        machine,
    );
    text += &tables::meshes(panel);
    text += "\nThe references, refined with numbers of twice the digits, and how far that of another route is from it, refined as well. \
             Certain are the digits that rounding errors of redundant contacts, whose gaps contradict each other in the last digits of the data, leave:\n\n";
    text += &tables::references(panel);
    text += "\nWhat the last digits cost once the states of all contacts are known: one factorisation, and solves with it. \
             Errors are distances from the reference; those beyond its certain digits are not known any better than these.\n\n";
    text += &tables::refinings(panel);
    text += &if panel.springs.is_empty() {
        "\n".to_owned()
    } else {
        let what = "What soft springs change before they are centred anew, against their stiffness";
        picture(&format!("accuracy_{name}_springs.svg"), what, machine)
    };
    let _ = writeln!(text, "All records: [accuracy_{name}.csv](data/accuracy_{name}.csv).\n");
    text
}

fn of_walls(walls: &[Study], machine: &str) -> String {
    let [loose, tight] = TOLERANCES;
    let mut text = format!(
        "## Size\n\nSquare walls in running bond on a full floor, one element a brick, `mu = 0.6`, under their weight and a load on top that leans by a tenth: \
         time to {loose:e} and to {tight:e}, and the algebraic error of both.\n"
    );
    let what = "Time against the number of bricks, one line for each route and tolerance";
    text += &picture("accuracy_sizes.svg", what, machine);
    let routes = walls.first().map(Study::routes).unwrap_or_default();
    let names: Vec<&str> = routes.iter().map(|route| route.name()).collect();
    let _ = writeln!(text, "| wall | contact points | {} |", names.join(" | "));
    let _ = writeln!(text, "|---|--:|{}", "---|".repeat(routes.len()));
    for wall in walls {
        let points = wall.meshes.first().map_or(0, |mesh| mesh.contact_points);
        let _ = write!(text, "| {} | {points} |", wall.title);
        for route in &routes {
            let records = wall.on_first_mesh().filter(|it| it.route == *route);
            let cells: Vec<String> = records.map(tables::cell).collect();
            let _ = write!(text, " {} |", cells.join("; "));
        }
        text += "\n";
    }
    text += "\n";
    for wall in walls {
        let skipped = tables::not_tried(wall);
        if !skipped.is_empty() {
            let _ = write!(text, "{}. {skipped}", wall.title);
        }
    }
    text.trim_end().to_owned() + "\n"
}

/// The table of the README: one line a route.
fn short(panel: &Study, walls: &[Study], machine: &str) -> String {
    let bricks = |wall: &Study| wall.meshes.first().map_or(0, |mesh| mesh.blocks);
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
    text + "\n" + machine
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
