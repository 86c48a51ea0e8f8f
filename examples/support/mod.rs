//! What the examples of single scenes share.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use lcp::Status;
use masonry::analysis::solve::{Event, solve_observed};
use masonry::scene::Scene;
use masonry_report::svg::ReferenceLines;
use masonry_report::{self as report, ReportOptions, table};

/// Solves `scenes/NAME.toml`, prints the report and writes all files into `target/NAME/`.
pub(crate) fn run(name: &str) -> Result<(), Box<dyn Error>> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let scene = Scene::read(&root.join("scenes").join(name).with_extension("toml"))?;
    let mut in_steps = false;
    let outcome = solve_observed(&scene, &mut |event| {
        match event {
            Event::Step { number, of } => {
                in_steps = true;
                eprintln!("step {number} of {of} ...");
            }
            Event::Phase(phase) if !in_steps => eprintln!("{phase} ..."),
            _ => {}
        }
        ControlFlow::Continue(())
    })?;
    let options =
        ReportOptions { reference: ReferenceLines::of(&scene), ..ReportOptions::default() };
    let files = report::write_all(&outcome, &root.join("target").join(name), &options)?;
    println!("{}", table::report(&outcome));
    for file in files {
        println!("wrote {}", file.strip_prefix(root).unwrap_or(&file).display());
    }
    match outcome.solve.status {
        Status::Solved => Ok(()),
        status => Err(format!("the scene is not solved: {status}").into()),
    }
}
