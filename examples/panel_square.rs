//! The paper's square panel: dry bricks between rigid side walls, on two corner supports.
//!
//! Prints the report and writes pictures, tables and a mesh into `target/panel_square/`.

mod support;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    support::run("panel_square")
}
