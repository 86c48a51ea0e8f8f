//! What a pivot of Lemke's method costs, against the textbook's pivot in the same run.
//!
//! `cargo bench --bench lemke` prints a table; with `-- --write` it also puts it into `docs/performance.md`. The
//! textbook keeps the condensed tableau, n by n + 1, in memory and changes all of it at every pivot: one
//! rank-1 update, which is bound by memory. Of the method the table has the time per pivot along the
//! path, and that of the whole solve, with scaling, start basis and final solve, divided by the pivots.

mod common;
#[path = "common/dense.rs"]
mod dense;

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use dense::{positive_definite, wave};
use faer::Mat;
use lcp::{HorizontalLcp, Lemke, Solution, Solver};
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind};
use masonry::model::Model;
use masonry::scene::Scene;
use masonry::system::System;

fn main() {
    if !common::is_bench() {
        return;
    }
    let random = [100, 200, 400, 800, 1600];
    let random =
        random.map(|n| ("random positive definite".to_owned(), positive_definite(n).into()));
    let panels = ["panel_rectangular", "panel_square"];
    let panels = panels.map(|name| (format!("`{name}`, mixed form"), panel(name)));
    let mut table = String::from(
        "| problem | order | pivots | pivot \\[ms\\] | whole solve / pivots \\[ms\\] | rank-1 update \\[ms\\] | \
         pivot / update | whole / update |\n|---|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    println!("{table}");
    for (name, problem) in random.into_iter().chain(panels) {
        let line = line(&name, &problem);
        println!("{line}");
        let _ = writeln!(table, "{line}");
    }
    common::write_if_asked("docs/performance.md", "lemke", &table);
}

fn line(name: &str, problem: &HorizontalLcp) -> String {
    let n = problem.order();
    let runs = (8000 / n).clamp(3, 20);
    let solutions: Vec<Solution> = (0..runs).map(|_| solve(problem)).collect();
    let pivots = solutions[0].info.pivots;
    let fastest = |seconds: fn(&Solution) -> f64| {
        let all = solutions.iter().map(seconds);
        1e3 * all.fold(f64::INFINITY, f64::min) / pivots as f64
    };
    let (pivot, whole) = (fastest(|it| it.info.pivot_seconds), fastest(|it| it.info.seconds));
    let update = 1e3 * rank_one(n, 10 * runs);
    let (ratio, whole_ratio) = (pivot / update, whole / update);
    format!(
        "| {name} | {n} | {pivots} | {pivot:.4} | {whole:.4} | {update:.4} | {ratio:.2} | {whole_ratio:.2} |"
    )
}

fn solve(problem: &HorizontalLcp) -> Solution {
    let solution = Lemke::default().solve(problem).expect("default settings are valid");
    assert!(solution.is_solved(), "{:?}", solution.status);
    solution
}

/// Seconds of one rank-1 update of an n by n + 1 tableau, the fastest of several.
fn rank_one(n: usize, runs: usize) -> f64 {
    let mut tableau = Mat::<f64>::full(n, n + 1, 1.0);
    let column: Vec<f64> = (0..n).map(|i| wave(i) * 1e-3).collect();
    let row: Vec<f64> = (0..=n).map(wave).collect();
    let mut update = || {
        let began = Instant::now();
        for (j, factor) in row.iter().enumerate() {
            let out = tableau.col_as_slice_mut(j);
            out.iter_mut().zip(&column).for_each(|(v, a)| *v -= a * factor);
        }
        black_box(&mut tableau);
        began.elapsed().as_secs_f64()
    };
    (0..runs).map(|_| update()).fold(f64::INFINITY, f64::min)
}

/// The general problem that a panel of the repository leads to.
fn panel(name: &str) -> HorizontalLcp {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name).with_extension("toml");
    let scene = Scene::read(&path).expect("the scene is part of the repository");
    let model = Model::from_scene(&scene).expect("the scene is sound");
    let system = System::new(&model).expect("the blocks are sound");
    let reduction = Reduction::new(&system, None).expect("no block is free");
    DenseForm::new(FormKind::Mixed, &system, &reduction).expect("finite data").problem
}
