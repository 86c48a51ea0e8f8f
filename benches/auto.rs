//! What the choice of the method costs on dense positive definite problems: `Auto` against the active set method
//! alone, and against one dense Cholesky factorisation of the matrix in the same run. Small problems, games of two
//! players among them, are compared with one dense LU solve of the same order.
//!
//! `cargo bench --bench auto` prints both tables; with `-- --write` it also puts them into `docs/methods/auto.md`.

mod common;
#[path = "common/dense.rs"]
mod dense;

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use lcp::{Auto, Lcp, SemismoothNewton, Solver};
use lcp_problems::families;

/// Runs of each, one after the other in turn: what disturbs the machine disturbs all of them.
const RUNS: usize = 15;
/// Solves of a small problem in a run.
const REPEATS: usize = 500;

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
    let mut table = String::from(
        "| problem | order | LU solve \\[us\\] | `auto` \\[us\\] | auto / LU |\n|:--|--:|--:|--:|--:|\n",
    );
    println!("\n{table}");
    let game = |order: usize| families::bimatrix(order / 2, order / 2, 1).problem;
    let definite = [6, 12, 24].map(|n| ("positive definite", dense::positive_definite(n)));
    for (name, problem) in definite.into_iter().chain([("game", game(24))]) {
        let line = small_line(name, &problem);
        println!("{line}");
        let _ = writeln!(table, "{line}");
    }
    common::write_if_asked("docs/methods/auto.md", "auto_small", &table);
}

/// One solve from the data to the checked answer, against one dense solve with partial pivoting.
fn small_line(name: &str, problem: &Lcp) -> String {
    let auto = Auto::default();
    let n = problem.order();
    // The matrix of a game is singular for some numbers of choices: one of the same order stands for it.
    let m = dense::positive_definite(n).m().to_dense();
    let q = Mat::from_fn(n, 1, |i, _| problem.q()[i]);
    let mut best = [f64::INFINITY; 2];
    for _ in 0..RUNS {
        let lu = timed(|| (0..REPEATS).for_each(|_| drop(black_box(m.partial_piv_lu().solve(&q)))));
        let chosen = timed(|| (0..REPEATS).for_each(|_| solve(&auto, problem, &mut 0)));
        for (best, seconds) in best.iter_mut().zip([lu, chosen]) {
            *best = best.min(1e6 * seconds / REPEATS as f64);
        }
    }
    let [lu, auto] = best;
    format!("| {name} | {n} | {lu:.1} | {auto:.1} | {:.1} |", auto / lu)
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
