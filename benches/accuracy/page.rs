//! `docs/accuracy.md` with its pictures and CSV, and the section of the README.

use std::fmt::Write as _;
use std::path::Path;

use masonry::output::{study, svg};
use masonry::scene::Route;
use masonry::study::{Record, Study};

use super::common;

const HEAD: &str = "\
# What accuracy costs

Every route to the solution takes one number, the largest residual of an answer that is called solved, and tells what it reached. Two errors are kept
apart here:

* The **algebraic error** is what a solver leaves undone: the distance of its contact forces, stresses and energy from the reference on the same
  mesh, the largest of the three, each relative to the largest one. The reference is the most accurate answer that there is.
* The **error of the mesh** is what no solver can mend: the distance of the reference from that on the finest mesh.

The same for any scene: `masonry study SCENE --out DIR`. This page is written by `cargo bench --bench accuracy -- --write`.
";

/// Writes all files.
pub(crate) fn write(root: &Path, panels: &[(&str, Study)], walls: &[Study]) {
    let machine = common::machine();
    let mut text = format!("{HEAD}\n{machine}");
    for (name, panel) in panels {
        text += &of_panel(name, panel);
        let pictures = [
            ("routes", svg::accuracy(panel)),
            ("mesh", svg::mesh(panel)),
            ("springs", svg::springs(panel)),
        ];
        for (what, picture) in pictures {
            save(
                root,
                &format!("docs/pictures/accuracy_{name}_{what}.svg"),
                &picture.expect("something was solved"),
            );
        }
        save(root, &format!("docs/data/accuracy_{name}.csv"), &study::csv(panel));
    }
    text += &of_walls(walls);
    let sizes = svg::sizes("Square walls of growing size: time and contact points", walls, 1e-8);
    save(root, "docs/pictures/accuracy_sizes.svg", &sizes.expect("something was solved"));
    save(root, "docs/accuracy.md", &text);
    common::write_if_asked("README.md", "accuracy", &short(panels, walls, &machine));
}

fn save(root: &Path, file: &str, text: &str) {
    let path = root.join(file);
    std::fs::create_dir_all(path.parent().expect("files are in folders"))
        .expect("a folder can be made");
    std::fs::write(path, text).expect("a file can be written");
}

fn of_panel(name: &str, panel: &Study) -> String {
    let mut text = format!("\n## {}\n\n", panel.title);
    for sentence in study::summary(panel) {
        let _ = writeln!(text, "* {sentence}");
    }
    let _ = writeln!(
        text,
        "\n![Algebraic error against time, one line a route](pictures/accuracy_{name}_routes.svg)\n"
    );
    for mesh in &panel.meshes {
        let _ = writeln!(
            text,
            "**{0} x {0} elements a brick, {1} contact points**: time in seconds, and algebraic error where it is solved\n",
            mesh.factor, mesh.contact_points
        );
        text += &by_tolerance(panel, mesh.factor);
    }
    let _ =
        writeln!(text, "\n![Error of the mesh against time](pictures/accuracy_{name}_mesh.svg)\n");
    text += &meshes(panel);
    let _ = writeln!(text, "\n![What soft springs change](pictures/accuracy_{name}_springs.svg)\n");
    let _ = writeln!(text, "All numbers: [accuracy_{name}.csv](data/accuracy_{name}.csv).");
    text
}

fn by_tolerance(panel: &Study, mesh: u32) -> String {
    let first = panel.routes()[0];
    let tolerances: Vec<f64> = panel
        .records
        .iter()
        .filter(|it| it.mesh == mesh && it.route == first)
        .map(|it| it.tolerance)
        .collect();
    let mut text = String::from("| route |");
    tolerances.iter().for_each(|tolerance| text += &format!(" {tolerance:e} |"));
    text += &format!("\n|---|{}\n", "---|".repeat(tolerances.len()));
    for route in panel.routes() {
        let _ = write!(text, "| {} |", route.name());
        for record in panel.records.iter().filter(|it| it.mesh == mesh && it.route == route) {
            let _ = write!(text, " {} |", cell(record));
        }
        text += "\n";
    }
    text + "\n"
}

fn cell(record: &Record) -> String {
    let time = record.seconds.map_or_else(String::new, |seconds| format!("{seconds:.1e} s"));
    let error = record.errors.and_then(|errors| errors.worst());
    match error.filter(|_| record.end.is_solved()) {
        Some(error) => format!("{time}, {error:.0e}"),
        None if record.seconds.is_some() => format!("{time}: {}", record.end.name()),
        None => record.end.name(),
    }
}

fn meshes(panel: &Study) -> String {
    let mut text = String::from(
        "| elements a brick | elements | contact points | error of the energy | of the thrust | of the displacement |\n|--:|--:|--:|--:|--:|--:|\n",
    );
    for mesh in &panel.meshes {
        let error = |of: fn(&masonry::study::MeshErrors) -> Option<f64>| {
            mesh.errors
                .as_ref()
                .and_then(of)
                .map_or_else(|| "-".to_owned(), |it| format!("{it:.1e}"))
        };
        let _ = writeln!(
            text,
            "| {0} x {0} | {1} | {2} | {3} | {4} | {5} |",
            mesh.factor,
            mesh.elements,
            mesh.contact_points,
            error(|it| it.energy),
            error(|it| it.thrust),
            error(|it| it.displacement),
        );
    }
    text
}

fn of_walls(walls: &[Study]) -> String {
    let mut text = String::from(
        "\n## Size\n\nSquare walls on a full floor, one element a brick, `mu = 0.6`, under their weight and a load on top that leans by a tenth: \
         time to 1e-4 and to 1e-8, and the algebraic error of the latter.\n\n\
         ![Time against contact points](pictures/accuracy_sizes.svg)\n\n",
    );
    let routes = walls.first().map(Study::routes).unwrap_or_default();
    text += "| wall | contact points |";
    routes.iter().for_each(|route| text += &format!(" {} |", route.name()));
    text += &format!("\n|---|--:|{}\n", "---|".repeat(routes.len()));
    for wall in walls {
        let points = wall.meshes.first().map_or(0, |mesh| mesh.contact_points);
        let _ = write!(text, "| {} | {points} |", wall.title);
        for route in &routes {
            let records: Vec<&Record> =
                wall.on_first_mesh().filter(|it| it.route == *route).collect();
            let cells: Vec<String> = records.iter().map(|record| cell(record)).collect();
            let _ = write!(text, " {} |", cells.join("; "));
        }
        text += "\n";
    }
    text + "\nA wall that is said to be skipped needs dense matrices beyond what is built here, or its time ran out at a looser tolerance.\n"
}

/// The table of the README: one line a route.
fn short(panels: &[(&str, Study)], walls: &[Study], machine: &str) -> String {
    let panel = &panels[0].1;
    let mut text = String::from(
        "| route | rectangular panel, to 1e-4 | to 1e-8 | to 1e-12 | wall of 100 bricks, to 1e-8 | of 1600 |\n|---|---|---|---|---|---|\n",
    );
    for route in panel.routes() {
        let of_panel = [1e-4, 1e-8, 1e-12].map(|tolerance| at(panel, route, tolerance));
        let of_walls = [1, 3].map(|k: usize| at(&walls[k], route, 1e-8));
        let _ = writeln!(
            text,
            "| `{}` | {} | {} |",
            route.name(),
            of_panel.join(" | "),
            of_walls.join(" | ")
        );
    }
    text + "\n" + machine
}

fn at(study: &Study, route: Route, tolerance: f64) -> String {
    let near = |it: &&Record| it.route == route && (it.tolerance / tolerance).ln().abs() < 0.1;
    let Some(record) = study.on_first_mesh().find(near) else { return "-".to_owned() };
    match record.seconds.filter(|_| record.end.is_solved()) {
        Some(seconds) => match record.errors.and_then(|errors| errors.worst()) {
            Some(error) => format!("{} ({error:.0e})", time(seconds)),
            None => time(seconds),
        },
        None => record.end.name(),
    }
}

fn time(seconds: f64) -> String {
    if seconds < 1.0 { format!("{:.2} ms", 1e3 * seconds) } else { format!("{seconds:.1} s") }
}
