//! The command-line program: `lcp solve`, `check`, `info`.

use std::io::{stderr, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    lcp::cli::run(std::env::args_os(), &mut stdout(), &mut stderr()).into()
}
