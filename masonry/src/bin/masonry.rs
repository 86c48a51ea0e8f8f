//! The command-line program: `masonry plan`, `solve`, `draw`.

use std::process::ExitCode;

fn main() -> ExitCode {
    masonry::cli::run()
}
