//! How time and memory grow with the number of bricks.

use std::fmt::Write as _;

use masonry::report::svg::diagram::{Diagram, Look, Series, picture};

use crate::machine::machine_and_date;
use crate::row::Row;
use crate::walls::Case;

pub(crate) const CASES: [Case; 4] =
    [Case::Lean, Case::OpenBase, Case::Tilt(0.9), Case::Settlement(5)];
pub(crate) const SIZES: &str = "10,32,100";
pub(crate) const FRICTION: &str = "0.7";
pub(crate) const BRICKS: &str = "rigid,2x1";
/// Phases with less than this part of the time are not told.
const TOLD: f64 = 0.02;

/// One row per wall: times by phase, and memory.
pub(crate) fn table(rows: &[Row]) -> String {
    let mut table = String::from(
        "| case | mu | bricks | number | verdict | factorisations | time \\[s\\] | time / Cholesky | phases | memory \\[MB\\] |\n\
         |:--|--:|:--|--:|:--|--:|--:|--:|:--|--:|\n",
    );
    for row in rows {
        let memory = row.memory.map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
        let _ = writeln!(
            table,
            "| {} | {} | {} | {} | {} | {:.0} | {:.2} | {:.0} | {} | {memory} |",
            row.case,
            row.mu,
            row.bricks,
            row.number,
            row.verdict,
            row.factorisations(),
            row.seconds,
            row.seconds / row.yardstick,
            phases(row),
        );
    }
    table
}

/// Phases that take time, and their parts of it.
fn phases(row: &Row) -> String {
    let part = |seconds: f64| seconds / row.seconds;
    let told = row.phases.iter().filter(|it| part(it.seconds) >= TOLD);
    let told: Vec<String> =
        told.map(|it| format!("{} {:.0} %", it.phase, 100.0 * part(it.seconds))).collect();
    told.join(", ")
}

/// One row per case and bricks: the powers of the number of bricks with which time, memory and the time of one Cholesky
/// factorisation grow, by least squares.
pub(crate) fn exponents(rows: &[Row]) -> String {
    let mut table = String::from(
        "| case | mu | bricks | numbers | time | memory | one Cholesky factorisation |\n\
         |:--|--:|:--|:--|--:|--:|--:|\n",
    );
    for walls in families(rows) {
        let Some(Row { case, mu, bricks, .. }) = walls.first() else { continue };
        let numbers: Vec<String> = walls.iter().map(|row| row.number.to_string()).collect();
        let fitted = |of: fn(&Row) -> Option<f64>| {
            exponent(walls.iter().filter_map(|row| Some([row.number as f64, of(row)?])))
        };
        let _ = writeln!(
            table,
            "| {case} | {mu} | {bricks} | {} | {} | {} | {} |",
            numbers.join(", "),
            fitted(|row| Some(row.seconds)),
            fitted(|row| row.memory),
            fitted(|row| Some(row.yardstick)),
        );
    }
    table
}

/// Rows that differ by their size only.
fn families(rows: &[Row]) -> Vec<Vec<&Row>> {
    let mut families: Vec<Vec<&Row>> = Vec::new();
    for row in rows {
        match families.iter_mut().find(|it| it.iter().all(|other| other.is_alike(row))) {
            Some(family) => family.push(row),
            None => families.push(vec![row]),
        }
    }
    families
}

/// The slope of the logarithms.
fn exponent(points: impl Iterator<Item = [f64; 2]>) -> String {
    let points: Vec<[f64; 2]> = points.map(|point| point.map(f64::ln)).collect();
    let mean = |k: usize| points.iter().map(|it| it[k]).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let sum = |of: fn([f64; 2]) -> f64| points.iter().map(|p| of([p[0] - x, p[1] - y])).sum();
    let (square, product): (f64, f64) = (sum(|[x, _]| x * x), sum(|[x, y]| x * y));
    if square > 0.0 { format!("{:.2}", product / square) } else { "-".to_owned() }
}

/// Time against size, a line for each case, and one factorisation of the same walls in grey.
pub(crate) fn drawn(rows: &[Row]) -> Option<String> {
    let families = families(rows);
    let line = |(style, walls): (usize, &Vec<&Row>)| {
        let first = walls.first()?;
        let name = format!("{}, {}", first.case, first.bricks);
        let points = walls.iter().map(|row| [row.number as f64, row.seconds]).collect();
        let look = if first.bricks == "rigid" { Look::Hollow } else { Look::Full };
        Some(Series { name, style: style % CASES.len(), look, points })
    };
    let bound = |walls: &Vec<&Row>| {
        let bricks = &walls.first()?.bricks;
        let points = walls.iter().map(|row| [row.number as f64, row.yardstick]).collect();
        let name = format!("one Cholesky factorisation, {bricks}");
        Some(Series { name, style: 0, look: Look::Bound, points })
    };
    let is_first = |walls: &&Vec<&Row>| walls.first().is_some_and(|row| row.case == CASES[0]);
    let bounds = families.iter().filter(is_first).filter_map(bound);
    let series = families.iter().enumerate().filter_map(line).chain(bounds).collect();
    let axes = ["number of bricks [-]", "time [s]"].map(str::to_owned);
    let diagram = Diagram { title: String::new(), axes, least: None, series };
    let notes = [
        "Filled markers: elastic bricks of 2 x 1 elements; hollow ones: rigid bricks.".to_owned(),
        format!("Measured on {}.", machine_and_date()),
    ];
    picture("Time until the verdict, and the size of a wall", &[diagram], &notes)
}
