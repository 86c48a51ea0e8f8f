//! The paper's rectangular panel: bricks twice as long as high, otherwise as the square one.
//!
//! Prints the report and writes pictures, tables and a mesh into `target/panel_rectangular/`.

mod support;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    support::run("panel_rectangular")
}
