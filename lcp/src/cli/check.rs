//! `lcp check`.

use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{CheckArgs, Failure, NOT_SOLVED, SOLVED, in_file, print, print_json, residual_lines};
use crate::Residuals;
use crate::io::Problem;

/// A point, as `lcp solve --json` writes it.
#[derive(Debug, Deserialize)]
struct Point {
    z: Vec<f64>,
    w: Option<Vec<f64>>,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Verdict {
    solves: bool,
    n: usize,
    tolerance: f64,
    residuals: Residuals,
}

pub(super) fn run(args: &CheckArgs, out: &mut dyn Write) -> Result<u8, Failure> {
    if !(args.tol > 0.0 && args.tol < 1.0) {
        return Err(format!("--tol is {}, but must be between 0 and 1", args.tol).into());
    }
    let problem = args.input.read()?.problem;
    let (z, w) = read_point(&args.solution, &problem)?;
    let residuals = problem.residuals(&z, &w);
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

fn read_point(path: &Path, problem: &Problem) -> Result<(Vec<f64>, Vec<f64>), Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| in_file(path, &error))?;
    let Point { z, w } = serde_json::from_str(&text).map_err(|error| in_file(path, &error))?;
    let n = problem.order();
    let check = |name, v: &[f64]| {
        let len = v.len();
        let wrong = || in_file(path, &format!("`{name}` has {len} entries, but must have {n}"));
        if len == n { Ok(()) } else { Err(wrong()) }
    };
    check("z", &z)?;
    let w = match w {
        Some(w) => w,
        None => problem
            .w_of(&z)
            .ok_or_else(|| in_file(path, &"`w` is missing, which the general form needs"))?,
    };
    check("w", &w)?;
    Ok((z, w))
}
