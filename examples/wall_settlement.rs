//! A wall on a foundation of which a part settles and tilts, in steps: each starts from the slip of the
//! one before.
//!
//! Prints the report with the load history and writes pictures, tables and a mesh into
//! `target/wall_settlement/`.

mod support;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    support::run("wall_settlement")
}
