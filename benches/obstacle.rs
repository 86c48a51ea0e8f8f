//! An obstacle problem on nested grids by the active set method, against one sparse Cholesky factorisation
//! of its matrix in the same run.
//!
//! `cargo bench --bench obstacle` prints a table; with `-- --write` it also puts it into the README. The
//! time of the solve is that of all grids together, with their matrices and starts, on one thread.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Par, Side};
use lcp::families::{Ground, Obstacle};
use lcp::{Lcp, Matrix, SemismoothNewton, SemismoothNewtonSettings, Solution, Solver, WarmStart};

const GROUNDS: [(&str, Ground); 2] =
    [("disc", Ground::Disc { radius: 0.6 }), ("hills", Ground::Hills { count: 3 })];

fn main() {
    // `cargo test --benches` runs this without the flag that `cargo bench` gives.
    if !std::env::args().any(|argument| argument == "--bench") {
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
    if std::env::args().any(|argument| argument == "--write") {
        write_into(&Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md"), &table);
    }
}

fn line(name: &str, ground: Ground, side: usize) -> String {
    let runs = if side < 500 { 5 } else { 2 };
    let problem = Obstacle::new(side, side, ground).problem();
    let (symbolic, numeric) = fastest(runs, |(s, n): &(f64, f64)| s + n, || cholesky(&problem));
    drop(problem);
    forget_peak();
    let (seconds, levels) = fastest(runs, |(seconds, _)| *seconds, || nested(side, ground));
    let peak = peak().map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
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

fn fastest<T>(runs: usize, seconds: impl Fn(&T) -> f64, run: impl Fn() -> T) -> T {
    let all = (0..runs).map(|_| run());
    all.min_by(|a, b| seconds(a).total_cmp(&seconds(b))).expect("at least one run")
}

/// Seconds of the whole, and the solution on every grid, the first of about 30 points on a side.
fn nested(side: usize, ground: Ground) -> (f64, Vec<Solution>) {
    let began = Instant::now();
    let halves = std::iter::successors(Some(side), |side| Some(side / 2));
    let mut sides: Vec<usize> = halves.take_while(|side| *side >= 25).collect();
    sides.reverse();
    let mut levels: Vec<Solution> = Vec::new();
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

/// Seconds of the symbolic and of the numeric factorisation.
fn cholesky(problem: &Lcp) -> (f64, f64) {
    let Matrix::Sparse(m) = problem.m() else { panic!("obstacle problems are sparse") };
    let began = Instant::now();
    let params = CholeskySymbolicParams::default();
    let symbolic =
        factorize_symbolic_cholesky(m.symbolic(), Side::Lower, SymmetricOrdering::Amd, params)
            .expect("memory suffices");
    let seconds = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let mut values = vec![0.0; symbolic.len_val()];
    let requirement = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, <_>::default());
    let mut memory = MemBuffer::new(requirement);
    symbolic
        .factorize_numeric_llt(
            &mut values,
            m.as_ref(),
            Side::Lower,
            <_>::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            <_>::default(),
        )
        .expect("positive definite");
    (seconds, began.elapsed().as_secs_f64())
}

/// Largest resident memory since the last [`forget_peak`], where the system tells it.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes / 1024.0)
}

fn forget_peak() {
    // Where the system has no such thing the peak is that of all lines before.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Replaces what stands between the marks of this bench.
fn write_into(path: &Path, table: &str) {
    const MARKS: [&str; 2] = ["<!-- begin: bench obstacle -->\n", "<!-- end: bench obstacle -->"];
    let text = std::fs::read_to_string(path).expect("the file is part of the repository");
    let (before, rest) = text.split_once(MARKS[0]).expect("the file has the first mark");
    let (_, after) = rest.split_once(MARKS[1]).expect("the file has the second mark");
    let text = format!("{before}{}{table}{}{after}", MARKS[0], MARKS[1]);
    std::fs::write(path, text).expect("the file can be written");
}
