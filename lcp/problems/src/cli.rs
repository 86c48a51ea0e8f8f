//! The command-line program `lcp`.
//!
//! `--json` prints one JSON object on standard output and nothing else there; errors go to standard
//! error. The exit code is 0 when solved, 1 when not solved, 2 for bad input.

mod args;
mod check;
mod enumerate;
mod info;
mod input;
mod method;
mod output;
mod report;
mod solve;

use std::ffi::OsString;
use std::io::{Read, Write};

use clap::Parser;

use args::{Cli, Command};
use output::{BAD_INPUT, Failure, SOLVED, print};

/// Runs the program on its arguments, the first of which is its name, and returns the exit code.
pub fn run(
    args: impl IntoIterator<Item = OsString>,
    input: &mut dyn Read,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    let (code, message) = match Cli::try_parse_from(args) {
        Ok(cli) => match execute(&cli.command, input, out) {
            Ok(code) => return code,
            Err(failure) => (BAD_INPUT, format!("error: {failure}\n")),
        },
        Err(usage) if usage.use_stderr() => (BAD_INPUT, usage.to_string()),
        // `--help` and `--version`.
        Err(asked) => match print(out, &asked.to_string()) {
            Ok(()) => return SOLVED,
            Err(failure) => (BAD_INPUT, format!("error: {failure}\n")),
        },
    };
    // The exit code still shows the outcome if standard error is closed.
    let _ = err.write_all(message.as_bytes());
    code
}

fn execute(command: &Command, input: &mut dyn Read, out: &mut dyn Write) -> Result<u8, Failure> {
    match command {
        Command::Solve(args) => solve::run(args, input, out),
        Command::Check(args) => check::run(args, input, out),
        Command::Enumerate(args) => enumerate::run(args, input, out),
        Command::Info(args) => info::run(args, input, out),
    }
}
