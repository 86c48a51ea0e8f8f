//! The page of a scene that was solved, or was not.

use super::tables::{self, section};
use super::{Choice, Page, Step, size};
use crate::analysis::outcome::{Frame, Outcome};
use crate::data::verdict::Verdict;
use crate::report::figures::history::place;
use crate::report::figures::{self, Said, on_page};
use crate::report::format::{InUnits, significant};
use crate::report::summary::{self, Resultant, load_groups, reason, weight};
use crate::report::svg::pictures::{Pictures, Shown, pictures};
use crate::report::svg::{self, ReferenceLines};
use crate::report::table;

/// The files of pictures, their keys and switches in the order of a page.
const SHOWN: [(&str, &str, &str); 4] = [
    ("forces.svg", "forces", "Forces"),
    ("principal_stresses.svg", "stresses", "Stresses"),
    ("cracks.svg", "cracks", "Cracks"),
    ("deformed.svg", "deformed", "Deformed"),
];
/// So many steps of a load history have pictures; of more, every second, third and so on.
const FRAMES: usize = 40;

/// Whether a page has pictures of a step, counted from zero, of so many steps.
pub fn is_framed(position: usize, steps: usize) -> bool {
    let every = steps.div_ceil(FRAMES).max(1);
    (position + 1).is_multiple_of(every) || position == 0 || position + 1 == steps
}

/// The page of an outcome. Of a load history, `frames` are the steps that have pictures; the last one that was solved
/// has them always.
pub fn solved(outcome: &Outcome, frames: &[Frame], reference: Option<&ReferenceLines>) -> String {
    let model = &outcome.model;
    let (steps, pictures) = pictures_of(outcome, frames, reference);
    let mut warnings = outcome.judgement.warnings.clone();
    warnings.extend(reason(outcome));
    let scene = if outcome.title.is_empty() { "Untitled scene" } else { &outcome.title };
    let curves = outcome
        .history
        .as_ref()
        .and_then(|history| svg::curves(&outcome.title, model, history, true));
    Page {
        title: scene.to_owned(),
        verdict: verdict(outcome.judgement.verdict),
        sentence: outcome.judgement.sentence.clone(),
        warnings,
        figures: figures(outcome),
        pictures,
        steps,
        curves,
        tables: tables_of(outcome),
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

fn pictures_of(
    outcome: &Outcome,
    frames: &[Frame],
    reference: Option<&ReferenceLines>,
) -> (Vec<Step>, Vec<Choice>) {
    let model = &outcome.model;
    let mut choices = Vec::new();
    let (steps, titles) = steps(outcome, frames);
    if let Some(state) = &outcome.state {
        let last = Shown { title: titles.last().map_or("", String::as_str), model, state };
        let earlier = frames.iter().take(steps.len().saturating_sub(1)).zip(&titles);
        let mut shown: Vec<Shown<'_>> = earlier
            .map(|(frame, title)| Shown { title, model: &frame.model, state: &frame.state })
            .collect();
        shown.push(last);
        let mut list = pictures(&shown, reference, true);
        for (file, key, name) in SHOWN {
            let of_kind = list.extract_if(.., |it: &mut Pictures| it.file == file);
            choices.extend(of_kind.map(|it| Choice { key, name, pictures: it.pictures }));
        }
    }
    if let Some(rates) = &outcome.mechanism {
        let picture = svg::mechanism_on_page(&outcome.title, model, rates);
        choices.push(Choice::one("mechanism", "Mechanism", picture));
    }
    choices.push(Choice::one("scene", "Scene", svg::scene(&outcome.title, model)));
    (steps, choices)
}

/// The steps that have pictures, and the titles of these; the last is that of the outcome.
fn steps(outcome: &Outcome, frames: &[Frame]) -> (Vec<Step>, Vec<String>) {
    let Some(last) = outcome.history.as_ref().and_then(|history| history.records.last()) else {
        return (Vec::new(), vec![outcome.title.clone()]);
    };
    let position = outcome.history.as_ref().map_or(0, |history| history.records.len() - 1);
    let name = |step: &crate::history::Step| format!("{} {}", step.stage, place(step));
    let earlier = frames.iter().take_while(|frame| frame.position < position);
    let steps: Vec<Step> = earlier
        .map(|frame| Step { name: name(&frame.step), position: frame.position })
        .chain([Step { name: name(&last.step), position }])
        .collect();
    let titles = steps.iter().map(|step| format!("{}, {}", outcome.title, step.name)).collect();
    (steps, titles)
}

fn figures(outcome: &Outcome) -> Vec<Said> {
    let model = &outcome.model;
    let units = InUnits(model.units);
    let of_state = [figures::solved::state(outcome), figures::solved::checks(outcome)].concat();
    let mut list = on_page(&of_state);
    let force = |it: Resultant| {
        let [fx, fy] = [it.force.x, it.force.y].map(|it| significant(units.force(it), 4));
        format!("({fx}, {fy}) {}", units.0.force_name())
    };
    let loads = summary::loads(model);
    for (name, it) in [("loads", loads), ("self weight", weight(model))] {
        if it != Resultant::default() {
            list.push((name, force(it)));
        }
    }
    list.push(("size", size(model)));
    if let Some(history) = &outcome.history {
        list.push(("steps solved", format!("{} of {}", history.records.len(), history.steps)));
    }
    let solve = &outcome.solve;
    let seconds: f64 = outcome.times.iter().map(|it| it.seconds).sum();
    list.push(("found by", format!("{} in {} s", solve.route.name(), significant(seconds, 2))));
    if outcome.state.is_some() {
        list.push(("largest residual", significant(solve.residuals.worst(), 2)));
    }
    list
}

fn tables_of(outcome: &Outcome) -> String {
    let model = &outcome.model;
    let mut list = tables::reactions("Reactions", model, &outcome.reactions);
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
