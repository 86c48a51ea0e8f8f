//! Walls of many bricks with friction by the interior-point method, against one sparse factorisation of
//! the matrix of its steps in the same run.
//!
//! `cargo bench --bench wall` prints a table; with `-- --write` it also puts it into `docs/performance.md`. Bound to
//! one core (`taskset -c 0`) all is on one thread. The yardstick is faer's Cholesky factorisation, symbolic and numeric, of
//! `K + k C^T C`, which has the pattern of the matrices that the method factorises; those are unsymmetric,
//! which doubles the operations of the numeric part.

mod common;
#[path = "common/sparse.rs"]
mod sparse;
#[path = "common/walls.rs"]
mod walls;

use std::fmt::Write as _;

use lcp::{InteriorPoint, InteriorPointSettings, Solver};
use walls::wall;

/// Length of the walls in metres, and courses.
const WALLS: [(f64, u32); 3] = [(5.0, 20), (10.0, 40), (20.0, 100)];
const FRICTION: [f64; 3] = [0.5, 0.7, 1.0];
const TOLERANCE: f64 = 1e-8;
/// A solve that takes longer than this many factorisations of the yardstick is a failure.
const MOST: f64 = 300.0;

fn main() {
    if !common::is_bench() {
        return;
    }
    let mut table = String::from(
        "| blocks | contact points | order | mu | Cholesky, symbolic + numeric \\[s\\] | whole solve \\[s\\] | \
         solve / Cholesky | steps | factorisations | worst residual | peak memory \\[MB\\] |\n\
         |--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    println!("{table}");
    for (width, courses) in WALLS {
        for mu in FRICTION {
            let line = line(width, courses, mu);
            println!("{line}");
            let _ = writeln!(table, "{line}");
        }
    }
    common::write_if_asked("docs/performance.md", "wall", &table);
}

fn line(width: f64, courses: u32, mu: f64) -> String {
    let (blocks, problem) = wall(width, courses, mu);
    let matrix = sparse::condensed(&problem);
    let (symbolic, numeric) =
        sparse::fastest(3, |(s, n): &(f64, f64)| s + n, || sparse::cholesky(&matrix));
    drop(matrix);
    sparse::forget_peak();
    let settings =
        InteriorPointSettings { tolerance: TOLERANCE, ..InteriorPointSettings::default() };
    let solution = InteriorPoint::new(settings).solve(&problem).expect("memory suffices");
    let peak = sparse::peak().map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
    assert!(solution.is_solved(), "{:?}", solution.status);
    let multiple = solution.info.seconds / (symbolic + numeric);
    assert!(multiple < MOST, "{multiple} factorisations");
    format!(
        "| {blocks} | {} | {} | {mu} | {symbolic:.2} + {numeric:.2} | {:.1} | {:.0} | {} | {} | {:.0e} | {peak} |",
        problem.points(),
        problem.order(),
        solution.info.seconds,
        multiple,
        solution.info.iterations,
        solution.info.factorisations,
        solution.residuals.worst(),
    )
}
