//! `lcp check`.

use std::io::{Read, Write};

use serde::Serialize;

use super::args::CheckArgs;
use super::input::Point;
use super::output::{Failure, NOT_SOLVED, SOLVED, residual_lines, show};
use lcp::Residuals;

/// The object that `--json` prints.
#[derive(Debug, Serialize)]
struct Verdict {
    solves: bool,
    n: usize,
    tolerance: f64,
    residuals: Residuals,
}

pub(super) fn run(
    args: &CheckArgs,
    input: &mut dyn Read,
    out: &mut dyn Write,
) -> Result<u8, Failure> {
    if args.solution.as_os_str() == "-" && args.input.is_stdin() {
        return Err("problem and point cannot both come from standard input".into());
    }
    let problem = args.input.read(input)?.problem;
    let Point { residuals, .. } = Point::read(&args.solution, input, &problem)?;
    let solves = residuals.worst() <= args.tol;
    let verdict = Verdict { solves, n: problem.order(), tolerance: args.tol, residuals };
    show(out, args.input.json, &verdict, || {
        let not = if solves { "" } else { "not " };
        let lines = residual_lines(&residuals);
        format!("{lines}the point is {not}a solution to {:.1e}\n", args.tol)
    })?;
    Ok(if solves { SOLVED } else { NOT_SOLVED })
}
