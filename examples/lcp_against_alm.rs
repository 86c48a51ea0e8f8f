//! The paper's comparison (section 4): the complementarity problem by pivoting against the augmented Lagrangian
//! method, and beside both the interior-point method, on dry panels and on panels in mortar, whose films
//! are whole strips between bricks of one element.
//!
//! The paper found for the square panel a problem of order about 1600, pivoting at less than a tenth of the
//! time of the augmented Lagrangian method, and 15 to 30 iterations of that until the unbalanced force was 1e-4.
//!
//! All times are from the model of a scene to displacements, in this run, assembly included.

#[path = "support/bandwidth.rs"]
mod bandwidth;

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use bandwidth::semi_bandwidth;
use lcp::Status;
use masonry::analysis::solve::solve;
use masonry::model::Model;
use masonry::paper::alm::{AlmIteration, AlmSettings, MortaredWall};
use masonry::scene::{Route, Scene};

const PANELS: [&str; 4] = [
    "panel_square",
    "panel_rectangular",
    "panel_square_mortar_open",
    "panel_rectangular_mortar_open",
];
const TOLERANCE: f64 = 1e-8;

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "{:<30} {:<24} {:>6} {:>10} {:>10} {:>8} {:>8}",
        "panel", "method", "order", "memory/MB", "iterations", "time/s", "LCP/ALM"
    );
    let curves = PANELS.into_iter().map(compare).collect::<Result<Vec<_>, _>>()?;
    println!(
        "memory: n x 2n numbers for pivots, n x semi-bandwidth for the others, as the paper counts"
    );
    println!("the paper: order about 1600, LCP/ALM < 0.1, 15 to 30 iterations to 1e-4\n");

    println!("unbalanced force of ALM, relative to the largest load");
    println!("{:<10} {}", "iteration", PANELS.map(|name| format!("{name:>30}")).concat());
    for number in [1, 10, 20, 30, 50, 75, 100, 150, 200, 250, 300] {
        let at = curves.iter().map(|curve| match curve.get(number - 1) {
            Some(it) => format!("{:>30.1e}", it.unbalance),
            None => format!("{:>30}", "solved"),
        });
        println!("{number:<10} {}", at.collect::<String>());
    }
    Ok(())
}

/// The lines of one panel; the iterations of the augmented Lagrangian method.
fn compare(name: &str) -> Result<Vec<AlmIteration>, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name);
    let scene = Scene::read(&path.with_extension("toml"))?.tolerance(TOLERANCE);
    let line = |method: &str, order: usize, numbers: usize, iterations: usize, seconds, ratio| {
        let memory = 8.0 * numbers as f64 / 1e6;
        println!(
            "{name:<30} {method:<24} {order:>6} {memory:>10.1} {iterations:>10} {seconds:>8.3} {ratio:>8}"
        );
    };

    let model = Model::from_scene(&scene)?;
    let began = Instant::now();
    let wall = MortaredWall::new(&model)?;
    let mut seconds = Vec::new();
    let settings = AlmSettings { tolerance: TOLERANCE, ..AlmSettings::default() };
    let alm = wall.solve(&settings, &mut |_| {
        seconds.push(began.elapsed().as_secs_f64());
        ControlFlow::Continue(())
    })?;
    if alm.status != Status::Solved {
        return Err(format!("{name}: ALM ends with {}", alm.status).into());
    }
    let bonded = wall.with_parts(&wall.bonded())?;
    let n = bonded.displacements();
    for unbalance in [1e-4, TOLERANCE] {
        let first = alm.convergence.iter().take_while(|it| it.unbalance > unbalance).count();
        let method = format!("ALM to unbalance {unbalance:.0e}");
        line(&method, n, n * semi_bandwidth(&bonded), first + 1, seconds[first], String::new());
    }
    let last = seconds.len();
    line(
        "ALM to forces 1e-8",
        n,
        n * semi_bandwidth(&bonded),
        last,
        seconds[last - 1],
        String::new(),
    );

    for (method, route) in [("pivots (Lemke)", Route::Lemke), ("interior points", Route::Interior)]
    {
        let outcome = solve(&scene.clone().route(route))?;
        let info = &outcome.solve;
        let phases = outcome.times.iter().filter(|it| it.phase != "model");
        let time: f64 = phases.map(|it| it.seconds).sum();
        let ratio = match info.status {
            Status::Solved => format!("{:.2}", time / seconds[last - 1]),
            _ => "no answer".to_owned(),
        };
        let (numbers, steps) = if route == Route::Lemke {
            (2 * info.order * info.order, info.pivots)
        } else {
            (n * semi_bandwidth(&bonded), info.iterations)
        };
        line(method, info.order, numbers, steps, time, ratio);
    }
    Ok(alm.convergence)
}
