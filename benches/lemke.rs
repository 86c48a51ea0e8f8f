//! What a pivot of Lemke's method costs, against the textbook's pivot in the same run.
//!
//! `cargo bench --bench lemke`. The textbook keeps the condensed tableau, n by n + 1, in memory and
//! changes all of it at every pivot: one rank-1 update, which is bound by memory. The table gives
//! both times per pivot and their ratio; start, scaling and the final solve are included in ours.

use std::hint::black_box;
use std::time::Instant;

use faer::Mat;
use lcp::{HorizontalLcp, Lcp, Lemke};

fn main() {
    // `cargo test --benches` runs this without the flag that `cargo bench` gives.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    println!(
        "{:>6} {:>8} {:>14} {:>16} {:>7}",
        "n", "pivots", "ms per pivot", "ms per rank-1", "ratio"
    );
    for n in [100, 200, 400, 800, 1600] {
        let problem = positive_definite(n);
        let (pivots, ours) = per_pivot(&problem);
        let textbook = rank_one(n);
        let ratio = ours / textbook;
        println!("{n:>6} {pivots:>8} {:>14.4} {:>16.4} {ratio:>7.2}", 1e3 * ours, 1e3 * textbook);
    }
}

const RUNS: usize = 5;

/// Pivots, and seconds per pivot of the fastest of several solves.
fn per_pivot(problem: &HorizontalLcp) -> (usize, f64) {
    let solve = || Lemke::default().solve(problem).expect("default settings are valid");
    let solution = solve();
    assert!(solution.is_solved(), "{:?}", solution.status);
    let pivots = solution.info.pivots;
    let fastest = (0..RUNS).map(|_| solve().info.seconds).fold(f64::INFINITY, f64::min);
    (pivots, fastest / pivots as f64)
}

/// Seconds of one rank-1 update of an n by n + 1 tableau, the fastest of several.
fn rank_one(n: usize) -> f64 {
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
    (0..10 * RUNS).map(|_| update()).fold(f64::INFINITY, f64::min)
}

/// `M = C C^T + 1` with entries of `C` between -1/2 and 1/2, `q` likewise.
fn positive_definite(n: usize) -> HorizontalLcp {
    let c = Mat::from_fn(n, n, |i, j| wave(i * n + j));
    let m = &c * c.transpose() + Mat::<f64>::identity(n, n);
    let q = (0..n).map(|i| wave(n * n + i)).collect();
    Lcp::new(m, q).expect("finite data").into()
}

/// A number between -1/2 and 1/2 that looks random.
fn wave(k: usize) -> f64 {
    let x = (k as f64 * 12.9898).sin() * 43_758.545_3;
    x - x.floor() - 0.5
}
