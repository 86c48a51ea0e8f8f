//! The command-line program `lcp`.
//!
//! `--json` prints one JSON object on standard output and nothing else there; errors go to standard
//! error. The exit code is 0 when solved, 1 when not solved, 2 for bad input.

mod check;
mod info;
mod input;
mod method;
mod report;
mod solve;

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand};

use input::InputArgs;

use crate::{Covering, LemkeSettings, Method, Residuals};

/// Solves linear complementarity problems: w = M z + q, z >= 0, w >= 0, z.w = 0, and their relatives
/// with free and bounded variables, in general form, and for contact with friction.
#[derive(Debug, Parser)]
#[command(name = "lcp", version, about, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve a problem.
    Solve(SolveArgs),
    /// Say how well a given point solves a problem.
    Check(CheckArgs),
    /// Say what a file holds.
    Info(InfoArgs),
}

#[derive(Debug, Args)]
struct SolveArgs {
    #[command(flatten)]
    input: InputArgs,
    /// The method.
    #[arg(long, value_enum, default_value_t)]
    solver: Method,
    /// Largest residual, relative to the data, of an answer called solved; 1e-10, for pgs 1e-8.
    #[arg(long, value_name = "T")]
    tol: Option<f64>,
    /// Pivots of one attempt of lemke; auto then takes that.
    #[arg(long, value_name = "N")]
    max_pivots: Option<usize>,
    /// Attempts of lemke, each from another start or with another covering vector; auto then takes that.
    #[arg(long, value_name = "N")]
    attempts: Option<usize>,
    /// Covering vector of the first attempt of lemke, `ones` or `random:SEED`; auto then takes that.
    #[arg(long, value_name = "D", value_parser = method::covering)]
    covering: Option<Covering>,
    /// Where the method starts: `all-y`, `all-t`, or a file with a point, as `lcp solve --json` writes it.
    #[arg(long, value_name = "START")]
    start: Option<PathBuf>,
    /// Iterations of pgs, newton or interior; of qp those within one program.
    #[arg(long, value_name = "N")]
    max_iterations: Option<usize>,
    /// Time after which the search ends, in seconds.
    #[arg(long, value_name = "S")]
    time_limit: Option<f64>,
    /// A file to write the pivots of lemke into, as JSON; auto then takes that.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(allow_missing_positional = true)]
struct CheckArgs {
    #[command(flatten)]
    input: InputArgs,
    /// The point: a JSON object with `z`, and `w` unless it is M z + q; of contact problems `contact` with `u`,
    /// `t_n` and `t_t` instead. Other fields do not matter.
    #[arg(required = true)]
    solution: PathBuf,
    /// Largest residual of a point that counts as a solution.
    #[arg(long, value_name = "T", default_value_t = LemkeSettings::default().tolerance)]
    tol: f64,
}

#[derive(Debug, Args)]
struct InfoArgs {
    #[command(flatten)]
    input: InputArgs,
}

type Failure = Box<dyn std::error::Error>;

const SOLVED: u8 = 0;
const NOT_SOLVED: u8 = 1;
const BAD_INPUT: u8 = 2;

/// Runs the program on its arguments, the first of which is its name, and gives the exit code.
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
        // Help and version were asked for.
        Err(asked) => match print(out, &asked.to_string()) {
            Ok(()) => return SOLVED,
            Err(failure) => (BAD_INPUT, format!("error: {failure}\n")),
        },
    };
    // Where standard error is closed, the exit code still says what happened.
    let _ = err.write_all(message.as_bytes());
    code
}

fn execute(command: &Command, input: &mut dyn Read, out: &mut dyn Write) -> Result<u8, Failure> {
    match command {
        Command::Solve(args) => solve::run(args, input, out),
        Command::Check(args) => check::run(args, input, out),
        Command::Info(args) => info::run(args, input, out),
    }
}

/// The failure with the name of the file, which the error of a place in it does not have.
fn in_file(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    format!("{}: {error}", path.display()).into()
}

fn residual_lines(residuals: &Residuals) -> String {
    let Residuals { equation, feasibility, complementarity, natural, loads } = residuals;
    let named = [
        ("equation", equation),
        ("feasibility", feasibility),
        ("complementarity", complementarity),
        ("natural", natural),
        ("loads", loads),
    ];
    named.iter().fold("residuals, relative to the data\n".to_owned(), |mut lines, (name, value)| {
        let _ = writeln!(lines, "  {name:<16} {value:.1e}");
        lines
    })
}

fn print_json(out: &mut dyn Write, object: &impl serde::Serialize) -> Result<(), Failure> {
    print(out, &(serde_json::to_string(object)? + "\n"))
}

/// A closed pipe is the reader's choice, not a failure of ours.
fn print(out: &mut dyn Write, text: &str) -> Result<(), Failure> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}
