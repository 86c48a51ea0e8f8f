//! What the choice of the method costs on dense positive definite problems: `Auto` against the active set method
//! alone, and against one dense Cholesky factorisation of the matrix in the same run.
//!
//! `cargo bench --bench auto` prints a table; with `-- --write` it also puts it into `docs/methods/auto.md`.

mod common;
#[path = "common/dense.rs"]
mod dense;

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use faer::Side;
use lcp::{Auto, Lcp, SemismoothNewton, Solver};

/// Runs of each, one after the other in turn: what disturbs the machine disturbs all of them.
const RUNS: usize = 15;

fn main() {
    if !common::is_bench() {
        return;
    }
    let mut table = String::from(
        "| order | Cholesky \\[ms\\] | `newton` \\[ms\\] | `auto` \\[ms\\] | auto / newton | auto / Cholesky | \
         factorisations |\n|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    println!("{table}");
    for n in [400, 800, 1600] {
        let line = line(&dense::positive_definite(n));
        println!("{line}");
        let _ = writeln!(table, "{line}");
    }
    common::write_if_asked("docs/methods/auto.md", "auto", &table);
}

fn line(problem: &Lcp) -> String {
    let (newton, auto) = (SemismoothNewton::default(), Auto::default());
    let m = problem.m().to_dense();
    let mut best = [f64::INFINITY; 3];
    let mut factorisations = 0;
    for _ in 0..RUNS {
        let cholesky = timed(|| {
            black_box(m.llt(Side::Lower).expect("positive definite"));
        });
        let alone = timed(|| solve(&newton, problem, &mut 0));
        let chosen = timed(|| solve(&auto, problem, &mut factorisations));
        for (best, seconds) in best.iter_mut().zip([cholesky, alone, chosen]) {
            *best = best.min(seconds);
        }
    }
    let [cholesky, newton, auto] = best.map(|seconds| 1e3 * seconds);
    format!(
        "| {} | {cholesky:.2} | {newton:.2} | {auto:.2} | {:.2} | {:.2} | {factorisations} |",
        problem.order(),
        auto / newton,
        auto / cholesky,
    )
}

fn timed(mut run: impl FnMut()) -> f64 {
    let began = Instant::now();
    run();
    began.elapsed().as_secs_f64()
}

fn solve(solver: &impl Solver<Lcp>, problem: &Lcp, factorisations: &mut usize) {
    let solution = solver.solve(problem).expect("default settings are valid");
    assert!(solution.is_solved(), "{}", solution.status);
    *factorisations = solution.info.factorisations;
}
