//! `lcp check`.

use std::io::{Read, Write};

use serde::Serialize;

use super::args::CheckArgs;
use super::input::Point;
use super::output::{Failure, NOT_SOLVED, SOLVED, print, print_json, residual_lines};
use crate::Residuals;

/// What `--json` prints.
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
    if !(args.tol > 0.0 && args.tol < 1.0) {
        return Err(format!("--tol is {}, but must be between 0 and 1", args.tol).into());
    }
    let is_piped = args.solution.as_os_str() == "-";
    if is_piped && args.input.is_stdin() {
        return Err("problem and point cannot both come from standard input".into());
    }
    let problem = args.input.read(input)?.problem;
    let point = if is_piped {
        Point::read_stdin(input, &problem)?
    } else {
        Point::read(&args.solution, &problem)?
    };
    let residuals = point.residuals(&problem);
    let solves = residuals.worst() <= args.tol;
    if args.input.json {
        print_json(out, &Verdict { solves, n: problem.order(), tolerance: args.tol, residuals })?;
    } else {
        let verdict =
            if solves { "the point is a solution" } else { "the point is not a solution" };
        let lines = residual_lines(&residuals);
        print(out, &format!("{lines}{verdict} to {:.1e}\n", args.tol))?;
    }
    Ok(if solves { SOLVED } else { NOT_SOLVED })
}
