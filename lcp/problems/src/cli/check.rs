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
        format!("{}{}\n", residual_lines(&residuals), sentence(&residuals, args.tol))
    })?;
    Ok(if solves { SOLVED } else { NOT_SOLVED })
}

/// The verdict on a point with these residuals. A point may hold as a whole, measured by the largest loads, and miss
/// rows of small loads.
fn sentence(residuals: &Residuals, tolerance: f64) -> String {
    let as_a_whole = residuals.natural.max(residuals.loads);
    if residuals.worst() <= tolerance {
        format!("the point is a solution to {tolerance:.1e}")
    } else if as_a_whole <= tolerance {
        format!(
            "the point is a solution to {tolerance:.1e} of the largest loads, but not row by row: a row with small terms \
             misses by {:.1e} of its own terms",
            residuals.equation
        )
    } else {
        format!("the point is not a solution to {tolerance:.1e}")
    }
}
