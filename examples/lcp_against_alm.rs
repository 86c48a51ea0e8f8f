//! The paper's comparison (section 4): the complementarity problem by pivoting against the augmented
//! Lagrangian method, and beside both the interior-point method, on the dry panels.
//!
//! The paper found for the square panel a problem of order about 1600, pivoting at less than a tenth of the
//! time of the augmented Lagrangian method, and 15 to 30 iterations of that until the unbalanced force was 1e-4.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use lcp::{Contact2d, InteriorPoint, Solver, Status};
use masonry::forms::Sparse;
use masonry::model::Model;
use masonry::routes::alm::{self, Settings};
use masonry::scene::Scene;
use masonry::solve::solve;
use masonry::system::System;

const MEGABYTE: f64 = 1e6;

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "{:<26} {:<22} {:>8} {:>11} {:>11} {:>8} {:>8} {:>9}",
        "panel", "method", "order", "memory/MB", "iterations", "time/s", "x ALM", "residual"
    );
    for name in ["panel_square", "panel_square_full_floor", "panel_rectangular"] {
        compare(name)?;
    }
    println!(
        "\nmemory: n x 2n numbers for pivots, n x semi-bandwidth for the others, as the paper counts"
    );
    println!(
        "the paper: order about 1600; pivots < 0.1 of ALM's time; 15 to 30 iterations to 1e-4"
    );
    Ok(())
}

fn compare(name: &str) -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    let scene = Scene::read(&path.with_extension("toml"))?;
    let began = Instant::now();
    let outcome = solve(&scene)?;
    let pivoting = began.elapsed().as_secs_f64();
    let system = System::new(&Model::from_scene(&scene)?)?;
    let problem = Sparse::new(&system)?.problem;
    let (n, band) = (problem.displacements(), semi_bandwidth(&problem));
    let banded = 8.0 * (n * band) as f64 / MEGABYTE;

    let mut reference = None;
    let mut line = |method: &str,
                    order: usize,
                    memory: f64,
                    iterations: usize,
                    seconds,
                    residual| {
        let unit: f64 = *reference.get_or_insert(seconds);
        let ratio = seconds / unit;
        println!(
            "{name:<26} {method:<22} {order:>8} {memory:>11.1} {iterations:>11} {seconds:>8.3} {ratio:>8.2} \
             {residual:>9.0e}"
        );
    };
    for tolerance in [1e-4, 1e-8] {
        let settings = Settings { tolerance, ..Settings::default() };
        let began = Instant::now();
        let answer = alm::solve(&problem, &settings, &mut |_| ControlFlow::Continue(()))?;
        let seconds = began.elapsed().as_secs_f64();
        check("ALM", answer.status)?;
        let method = format!("ALM to {tolerance:.0e}");
        line(&method, n, banded, answer.history.len(), seconds, answer.residuals.worst());
    }
    check("pivots", outcome.solve.status)?;
    let (order, residual) = (outcome.solve.order, outcome.solve.residuals.worst());
    let dense = 16.0 * (order as f64).powi(2) / MEGABYTE;
    line("pivots (Lemke)", order, dense, outcome.solve.pivots, pivoting, residual);
    let interior = InteriorPoint::default().solve(&problem)?;
    check("interior points", interior.status)?;
    let (steps, residual) = (interior.info.iterations, interior.residuals.worst());
    line("interior points", n, banded, steps, interior.info.seconds, residual);
    Ok(())
}

fn check(method: &str, status: Status) -> Result<(), String> {
    if status == Status::Solved { Ok(()) } else { Err(format!("{method}: {status}")) }
}

/// Of `K + C^T C`, in the order of the bricks.
fn semi_bandwidth(problem: &Contact2d) -> usize {
    let stiffness = problem.stiffness().triplet_iter().map(|e| e.row.abs_diff(e.col));
    let mut ends = vec![(usize::MAX, 0_usize); problem.points()];
    for matrix in [problem.normal(), problem.tangent()] {
        for entry in matrix.triplet_iter() {
            let (first, last) = ends[entry.row];
            ends[entry.row] = (first.min(entry.col), last.max(entry.col));
        }
    }
    let contacts = ends.iter().map(|(first, last)| last.saturating_sub(*first));
    1 + stiffness.chain(contacts).max().unwrap_or(0)
}
