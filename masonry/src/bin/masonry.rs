//! The command-line program: `masonry plan`, `solve`, `study`, `draw`.

use std::process::ExitCode;

fn main() -> ExitCode {
    masonry::cli::run()
}
