//! What the examples of single scenes share.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use masonry::output::svg::ReferenceLines;
use masonry::output::{self, Options, table};
use masonry::scene::Scene;
use masonry::solve::{Event, solve_observed};

/// Solves `scenes/NAME.toml`, prints the report and writes all files into `target/NAME/`.
pub(crate) fn run(name: &str) -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scene = Scene::read(&root.join("scenes").join(name).with_extension("toml"))?;
    let outcome = solve_observed(&scene, &mut |event| {
        if let Event::Phase(phase) = event {
            eprintln!("{phase} ...");
        }
        ControlFlow::Continue(())
    })?;
    let options = Options { reference: ReferenceLines::of(&scene), ..Options::default() };
    let files = output::write_all(&outcome, &root.join("target").join(name), &options)?;
    println!("{}", table::report(&outcome));
    for file in files {
        println!("wrote {}", file.strip_prefix(root).unwrap_or(&file).display());
    }
    Ok(())
}
