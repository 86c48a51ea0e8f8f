//! The page of a scene that was solved, or could not be solved.

use super::tables::{self, section};
use super::{Page, PictureStep, size, taken};
use crate::cases::Cases;
use crate::figures::history::place;
use crate::figures::{self, Said, on_page};
use crate::format::{InUnits, significant};
use crate::summary::{self, Resultant, load_groups, reason, weight};
use crate::svg::ReferenceLines;
use crate::svg::pictures::{Pictures, Shown, of_outcome};
use crate::table;
use masonry::analysis::outcome::{Frame, Outcome};
use masonry::data::verdict::Verdict;
use masonry::history;

/// The largest number of steps of a load history that have pictures on a page; longer histories have pictures of every
/// second step, every third step, and so on.
const FRAMES: usize = 40;

/// Returns whether a page shows a picture of the step at `position`, counted from zero, in a history of `steps` steps.
pub fn is_framed(position: usize, steps: usize) -> bool {
    let every = steps.div_ceil(FRAMES).max(1);
    (position + 1).is_multiple_of(every) || position == 0 || position + 1 == steps
}

/// Returns the page of an outcome, with a table of all cases if the outcome governs several. `frames` are the steps of
/// a load history that have pictures; the last solved step always has pictures.
pub fn solved(
    outcome: &Outcome,
    frames: &[Frame],
    reference: Option<&ReferenceLines>,
    cases: Option<&Cases>,
) -> String {
    let steps = steps(outcome, frames);
    let judgement = &outcome.judgement;
    Page {
        title: if outcome.title.is_empty() { "Untitled scene" } else { &outcome.title }.to_owned(),
        verdict: verdict(judgement.verdict),
        sentence: judgement.sentence.clone(),
        warnings: judgement.warnings.iter().cloned().chain(reason(outcome)).collect(),
        figures: figures(outcome),
        pictures: pictures(outcome, frames, &steps, reference),
        steps,
        tables: tables(outcome, cases),
        text: table::report(outcome),
    }
    .finish()
}

pub(super) fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stands => "stands",
        Verdict::Falls => "falls",
        Verdict::Undecided => "undecided",
    }
}

/// Lists the steps that have pictures: the last step that was solved, and the framed steps before it.
fn steps(outcome: &Outcome, frames: &[Frame]) -> Vec<PictureStep> {
    let records = outcome.history.iter().flat_map(|history| &history.records);
    let Some((last, record)) = records.enumerate().last() else { return Vec::new() };
    let step = |it: &history::HistoryStep, position| {
        let name = format!("{} {}", it.stage, place(it));
        PictureStep { name, position }
    };
    let earlier = frames.iter().take_while(|frame| frame.position < last);
    let earlier = earlier.map(|frame| step(&frame.step, frame.position));
    earlier.chain([step(&record.step, last)]).collect()
}

/// Returns the pictures of the steps, or of the outcome if there are no steps.
fn pictures(
    outcome: &Outcome,
    frames: &[Frame],
    steps: &[PictureStep],
    reference: Option<&ReferenceLines>,
) -> Vec<Pictures> {
    let title = &outcome.title;
    let mut titles: Vec<String> =
        steps.iter().map(|step| format!("{title}, {}", step.name)).collect();
    let last_title = titles.pop().unwrap_or_else(|| title.clone());
    let earlier = frames.iter().zip(&titles).map(|(frame, title)| Shown {
        title,
        model: &frame.model,
        state: &frame.state,
    });
    let last = outcome.state.iter().map(|state| Shown {
        title: &last_title,
        model: &outcome.model,
        state,
    });
    let shown: Vec<Shown<'_>> = match &outcome.state {
        Some(_) => earlier.chain(last).collect(),
        None => Vec::new(),
    };
    of_outcome(outcome, title, &shown, reference, true)
}

fn figures(outcome: &Outcome) -> Vec<Said> {
    let model = &outcome.model;
    let units = InUnits(model.units);
    let of_state = [figures::solved::state(outcome), figures::solved::checks(outcome)].concat();
    let mut list = on_page(&of_state);
    for (name, it) in [("loads", summary::loads(model)), ("self weight", weight(model))] {
        if it != Resultant::default() {
            let [fx, fy] = [it.force.x, it.force.y].map(|it| significant(units.force(it), 4));
            list.push((name, format!("({fx}, {fy}) {}", units.0.force_name())));
        }
    }
    list.push(("size", size(model)));
    if let Some(history) = &outcome.history {
        list.push(("steps solved", format!("{} of {}", history.records.len(), history.steps)));
    }
    let solve = &outcome.solve;
    list.push(("found by", format!("{} in {}", solve.route.name(), taken(&outcome.times))));
    if outcome.state.is_some() {
        list.push(("largest residual", significant(solve.residuals.worst(), 2)));
    }
    list
}

/// Returns the tables of the page of an outcome, as pieces of HTML one below the other.
pub fn tables(outcome: &Outcome, cases: Option<&Cases>) -> String {
    let model = &outcome.model;
    let mut list = cases.map_or_else(String::new, tables::cases);
    list += &tables::reactions("Reactions", model, &outcome.reactions);
    if let Some(history) = &outcome.history {
        let note = "Work and dissipated energy are those of the step.";
        list += &section("Steps", note, &figures::history::on_page(model, history).with_digits(4));
    }
    if let Some(rates) = &outcome.mechanism {
        list += &tables::hinges("Joints of the mechanism", model, rates);
    }
    if let Some(state) = &outcome.state {
        list += &tables::joints("Joints", model, &state.contacts);
    }
    let loads = figures::tables::loads(InUnits(model.units), &load_groups(model), false);
    list + &section("Loads", "", &loads.without("m").with_digits(4))
}
