//! How time and memory grow with the number of bricks.

use std::fmt::Write as _;

use masonry_report::svg::diagram::{Diagram, Look, Series, picture};

use crate::machine::machine_and_date;
use crate::row::Row;
use crate::table::{cell, is_same, key, merged, mu};
use crate::walls::Case;

pub(crate) const CASES: [Case; 4] =
    [Case::Lean, Case::OpenBase, Case::Tilt(0.9), Case::Settlement(5)];
pub(crate) const SIZES: &str = "10,32,100";
pub(crate) const FRICTION: &str = "0.7";
pub(crate) const BRICKS: &str = "rigid,2x1 hard";
/// Phases with less than this part of the time are not told.
const TOLD: f64 = 0.02;

/// Lines of walls: times by phase, and memory.
pub(crate) struct Sizes {
    lines: Vec<String>,
}

impl Sizes {
    /// Of computed walls, and of those of the table `before` that were not.
    pub(crate) fn new(computed: &[Row], before: &str) -> Self {
        let lines = computed.iter().map(line).collect();
        let mut lines = merged(lines, before, |a, b| is_same(a, b) && number(a) == number(b));
        let place = |line: &str| {
            let [case, _, bricks] = key(line);
            let case = CASES.iter().position(|it| it.to_string() == case);
            (BRICKS.split(',').position(|it| it == bricks), case)
        };
        lines.sort_by(|a, b| {
            let by_size = number(a).cmp(&number(b));
            by_size.then(mu(a).total_cmp(&mu(b))).then_with(|| place(a).cmp(&place(b)))
        });
        Self { lines }
    }

    /// All lines.
    pub(crate) fn whole(&self) -> String {
        format!(
            "| case | mu | bricks | number | verdict | factorisations | time \\[s\\] | time / Cholesky | memory \\[MB\\] | phases |\n\
             |:--|--:|:--|--:|:--|--:|--:|--:|--:|:--|\n{}\n",
            self.lines.join("\n")
        )
    }

    /// One row per case and bricks: the powers of the number of bricks with which time, memory and the time of one Cholesky
    /// factorisation grow, by least squares.
    pub(crate) fn exponents(&self) -> String {
        let mut table = String::from(
            "| case | mu | bricks | numbers | time | memory | one Cholesky factorisation |\n\
             |:--|--:|:--|:--|--:|--:|--:|\n",
        );
        for walls in self.families() {
            let numbers: Vec<String> = walls.iter().map(|it| number(it).to_string()).collect();
            let fitted = |of: fn(&str) -> Option<f64>| {
                exponent(walls.iter().filter_map(|it| Some([number(it) as f64, of(it)?])))
            };
            let [case, mu, bricks] = key(walls[0]);
            let (time, memory, bound) = (fitted(seconds), fitted(memory), fitted(yardstick));
            let numbers = numbers.join(", ");
            let _ = writeln!(
                table,
                "| {case} | {mu} | {bricks} | {numbers} | {time} | {memory} | {bound} |"
            );
        }
        table
    }

    /// Lines that differ by the size only.
    fn families(&self) -> Vec<Vec<&str>> {
        let mut families: Vec<Vec<&str>> = Vec::new();
        for line in &self.lines {
            match families.iter_mut().find(|it| is_same(it[0], line)) {
                Some(family) => family.push(line),
                None => families.push(vec![line]),
            }
        }
        families
    }

    /// Time against size, a line for each case, and one factorisation of the same walls in grey.
    pub(crate) fn drawn(&self) -> Option<String> {
        let families = self.families();
        let points = |walls: &[&str], of: fn(&str) -> Option<f64>| {
            walls.iter().filter_map(|it| Some([number(it) as f64, of(it)?])).collect()
        };
        let line = |(style, walls): (usize, &Vec<&str>)| {
            let [case, _, bricks] = key(walls[0]);
            let look = if bricks == "rigid" { Look::Hollow } else { Look::Full };
            let (name, style) = (format!("{case}, {bricks}"), style % CASES.len());
            Series { name, style, look, points: points(walls, seconds) }
        };
        let bound = |(style, bricks): (usize, &str)| {
            let of_bricks = families.iter().filter(|walls| key(walls[0])[2] == bricks);
            let walls = of_bricks.max_by_key(|walls| walls.len())?;
            let name = format!("one Cholesky factorisation, {bricks}");
            Some(Series { name, style, look: Look::Bound, points: points(walls, yardstick) })
        };
        let bounds = BRICKS.split(',').enumerate().filter_map(bound);
        let series = families.iter().enumerate().map(line).chain(bounds).collect();
        let axes = ["number of bricks [-]", "time [s]"].map(str::to_owned);
        let diagram = Diagram { axes, series, ..Diagram::default() };
        let notes = [
            "Filled markers: elastic bricks of 2 x 1 elements; hollow ones: rigid bricks."
                .to_owned(),
            format!("Measured on {}.", machine_and_date()),
        ];
        picture("Time until the verdict, and the size of a wall", &[diagram], &notes)
    }
}

fn line(row: &Row) -> String {
    let memory = row.memory.map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
    format!(
        "| {} | {} | {} | {} | {} | {:.0} | {} | {} | {memory} | {} |",
        row.case,
        row.mu,
        row.bricks,
        row.number,
        row.verdict,
        row.factorisations(),
        three_digits(row.seconds),
        three_digits(row.seconds / row.yardstick),
        phases(row),
    )
}

/// A positive number with at least three digits.
fn three_digits(value: f64) -> String {
    let (mut decimals, mut scaled) = (0, value);
    while scaled < 100.0 && decimals < 9 {
        scaled *= 10.0;
        decimals += 1;
    }
    format!("{value:.decimals$}")
}

/// Phases that take time, and their parts of it.
fn phases(row: &Row) -> String {
    let part = |seconds: f64| seconds / row.seconds;
    let told = row.phases.iter().filter(|it| part(it.seconds) >= TOLD);
    let told: Vec<String> =
        told.map(|it| format!("{} {:.0} %", it.phase, 100.0 * part(it.seconds))).collect();
    told.join(", ")
}

fn number(line: &str) -> usize {
    cell(line, 4).parse().expect("a number of bricks")
}

fn seconds(line: &str) -> Option<f64> {
    cell(line, 7).parse().ok()
}

fn yardstick(line: &str) -> Option<f64> {
    Some(seconds(line)? / cell(line, 8).parse::<f64>().ok()?)
}

fn memory(line: &str) -> Option<f64> {
    cell(line, 9).parse().ok()
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
