//! The sparse LU of the steps of `lcp` against faer's, and against its Cholesky where the matrix is symmetric.
//!
//! `cargo bench --bench lu` prints a table. Bound to one core (`taskset -c 0`) all is on one thread.
//! Every line is one run, of every factorisation the fastest of five; symbolic parts are apart, since `lcp` needs one for a whole solve.

#[allow(dead_code, reason = "other benches write their tables")]
mod common;
#[allow(dead_code, reason = "other benches measure memory")]
#[path = "common/sparse.rs"]
mod sparse;
#[path = "common/walls.rs"]
mod walls;

use std::time::Instant;

use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Par};
use lcp::Contact2d;
use lcp_linalg::SupernodalLu;
use lcp_problems::families;
use walls::wall;

const RUNS: usize = 5;
/// Largest residual of a solve, relative to the right-hand side.
const EXACT: f64 = 1e-8;

fn main() {
    if !common::is_bench() {
        return;
    }
    faer::set_global_parallelism(Par::Seq);
    println!(
        "| matrix | order | nonzeros | lcp LU, symbolic + numeric \\[s\\] | faer LU | faer Cholesky | numeric: \
         faer LU / lcp LU | lcp LU / faer Cholesky |\n|---|--:|--:|--:|--:|--:|--:|--:|"
    );
    for side in [50, 100, 200] {
        let membrane = families::obstacle(side).problem.m().to_sparse();
        line(&format!("membrane, {side} x {side}"), &membrane, true);
    }
    for (width, courses) in [(5.0, 20), (10.0, 40), (20.0, 100)] {
        let (blocks, problem) = wall(width, courses, 0.7);
        line(&format!("wall of {blocks} bricks, stuck"), &closed(&problem, |_| false), true);
        line(
            &format!("wall of {blocks} bricks, half of it slides"),
            &closed(&problem, |i| i % 2 == 0),
            false,
        );
    }
}

fn line(name: &str, matrix: &SparseColMat<usize, f64>, is_symmetric: bool) {
    let (ours, faers) = (best(|| supernodal(matrix)), best(|| lu(matrix)));
    let cholesky = is_symmetric.then(|| best(|| sparse::cholesky(matrix)));
    let times = |(symbolic, numeric): (f64, f64)| format!("{symbolic:.4} + {numeric:.4}");
    println!(
        "| {name} | {} | {} | {} | {} | {} | {:.2} | {} |",
        matrix.ncols(),
        matrix.compute_nnz(),
        times(ours),
        times(faers),
        cholesky.map_or_else(|| "-".to_owned(), times),
        faers.1 / ours.1,
        cholesky.map_or_else(|| "-".to_owned(), |it| format!("{:.2}", ours.1 / it.1)),
    );
}

fn best(run: impl Fn() -> (f64, f64)) -> (f64, f64) {
    sparse::fastest(RUNS, |(_, numeric)| *numeric, run)
}

fn supernodal(matrix: &SparseColMat<usize, f64>) -> (f64, f64) {
    let began = Instant::now();
    let mut factors = SupernodalLu::new(matrix.symbolic()).expect("memory suffices");
    let symbolic = began.elapsed().as_secs_f64();
    let began = Instant::now();
    factors.factorise(matrix.val());
    let numeric = began.elapsed().as_secs_f64();
    let mut x = vec![1.0; matrix.ncols()];
    factors.solve(&mut x);
    assert_exact(matrix, &Mat::from_fn(x.len(), 1, |i, _| x[i]));
    (symbolic, numeric)
}

fn lu(matrix: &SparseColMat<usize, f64>) -> (f64, f64) {
    let began = Instant::now();
    let symbolic = SymbolicLu::try_new(matrix.symbolic()).expect("memory suffices");
    let seconds = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let factors = Lu::try_new_with_symbolic(symbolic, matrix.as_ref()).expect("regular");
    let numeric = began.elapsed().as_secs_f64();
    assert_exact(matrix, &factors.solve(Mat::<f64>::from_fn(matrix.ncols(), 1, |_, _| 1.0)));
    (seconds, numeric)
}

/// That `x` solves for ones.
fn assert_exact(matrix: &SparseColMat<usize, f64>, x: &Mat<f64>) {
    let image = matrix.as_ref() * x;
    let off = (0..matrix.nrows()).fold(0.0_f64, |max, i| max.max((image[(i, 0)] - 1.0).abs()));
    assert!(off <= EXACT, "{off:e}");
}

/// `K + C^T S C` of contacts that are all closed, as stiff as the bodies, of which some slide.
fn closed(problem: &Contact2d, slides: impl Fn(usize) -> bool) -> SparseColMat<usize, f64> {
    let (n, k) = (problem.displacements(), problem.stiffness());
    let mean = (0..n).map(|j| k.get(j, j).copied().unwrap_or(0.0)).sum::<f64>() / n as f64;
    let rows = |matrix: &SparseColMat<usize, f64>| -> Vec<Vec<(usize, f64)>> {
        let mut rows = vec![Vec::new(); problem.points()];
        matrix.triplet_iter().for_each(|entry| rows[entry.row].push((entry.col, *entry.val)));
        rows
    };
    let (normal, tangent) = (rows(problem.normal()), rows(problem.tangent()));
    let mut entries: Vec<Triplet<usize, usize, f64>> =
        k.triplet_iter().map(|entry| Triplet::new(entry.row, entry.col, *entry.val)).collect();
    let mut add = |left: &[(usize, f64)], right: &[(usize, f64)], s: f64| {
        for &(i, v) in left {
            entries.extend(right.iter().map(|&(j, w)| Triplet::new(i, j, mean * s * v * w)));
        }
    };
    for i in 0..problem.points() {
        let (of_slip, of_gap) = if slides(i) { (0.0, -problem.mu()[i]) } else { (1.0, 0.0) };
        add(&normal[i], &normal[i], 1.0);
        add(&tangent[i], &tangent[i], of_slip);
        add(&tangent[i], &normal[i], of_gap);
        // The pattern is symmetric.
        add(&normal[i], &tangent[i], 0.0);
    }
    SparseColMat::try_new_from_triplets(n, n, &entries).expect("memory suffices")
}
