//! An obstacle problem on nested grids by the active set method, against one sparse Cholesky factorisation
//! of its matrix in the same run.
//!
//! `cargo bench --bench obstacle` prints a table; with `-- --write` it also puts it into `docs/performance.md`. The
//! time of the solve is that of all grids together, with their matrices and starts, on one thread.

mod common;
#[allow(dead_code, reason = "other benches have contact problems")]
#[path = "common/sparse.rs"]
mod sparse;

use std::fmt::Write as _;
use std::time::Instant;

use lcp::{Lcp, SemismoothNewton, SemismoothNewtonSettings, Solution, Solver, WarmStart};
use lcp_problems::families::{Ground, Obstacle};

const GROUNDS: [(&str, Ground); 2] =
    [("disc", Ground::Disc { radius: 0.6 }), ("hills", Ground::Hills { count: 3 })];

fn main() {
    if !common::is_bench() {
        return;
    }
    let mut table = String::from(
        "| obstacle | points | Cholesky, symbolic + numeric \\[s\\] | whole solve \\[s\\] | solve / Cholesky | \
         steps per grid | factorisations on the last | natural residual | contact | peak memory \\[MB\\] |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    println!("{table}");
    for (name, ground) in GROUNDS {
        for side in [100, 316, 1000] {
            let line = line(name, ground, side);
            println!("{line}");
            let _ = writeln!(table, "{line}");
        }
    }
    common::write_if_asked("docs/performance.md", "obstacle", &table);
}

fn line(name: &str, ground: Ground, side: usize) -> String {
    let runs = if side < 500 { 5 } else { 2 };
    let problem = Obstacle::new(side, side, ground).problem();
    let m = problem.m().to_sparse();
    let (symbolic, numeric) =
        sparse::fastest(runs, |(s, n): &(f64, f64)| s + n, || sparse::cholesky(&m));
    drop(problem);
    sparse::forget_peak();
    let (seconds, levels) = sparse::fastest(runs, |(seconds, _)| *seconds, || nested(side, ground));
    let peak = sparse::peak().map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
    let steps: Vec<String> = levels.iter().map(|it| it.info.iterations.to_string()).collect();
    let last = levels.last().expect("at least one grid");
    let contact = last.t.iter().filter(|z| **z <= 0.0).count() as f64 / last.t.len() as f64;
    format!(
        "| {name} | {} | {symbolic:.3} + {numeric:.3} | {seconds:.3} | {:.2} | {} | {} | {:.0e} | {:.0} % | {peak} |",
        last.t.len(),
        seconds / (symbolic + numeric),
        steps.join(", "),
        last.info.factorisations,
        last.residuals.natural,
        100.0 * contact,
    )
}

/// Seconds of the whole, and the solution on every grid, the first of about 30 points on a side.
fn nested(side: usize, ground: Ground) -> (f64, Vec<Solution<Lcp>>) {
    let began = Instant::now();
    let halves = std::iter::successors(Some(side), |side| Some(side / 2));
    let mut sides: Vec<usize> = halves.take_while(|side| *side >= 25).collect();
    sides.reverse();
    let mut levels: Vec<Solution<Lcp>> = Vec::new();
    let mut coarse: Option<Obstacle> = None;
    for side in sides {
        let grid = Obstacle::new(side, side, ground);
        let start = coarse.zip(levels.last()).map_or(WarmStart::None, |(coarse, solution)| {
            grid.refined_start(&coarse, &solution.t).expect("one entry for every point")
        });
        let settings = SemismoothNewtonSettings { start, ..SemismoothNewtonSettings::default() };
        let solution = SemismoothNewton::new(settings).solve(&grid.problem());
        let solution = solution.expect("the diagonal is positive");
        assert!(solution.is_solved(), "{:?}", solution.status);
        coarse = Some(grid);
        levels.push(solution);
    }
    (began.elapsed().as_secs_f64(), levels)
}
