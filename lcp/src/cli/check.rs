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
    if args.solution.as_os_str() == "-" && args.input.is_stdin() {
        return Err("problem and point cannot both come from standard input".into());
    }
    let problem = args.input.read(input)?.problem;
    let Point { residuals, .. } = Point::read(&args.solution, input, &problem)?;
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
