//! The command-line program: `lcp solve`, `check`, `enumerate`, `info`.

use std::io::{stderr, stdin, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    lcp_problems::cli::run(std::env::args_os(), &mut stdin(), &mut stdout(), &mut stderr()).into()
}
