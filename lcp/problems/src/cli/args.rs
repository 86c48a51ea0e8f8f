//! The arguments of the command line.

use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};

use super::input::InputArgs;
use lcp::{Covering, LemkeSettings, Method};

/// Solves linear complementarity problems: w = M z + q, z >= 0, w >= 0, z.w = 0; also with free or bounded variables,
/// in the general form, and for contact with friction.
#[derive(Debug, Parser)]
#[command(name = "lcp", version, about, arg_required_else_help = true)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Solve a problem.
    #[command(visible_alias = "qp")]
    Solve(SolveArgs),
    /// Check whether a point solves a problem.
    Check(CheckArgs),
    /// Print all solutions of a small problem, in rational numbers.
    Enumerate(EnumerateArgs),
    /// Show the contents of a file.
    Info(InputArgs),
}

#[derive(Debug, Args)]
pub(super) struct SolveArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// The method.
    #[arg(long, default_value_t, value_parser = method_by_name())]
    pub(super) solver: Method,
    /// Largest residual, relative to the data, of a solution; 1e-10, for pgs 1e-8.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = tolerance)]
    pub(super) tol: Option<f64>,
    /// Pivots of one attempt of lemke; auto then uses lemke.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = count)]
    pub(super) max_pivots: Option<usize>,
    /// Attempts of lemke, alone or in the chain of auto.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = count)]
    pub(super) attempts: Option<usize>,
    /// Covering vector of the first attempt of lemke, `ones` or `random:SEED`; auto then uses lemke.
    #[arg(long, value_name = "D", value_parser = covering)]
    pub(super) covering: Option<Covering>,
    /// Start of the method: `all-y`, `all-t`, or a file with a point, as `lcp solve --json` writes it.
    #[arg(long, value_name = "START")]
    pub(super) start: Option<PathBuf>,
    /// Iterations of pgs, newton or interior; for qp, those within one program.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = count)]
    pub(super) max_iterations: Option<usize>,
    /// Time limit, in seconds.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = seconds)]
    pub(super) time_limit: Option<Duration>,
    /// File for the pivots of lemke, as JSON; auto then uses lemke.
    #[arg(long, value_name = "FILE")]
    pub(super) trace: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(allow_missing_positional = true)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// The point: a JSON object with `z`, and `w` unless it is M z + q; for friction, `contacts` with `normal` and
    /// `tangential` forces; for contact problems, `contact` with `u`, `t_n` and `t_t`. Other fields are ignored; `-` is
    /// standard input.
    #[arg(required = true)]
    pub(super) solution: PathBuf,
    /// Largest residual of a point that counts as a solution.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = tolerance, default_value_t = LemkeSettings::default().tolerance)]
    pub(super) tol: f64,
}

#[derive(Debug, Args)]
pub(super) struct EnumerateArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// Time limit, in seconds; the best point until then is printed.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = seconds, default_value = "60")]
    pub(super) time_limit: Duration,
}

/// `ones` or `random:SEED`.
fn covering(text: &str) -> Result<Covering, &'static str> {
    let seed = text.strip_prefix("random:").and_then(|seed| seed.parse().ok());
    let random = seed.map(|seed| Covering::Random { seed });
    random
        .or((text == "ones").then_some(Covering::Ones))
        .ok_or("it is `ones`, or `random:SEED` with a whole number")
}

fn tolerance(text: &str) -> Result<f64, &'static str> {
    let value = text.parse().ok().filter(|value| *value > 0.0 && *value < 1.0);
    value.ok_or("a tolerance is a number between 0 and 1, as 1e-10")
}

fn count(text: &str) -> Result<usize, &'static str> {
    text.parse().map_err(|_| "it is a whole number, not negative")
}

fn seconds(text: &str) -> Result<Duration, &'static str> {
    let limit = text.parse().ok().and_then(|it| Duration::try_from_secs_f64(it).ok());
    limit.ok_or("it is a number of seconds, not negative, as 2.5")
}

/// The methods by their names, for the option that chooses one.
fn method_by_name() -> impl TypedValueParser<Value = Method> {
    let names = Method::ALL.map(|method| PossibleValue::new(method.name()).help(help(method)));
    PossibleValuesParser::new(names).try_map(|name| name.parse())
}

fn help(method: Method) -> &'static str {
    match method {
        Method::Auto => "The method that suits the problem, and the next one if it fails",
        Method::Lemke => "Lemke's method: any problem",
        Method::Newton => {
            "Semismooth Newton, the active set method: positive diagonals, especially M-matrices"
        }
        Method::Interior => "Interior-point method: large sparse problems",
        Method::QuadraticProgram => {
            "Convex quadratic program: symmetric positive semidefinite matrices"
        }
        Method::GaussSeidel => "Projected Gauss-Seidel: positive diagonals; bounds, friction",
        Method::Enumeration => "All choices of one variable per pair, with proofs: up to 100 pairs",
        _ => "",
    }
}
