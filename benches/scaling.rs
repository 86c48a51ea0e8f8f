//! Verdicts on walls that are hard to decide, and what they cost: friction at and near critical values, tilts near the
//! limit, open bases, settlements; rigid and elastic bricks.
//!
//! `cargo bench --bench scaling` prints a table of walls of about a thousand bricks; with `-- --write` it also puts it into
//! `docs/data/scaling.md`, and a summary into `docs/scaling.md`. `-- --courses 100` takes other walls, of as many bricks in a course, and `--mu 0.5,1`, `--bricks
//! rigid,2x1` and `--case settlement` a part of the table. All is on one thread.

mod common;
#[path = "common/machine.rs"]
mod machine;
#[path = "common/sparse.rs"]
mod sparse;
#[path = "scaling/walls.rs"]
mod walls;

use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::time::Instant;

use lcp::Way;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{Event, Run};
use masonry::method::forms::Sparse;
use masonry::model::Model;
use masonry::system::System;
use masonry::{Evidence, Verdict};
use walls::{Case, Wall};

const FRICTION: &str = "0.3,0.5,0.6,0.7,0.9999,1,1.0001,1.3";
const BRICKS: &str = "rigid,1x1,2x1";
const CASES: [Case; 10] = [
    Case::Lean,
    Case::OpenBase,
    Case::Tilt(0.5),
    Case::Tilt(0.9),
    Case::Tilt(0.99),
    Case::Tilt(1.01),
    Case::Tilt(1.3),
    Case::Settlement(1),
    Case::Settlement(5),
    Case::Settlement(20),
];

fn main() {
    if !common::is_bench() {
        return;
    }
    let courses = option("--courses").map_or(32, |it| it.parse().expect("a number of courses"));
    let (friction, bricks) = (option("--mu"), option("--bricks"));
    let case = option("--case").unwrap_or_default();
    let mut rows = Vec::new();
    let mut table = String::from(
        "| case | mu | bricks | verdict | evidence | steps | found by law, smooth friction, motion | \
         factorisations, mean of steps | most | time \\[s\\] | time / Cholesky | memory \\[MB\\] |\n\
         |:--|--:|:--|:--|:--|--:|:--|--:|--:|--:|--:|--:|\n",
    );
    print!("{table}");
    for mu in friction.as_deref().unwrap_or(FRICTION).split(',') {
        let mu = mu.parse().expect("a coefficient of friction");
        let cases = || CASES.into_iter().filter(|it| it.to_string().contains(&case));
        let is_tilted = cases().any(|it| matches!(it, Case::Tilt(_)));
        let rigid = Wall { courses, mu, mesh: None };
        let limit = if is_tilted { rigid.largest_tilt() } else { 0.0 };
        for bricks in bricks.as_deref().unwrap_or(BRICKS).split(',') {
            let wall = Wall { courses, mu, mesh: mesh(bricks) };
            let yardstick = yardstick(&wall);
            for case in cases() {
                let row = Row::of(&wall, bricks, (case, limit), yardstick);
                println!("{}", row.line);
                let _ = writeln!(table, "{}", row.line);
                rows.push(row);
            }
        }
    }
    common::write_if_asked("docs/scaling.md", "scaling", &summary(&rows));
    let table = table + "\n" + &machine::machine();
    common::write_if_asked("docs/data/scaling.md", "scaling", &table);
}

/// One wall in one case.
struct Row {
    case: Case,
    mu: f64,
    bricks: String,
    /// Of verdict and evidence one letter.
    letter: char,
    factorisations: f64,
    line: String,
}

/// Friction along, walls and cases down.
fn summary(rows: &[Row]) -> String {
    let mut friction: Vec<f64> = rows.iter().map(|row| row.mu).collect();
    friction.sort_by(f64::total_cmp);
    friction.dedup_by(|a, b| is_same(*a, *b));
    let first = |row: &&Row| is_same(row.mu, rows[0].mu);
    let walls = rows.iter().filter(first).map(|row| (row.case, &row.bricks[..]));
    let names: Vec<String> = friction.iter().map(|mu| format!("mu {mu}")).collect();
    let mut table = format!(
        "| case | bricks | {} |\n|:--|:--|{}\n",
        names.join(" | "),
        "--:|".repeat(friction.len())
    );
    for (case, bricks) in walls {
        let _ = write!(table, "| {case} | {bricks} |");
        for mu in &friction {
            let same =
                |row: &&Row| row.case == case && row.bricks == bricks && is_same(row.mu, *mu);
            let cell = rows.iter().find(same);
            let cell = cell.map(|row| format!("{} {:.0}", row.letter, row.factorisations));
            let _ = write!(table, " {} |", cell.unwrap_or_default());
        }
        table.push('\n');
    }
    table
}

fn is_same(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}

/// What follows an option of the command.
fn option(name: &str) -> Option<String> {
    std::env::args().skip_while(|it| it != name).nth(1)
}

fn mesh(bricks: &str) -> Option<[u32; 2]> {
    let (nx, ny) = bricks.split_once('x')?;
    Some([nx, ny].map(|it| it.parse().expect("elements of a brick")))
}

/// Seconds of one Cholesky factorisation, symbolic and numeric, of a matrix with the pattern of the steps.
fn yardstick(wall: &Wall) -> f64 {
    let model = Model::from_scene(&wall.scene(Case::Lean, 0.0)).expect("a sound scene");
    let system = System::new(&model).expect("sound blocks");
    let problem = Sparse::new(&system).expect("finite data").problem;
    let matrix = sparse::condensed(&problem);
    let (symbolic, numeric) =
        sparse::fastest(3, |(s, n): &(f64, f64)| s + n, || sparse::cholesky(&matrix));
    symbolic + numeric
}

impl Row {
    fn of(wall: &Wall, bricks: &str, (case, limit): (Case, f64), yardstick: f64) -> Self {
        sparse::forget_peak();
        let began = Instant::now();
        let mut iterations = 0;
        let mut observer = |event: Event| {
            iterations += usize::from(matches!(event, Event::Iteration { .. }));
            ControlFlow::Continue(())
        };
        let mut run = Run::new(&wall.scene(case, limit), &mut observer).expect("a sound scene");
        while run.advance(&mut observer).expect("sound data") {}
        let outcome = run.finish();
        let seconds = began.elapsed().as_secs_f64();
        let memory = sparse::peak().map_or_else(|| "-".to_owned(), |it| format!("{it:.0}"));
        let (verdict, evidence) = (outcome.judgement.verdict, outcome.judgement.evidence);
        let (steps, ways, counts) = of_steps(&outcome, iterations);
        let mean = counts.iter().sum::<usize>() as f64 / counts.len().max(1) as f64;
        let most = counts.iter().max().copied().unwrap_or(0);
        let letter = match (verdict, evidence) {
            (Verdict::Stands, _) => 's',
            (Verdict::Falls, Evidence::Motion) => 'f',
            (Verdict::Falls, _) => 'F',
            (Verdict::Undecided, _) => '?',
        };
        let line = format!(
            "| {case} | {} | {bricks} | {verdict} | {evidence:?} | {steps} | {ways} | {mean:.0} | {most} | {seconds:.1} | \
             {:.0} | {memory} |",
            wall.mu,
            seconds / yardstick
        );
        let (mu, bricks) = (wall.mu, bricks.to_owned());
        Self { case, mu, bricks, letter, factorisations: mean, line }
    }
}

/// Steps solved of all, how many were found in which way, and the factorisations of each; of a single step the steps of
/// all methods that were tried.
fn of_steps(outcome: &Outcome, iterations: usize) -> (String, String, Vec<usize>) {
    let Some(history) = &outcome.history else {
        return ("1".to_owned(), ways(&[outcome.solve.way]), vec![iterations]);
    };
    let all: Vec<Way> = history.records.iter().map(|record| record.way).collect();
    let counts = history.records.iter().map(|record| record.factorisations).collect();
    (format!("{} of {}", history.records.len(), history.steps), ways(&all), counts)
}

fn ways(all: &[Way]) -> String {
    let count = |way| all.iter().filter(|it| **it == way).count();
    let [law, smooth, motion] = [Way::Law, Way::SmoothFriction, Way::Motion].map(count);
    format!("{law}, {smooth}, {motion}")
}
