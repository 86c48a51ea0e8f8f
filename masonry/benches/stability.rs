//! How far every route can be trusted: the hard cases with their parameters varied.
//!
//! `cargo bench --bench stability` prints for every value what each route gives: the worst of the checks of
//! what it calls solved, held against balance, friction cone, gaps, nodal forces and energy, and the backward
//! error; or how it gave up. It draws them into `target/stability/`, and fails where an answer is worse than what is
//! promised. With `-- --write` it also writes `docs/stability.md`, its picture and its tables; with a word after `--` it
//! takes only the sweeps that have it in their titles.

#![allow(clippy::unwrap_used, reason = "a bench that cannot go on should stop")]
#![allow(dead_code, unreachable_pub, reason = "its modules are those of a test")]

#[path = "../../tests/all/hard_cases/case.rs"]
mod case;
#[path = "../../tests/all/common/mod.rs"]
mod common;
#[path = "../../tests/all/hard_cases/double.rs"]
mod double;
#[path = "../../tests/all/hard_cases/friction.rs"]
mod friction;
#[path = "../../tests/all/hard_cases/geometry.rs"]
mod geometry;
#[path = "../../tests/all/hard_cases/limits.rs"]
mod limits;
#[path = "../../tests/all/hard_cases/page.rs"]
mod page;
#[allow(unused_imports, reason = "its tests are not here")]
#[path = "../../tests/all/hard_cases/problems.rs"]
mod problems;
#[path = "stability/report.rs"]
mod report;
#[path = "../../tests/all/hard_cases/scenes.rs"]
mod scenes;
#[path = "../../tests/all/hard_cases/stiffness.rs"]
mod stiffness;
#[path = "../../tests/all/hard_cases/sweep.rs"]
mod sweep;
#[path = "../../tests/all/hard_cases/walls.rs"]
mod walls;

use std::path::Path;

use common::routes::ROUTES;
use report::Theme;
use sweep::{Point, Reached, Sweep};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // `cargo test --benches` runs the same program without the flag.
    if !arguments.iter().any(|it| it == "--bench") {
        return;
    }
    let wanted = arguments.iter().find(|it| !it.starts_with("--"));
    let (rigid, elastic): (Vec<Sweep>, Vec<Sweep>) =
        limits::sweeps().into_iter().partition(|sweep| sweep.title.contains("rigid"));
    let themes = [
        ("contacts", geometry::TITLE, geometry::sweeps()),
        ("stiffness", stiffness::TITLE, stiffness::sweeps()),
        ("friction", friction::TITLE, friction::sweeps()),
        ("limits_rigid", "Limits of rigid blocks", rigid),
        ("limits_elastic", "Limits of elastic blocks", elastic),
        ("growth", walls::TITLE, walls::sweeps()),
    ];
    let mut swept = Vec::new();
    let mut wrong = Vec::new();
    for (file, title, sweeps) in themes {
        let is_wanted = |sweep: &Sweep| wanted.is_none_or(|word| sweep.title.contains(word));
        let sweeps = sweeps.into_iter().filter(is_wanted);
        let sweeps: Vec<(Sweep, Vec<Point>)> = sweeps.map(tried).collect();
        let lines = sweeps.iter().flat_map(|(_, points)| points).flat_map(|it| it.wrong.clone());
        wrong.extend(lines);
        swept.push(Theme { file, title, sweeps });
    }
    let of_problems = if wanted.is_none() { problems::sweeps() } else { Vec::new() };
    of_problems.iter().for_each(print);
    wrong.extend(of_problems.iter().flat_map(|sweep| sweep.wrong.clone()));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    report::draw(&root.join("target/stability"), &swept, &of_problems);
    for line in &wrong {
        println!("WRONG: {line}");
    }
    assert!(wrong.is_empty(), "{} answers are worse than what is promised", wrong.len());
    if arguments.iter().any(|it| it == "--write") && wanted.is_none() {
        report::write(&root.join("docs"), &swept, &of_problems);
    }
}

/// Every route at every value, printed as it comes.
fn tried(sweep: Sweep) -> (Sweep, Vec<Point>) {
    println!(
        "\n{}\n{:>9}{}",
        sweep.title,
        sweep.parameter,
        ROUTES.map(|it| format!("{:>26}", it.name())).concat()
    );
    let at = |value: &f64| {
        let point = sweep.at(*value);
        let cells = point.ends.iter().map(|end| format!("{:>26}", cell(end)));
        println!("{value:9.1e}{}", cells.collect::<String>());
        point
    };
    let points = sweep.values.iter().map(at).collect();
    (sweep, points)
}

/// The methods of `lcp` on a family of problems.
fn print(sweep: &problems::Sweep) {
    println!("\n{}: {}", sweep.name, sweep.parameter);
    for (k, value) in sweep.values.iter().enumerate() {
        let cells = sweep.methods.iter().map(|(method, found)| match found[k] {
            Some(it) => format!("{:>14} {:>14} {:.0e}", method.name(), it.status, it.residual),
            None => format!("{:>14} {:>14}", method.name(), "-"),
        });
        println!("{value:9.1e}{}", cells.collect::<String>());
    }
}

fn cell(end: &Reached) -> String {
    match end {
        Reached::Solved { error, backward } => format!("{error:.0e} ({backward:.0e})"),
        Reached::GaveUp { status, residual } => format!("{status} {residual:.0e}"),
        Reached::Nothing => "-".to_owned(),
    }
}
