//! `docs/accuracy.md` with its pictures and tables, and the section of the README.

use std::fmt::Write as _;
use std::path::Path;

use lcp::Status;
use masonry::analysis::study::{End, MeshErrors, Record, Study};
use masonry::report::study;
use masonry::scene::Route;

use super::tables::{self, seconds};
use super::{Panel, TOLERANCES, common, data, machine, pictures, springs};

const HEAD: &str = "\
# What accuracy costs

Every route to the solution takes one number, the largest residual of an answer that is called solved. Two errors are kept apart here:

* The **algebraic error** is what a solver leaves undone: the distance of its contact forces, stresses and strain energy from the reference on the
  same mesh, the largest of the three, each relative to the largest one. The reference is refined with numbers of twice the digits, and its
  inequalities are checked in them.
* The **error of the mesh** is what no solver can mend: the distance of the reference from that on the finest mesh. The finest has an error too, so that
  the true error is larger: for one that falls with the order `p` in the size of the elements, `1 / (1 - 2^-p)` times what is given of a mesh half as fine, and
  `1 / (1 - 4^-p)` times of one a quarter as fine: 2 and 1.3 times for `p = 1`, 3.4 and 2 times for `p = 1/2`. What is extrapolated takes that into account.

All times are those of whole solves, from the scene to the checked answer. The same for any scene: `masonry study SCENE --out DIR`. This page is written by
`cargo bench --bench accuracy -- --write`.
";

const HOW_TO_READ: &str = "
## How to read the tables

* **Meshes.** Errors are relative to the finest mesh; those extrapolated, to what the three finest converge to by Richardson's rule, `v_3 + (v_3 - v_2)^2 / ((v_2 - v_1) - (v_3 - v_2))`. \
Their cells are empty where differences do not fall, or not at a rate between the orders 0.5 and 2.5: there nothing but finer meshes tells. \
A single value may come near that of the finest mesh by accident: pictures and sentences have the worst of the three.
* **References.** The margin is what the inequalities of the contact law leave at the contact nearest to another state, relative to the largest force or displacement: but for rounding, \
a solution has none below zero, and a small one tells how near another state of the contacts is. \
Certain are the digits that rounding errors of the data leave: redundant contacts, whose gaps contradict each other in the last digits, take some. \
The distances, in the forces on the nodes, are those of the route's answer in `f64` from its refinement, and of another route's answer, refined as well, from that.
* **The last digits.** A route in `f64` has to find the states of all contacts, and refines by itself. With these states and nothing else, there is one factorisation, and solves with it. \
One solve errs by so much because its factors have springs in the place of hard contacts, 1e8 times as stiff as the bodies, without which redundant contacts would make them singular: \
what the springs leave open the next solve closes, in `f64` down to its rounding errors, and compensated, with residuals of twice the digits, beyond. \
Redundant contacts take more solves: where their gaps contradict each other in the last digits of the data the residual stops falling, what is left is taken for an error of the data, \
and the solves begin anew, at last with softer springs. Errors are distances in the forces on the nodes from the reference; those beyond its certain digits are not known any better than these.
* **Soft springs** on all displacements, which quadratic programs may be given, change the answer until they are centred anew. Share and bias are those before: of the load that they carry, \
and of the displacements that they change. Both are measured by solves more, about the place of rest; where no time is left for these, or they have no answer, neither is known.

";

const NO_BIAS: &str =
    "There is no picture of these: where there is an answer, no bias is known.\n\n";

/// Writes all files.
pub(crate) fn write(root: &Path, panels: &[Panel], walls: &[Study]) {
    let machine = machine::machine();
    let mut text = format!("{HEAD}\n{machine}\n## In short\n\n");
    for panel in panels {
        let short = study::in_short(&panel.study);
        let short = short.unwrap_or_else(|| "No route has an answer.".to_owned());
        let _ = writeln!(text, "* **{}.** {short}{}", panel.study.title, in_the_limit(panel));
    }
    text += HOW_TO_READ;
    for panel in panels {
        let springs = pictures::springs(panel);
        text += &of_panel(panel, springs.is_some(), &machine);
        let pictures = [
            ("routes", study::accuracy(&panel.study)),
            ("mesh", pictures::mesh(&panel.study)),
            ("digits", pictures::digits(panel)),
            ("springs", springs),
        ];
        for (what, picture) in pictures {
            let file = format!("docs/pictures/accuracy_{}_{what}.svg", panel.name);
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
    text += &of_walls(walls, &machine);
    let title = "Square walls, one element a brick: time and size";
    let sizes = pictures::sizes(title, walls, TOLERANCES).expect("something was solved");
    save(root, "docs/pictures/accuracy_sizes.svg", &sizes);
    save(root, "docs/accuracy.md", &text);
    common::write_if_asked("README.md", "accuracy", &short(&panels[0].study, walls, &machine));
}

/// What the error of the scene's own mesh comes to when the finest is not taken for exact.
fn in_the_limit(panel: &Panel) -> String {
    let error = panel.study.meshes.first().and_then(|mesh| mesh.errors?.worst());
    let limit =
        panel.extrapolated.first().and_then(MeshErrors::worst).filter(|it| Some(*it) > error);
    limit.map_or_else(String::new, |it| {
        format!(" Against what meshes converge to, it errs by {it:.1e}.")
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

/// A picture with what is to be seen on it.
fn picture(file: &str, what: &str, machine: &str) -> String {
    format!("\n![{what}](pictures/{file})\n\n*{what}. {}*\n\n", machine.trim())
}

fn of_panel(panel: &Panel, has_bias: bool, machine: &str) -> String {
    let (name, study) = (panel.name, &panel.study);
    let first = study.meshes.first().map_or("", |mesh| &mesh.name);
    let mut text = format!("## {}\n\n", study.title);
    text += &list(&study::summary(study));
    text += &picture(
        &format!("accuracy_{name}_routes.svg"),
        &format!(
            "Algebraic error against time on {first}, one line for each route and one marker for each tolerance"
        ),
        machine,
    );
    let mut meshes: Vec<_> = study.meshes.iter().collect();
    meshes.sort_by_key(|mesh| mesh.factor);
    for mesh in meshes {
        let _ = writeln!(
            text,
            "**{0} x {0} elements a square, {1} contact points**: time, and algebraic error where it is solved\n",
            mesh.factor, mesh.contact_points
        );
        text += &tables::by_tolerance(study, mesh.factor);
    }
    text += &tables::not_tried(study);
    text += &picture(
        &format!("accuracy_{name}_mesh.svg"),
        "Error of the mesh, the worst of energy, thrust and displacement, against time, from coarse to fine",
        machine,
    );
    text += &tables::meshes(panel);
    text += &tables::accident(study);
    text += "\nThe references, refined with numbers of twice the digits:\n\n";
    text += &tables::references(study);
    text += "\nWhat the last digits cost, beside all of a solve in `f64`:\n\n";
    text += &tables::refinings(panel);
    text += &picture(
        &format!("accuracy_{name}_digits.svg"),
        "Error of the forces on the nodes against time: with the states of all contacts known, by one solve, one refinement and compensated refinement; \
         and by whole solves in `f64`",
        machine,
    );
    text += &of_springs(panel, has_bias, machine);
    let files = data::files(panel);
    let files: Vec<String> =
        files.iter().map(|(file, _)| format!("[{file}](data/{file})")).collect();
    let _ = writeln!(text, "All numbers: {}.\n", files.join(", "));
    text
}

fn of_springs(panel: &Panel, has_bias: bool, machine: &str) -> String {
    let mut text = format!("Soft springs, asked for a residual of {:e}:\n\n", springs::TOLERANCE);
    text += &tables::springs(panel);
    if !has_bias {
        return text + NO_BIAS;
    }
    let what = "What soft springs change before they are centred anew, against their stiffness; stiffnesses that are not drawn have no answer";
    text + &picture(&format!("accuracy_{}_springs.svg", panel.name), what, machine)
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
        "> {}: stopped by the limit of the bench; too large: it would build dense matrices of too large an order, and was not tried; not reached: it ended without an answer.",
        seconds(panel.time_limit.as_secs_f64())
    );
    // An escaped mark is no quotation.
    text + "\n\\" + &meaning + "\n" + machine
}

/// Every second course has one more, of which two are halves.
fn bricks(wall: &Study) -> usize {
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
