//! Settlements in different numbers of steps: what a step costs, whether it keeps the law, and how far the answers differ.

use std::fmt::Write;
use std::ops::ControlFlow;

use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{Event, Run};
use masonry::history::SecondLoading;

use crate::table::{key, merged, mu};
use crate::walls::{Case, Wall};

const HEAD: &str = "| bricks | mu | steps | of these keep the law | least P / cap | factorisations, mean of steps | \
     displacements differ \\[%\\] | reported of displacements, largest \\[%\\] |\n|:--|--:|--:|--:|--:|--:|--:|--:|\n";

/// Computed rows, and those of the table `before` that are of other walls or numbers of steps.
pub(crate) fn table(computed: &str, before: &str) -> String {
    let same = |a: &str, b: &str| key(a) == key(b);
    let mut lines = merged(computed.lines().map(str::to_owned).collect(), before, same);
    let number = |text: &str| -> Option<u32> { text.split(' ').next()?.parse().ok() };
    lines.sort_by(|a, b| {
        let place = |line: &str| key(line).map(str::to_owned);
        let ([one, _, of_one], [other, _, of_other]) = (place(a), place(b));
        let bricks = number(&one).cmp(&number(&other)).then_with(|| one.cmp(&other));
        bricks
            .then_with(|| mu(a).total_cmp(&mu(b)))
            .then_with(|| number(&of_one).cmp(&number(&of_other)))
    });
    format!("{HEAD}{}\n", lines.join("\n"))
}

/// The rows of a wall, of which the last has the most steps: differences are from its displacements, as root mean squares.
/// A history with fewer steps says itself how far two loadings differ.
pub(crate) fn rows(wall: &Wall, bricks: &str, counts: &[u32]) -> String {
    let last = counts.len() - 1;
    let runs = counts.iter().enumerate().map(|(place, &steps)| run(wall, steps, place < last));
    let runs: Vec<Outcome> = runs.collect();
    let mut text = String::new();
    for run in &runs {
        let history = run.history.as_ref().expect("a scene with stages");
        let records = &history.records;
        let power = records.iter().filter_map(|record| record.friction_power).fold(1.0, f64::min);
        let factorisations: usize = records.iter().map(|record| record.factorisations).sum();
        let reported = match history.second_loading {
            Some(SecondLoading::Ended(spread)) => {
                format!("{:.1}, {:.1}", 100.0 * spread.displacements, 100.0 * spread.largest())
            }
            Some(_) => "not known".to_owned(),
            None => "-".to_owned(),
        };
        writeln!(
            text,
            "| {} {bricks} | {} | {} of {} | {} | {power:.4} | {} | {:.1} | {reported} |",
            run.model.blocks.len(),
            wall.mu,
            records.len(),
            history.steps,
            records.len() - history.steps_against_law(),
            factorisations / records.len().max(1),
            100.0 * difference(&displacements(run), &displacements(&runs[last])),
        )
        .expect("text is written");
    }
    text
}

fn run(wall: &Wall, steps: u32, is_compared: bool) -> Outcome {
    let go_on = &mut |_: Event| ControlFlow::Continue(());
    let scene = wall.scene(Case::Settlement(steps), 0.0);
    let mut run = Run::new(&scene, go_on).expect("a sound scene");
    while run.advance(go_on).expect("sound data") {}
    if is_compared {
        run.compare(&scene, go_on).expect("sound data");
    }
    run.finish()
}

fn displacements(run: &Outcome) -> Vec<f64> {
    let state = run.state.iter();
    state.flat_map(|it| it.displacements.iter().flatten().flat_map(|u| [u.x, u.y])).collect()
}

/// The root of the squares of all differences, relative to that of the reference.
fn difference(found: &[f64], reference: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>().sqrt();
    let apart = norm(&mut found.iter().zip(reference).map(|(a, b)| a - b));
    apart / norm(&mut reference.iter().copied())
}
