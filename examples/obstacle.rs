//! A membrane over hills, on nested grids: each is solved from the contact region of the one before.
//!
//! `cargo run --release --example obstacle -- 400` takes 400 by 400 points (200 without an argument), prints
//! what every grid took, and writes a picture into `target/obstacle/`.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use lcp::{SemismoothNewton, SemismoothNewtonSettings, Solver, WarmStart};
use lcp_problems::families::{Ground, Obstacle};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let side: usize = std::env::args().nth(1).map_or(Ok(200), |side| side.parse())?;
    let halves = std::iter::successors(Some(side), |side| Some(side / 2));
    let mut sides: Vec<usize> = halves.take_while(|half| *half >= 25 || *half == side).collect();
    sides.reverse();

    println!("       grid  steps  factorisations  residual  contact  time [s]");
    let mut solved: Option<(Obstacle, Vec<f64>)> = None;
    for side in sides {
        let began = Instant::now();
        let grid = Obstacle::new(side, side, Ground::Hills { count: 3 });
        let start = match &solved {
            Some((coarse, gap)) => grid.refined_start(coarse, gap)?,
            None => WarmStart::None,
        };
        let settings = SemismoothNewtonSettings { start, ..SemismoothNewtonSettings::default() };
        let solution = SemismoothNewton::new(settings).solve(&grid.problem())?;
        let contact = solution.t.iter().filter(|gap| **gap <= 0.0).count();
        println!(
            "{:>11} {:>6} {:>15} {:>9.0e} {:>6.1} % {:>9.3}   {}",
            format!("{side} x {side}"),
            solution.info.iterations,
            solution.info.factorisations,
            solution.residuals.worst(),
            100.0 * contact as f64 / grid.order() as f64,
            began.elapsed().as_secs_f64(),
            solution.status,
        );
        solved = Some((grid, solution.t));
    }
    if let Some((grid, gap)) = solved {
        let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/obstacle");
        std::fs::create_dir_all(&directory)?;
        std::fs::write(directory.join("obstacle.svg"), picture(&grid, &gap))?;
        println!("wrote target/obstacle/obstacle.svg");
    }
    Ok(())
}

/// The gap in bands of equal height, darker where it is wider; the contact region in red. At most so many
/// cells on a side are drawn.
fn picture(grid: &Obstacle, gap: &[f64]) -> String {
    const CELLS: usize = 250;
    const COLOURS: [&str; 10] = [
        "#c0392b", "#eef4fa", "#dbe8f4", "#c3d9ec", "#a6c8e2", "#85b3d6", "#639dc9", "#4585b8",
        "#2d6ca2", "#1c5387",
    ];
    let widest = gap.iter().fold(0.0_f64, |max, gap| max.max(*gap));
    // The contact region is a band of its own.
    let band = |gap: f64| {
        let inner = (1..COLOURS.len() - 1).filter(|k| gap > *k as f64 / 9.0 * widest).count();
        if gap > 0.0 { 1 + inner } else { 0 }
    };
    let stride = grid.columns().div_ceil(CELLS);
    let (columns, rows) = (grid.columns() / stride, grid.rows() / stride);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {columns} {rows}\" width=\"600\" \
         height=\"600\" shape-rendering=\"crispEdges\">\n"
    );
    for row in 0..rows {
        let colour = |column: usize| band(gap[row * stride * grid.columns() + column * stride]);
        let mut first = 0;
        for column in 1..=columns {
            if column == columns || colour(column) != colour(first) {
                let (width, fill) = (column - first, COLOURS[colour(first)]);
                let _ = writeln!(
                    svg,
                    "<rect x=\"{first}\" y=\"{row}\" width=\"{width}\" height=\"1\" fill=\"{fill}\"/>"
                );
                first = column;
            }
        }
    }
    svg + "</svg>\n"
}
