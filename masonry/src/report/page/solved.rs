//! The page of a scene that was solved, or was not.

use super::tables::{self, Cell, Table};
use super::{Choice, Page, Step, size};
use crate::analysis::outcome::{Frame, Outcome};
use crate::data::state::State;
use crate::data::verdict::Verdict;
use crate::history::History;
use crate::report::format::{InUnits, block_name, significant, stress_text};
use crate::report::hinges::yielding;
use crate::report::joints;
use crate::report::summary::{
    self, Resultant, extreme_stresses, largest_displacement, reason, weight,
};
use crate::report::svg::pictures::{Pictures, Shown, pictures};
use crate::report::svg::{self, ReferenceLines};
use crate::report::table;

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
        for Pictures { file, pictures } in pictures(&shown, reference, true) {
            let key = file.trim_end_matches(".svg");
            let (place, key, name) = match key {
                "forces" => (0, "forces", "Forces"),
                "principal_stresses" => (1, "stresses", "Stresses"),
                "cracks" => (2, "cracks", "Cracks"),
                _ => (3, "deformed", "Deformed"),
            };
            let choice = Choice { key: key.to_owned(), name: name.to_owned(), pictures };
            choices.push((place, choice));
        }
        choices.sort_by_key(|(place, _)| *place);
    }
    let mut choices: Vec<Choice> = choices.into_iter().map(|(_, choice)| choice).collect();
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
    let name = |step: &crate::history::Step| format!("{} {}/{}", step.stage, step.number, step.of);
    let earlier = frames.iter().take_while(|frame| frame.position < position);
    let steps: Vec<Step> = earlier
        .map(|frame| Step { name: name(&frame.step), position: frame.position })
        .chain([Step { name: name(&last.step), position }])
        .collect();
    let titles = steps.iter().map(|step| format!("{}, {}", outcome.title, step.name)).collect();
    (steps, titles)
}

fn figures(outcome: &Outcome) -> Vec<(String, String)> {
    let model = &outcome.model;
    let units = InUnits(model.units);
    let mut list: Vec<(&str, String)> = Vec::new();
    if let Some(state) = &outcome.state {
        list.extend(figures_of_state(outcome, state));
    }
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
    list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn figures_of_state(outcome: &Outcome, state: &State) -> Vec<(&'static str, String)> {
    let model = &outcome.model;
    let mut list = Vec::new();
    if let Some(it) = largest_displacement(model, state).filter(|it| it.value != 0.0) {
        let (value, block) = (significant(1e3 * it.value, 4), block_name(model, it.block));
        let text = format!("u_{} = {value}\u{a0}mm, {block}", it.component);
        list.push(("largest displacement", text));
    }
    let openings = joints::openings(model, &state.contacts);
    let widest = openings.iter().map(|it| it.widest).fold(0.0, f64::max);
    let slip = openings.iter().map(|it| it.slip).fold(0.0, f64::max);
    for (name, value) in [("widest crack", widest), ("largest slip", slip)] {
        if value > 0.0 {
            list.push((name, format!("{}\u{a0}mm", significant(1e3 * value, 3))));
        }
    }
    let (compression, tension) = extreme_stresses(state);
    for (name, it) in [("largest compression", compression), ("largest tension", tension)] {
        if let Some(it) = it {
            let value = stress_text(it.value.abs());
            list.push((name, format!("{value}, {}", block_name(model, it.block))));
        }
    }
    let forces = joints::forces(model, &state.contacts);
    let most = forces.iter().filter_map(|it| it.utilisation).fold(0.0, f64::max);
    if most > 0.0 {
        list.push(("friction used at most", format!("{} %", significant(100.0 * most, 3))));
    }
    if let Some(checks) = &outcome.checks {
        let counts = format!("{} open, {} stick, {} slip", checks.open, checks.stick, checks.slip);
        list.push(("contact points", counts));
    }
    list
}

fn tables_of(outcome: &Outcome) -> Vec<Table> {
    let model = &outcome.model;
    let units = InUnits(model.units);
    let mut list = Vec::new();
    list.extend(tables::reactions("Reactions", &outcome.reactions, units));
    list.extend(outcome.history.as_ref().and_then(|history| steps_table(history, units)));
    list.extend(outcome.mechanism.as_ref().and_then(|rates| {
        tables::yielding("Joints of the mechanism", model, &yielding(model, rates))
    }));
    if let Some(state) = &outcome.state {
        list.extend(tables::joints("Joints", model, &state.contacts));
    }
    list.extend(loads_table(outcome, units));
    list
}

fn loads_table(outcome: &Outcome, units: InUnits) -> Option<Table> {
    let force = units.0.force_name();
    let heads = ["load", "group", "factor", &format!("fx [{force}]"), &format!("fy [{force}]")];
    let mut table = Table::new("Loads", &heads);
    for group in summary::load_groups(&outcome.model) {
        for (load, sum) in group.loads {
            table.row(vec![
                Cell::words(&load.name),
                Cell::words(group.name),
                Cell::number(load.factor, 4),
                Cell::number(units.force(sum.force.x), 4),
                Cell::number(units.force(sum.force.y), 4),
            ]);
        }
    }
    table.if_any()
}

fn steps_table(history: &History, units: InUnits) -> Option<Table> {
    let (length, energy) = (units.0.length_name(), units.0.energy_name());
    let heads = [
        "number",
        "stage",
        "step",
        &format!("largest displacement [{length}]"),
        &format!("work [{energy}]"),
        &format!("dissipated [{energy}]"),
        "open",
        "stick",
        "slip",
    ];
    let mut table =
        Table::new("Steps", &heads).with_note("Work and dissipated energy are those of the step.");
    for (index, record) in history.records.iter().enumerate() {
        let mut row = vec![
            Cell::count(index + 1),
            Cell::words(&record.step.stage),
            Cell::count(record.step.number),
            Cell::number(units.length(record.largest_displacement), 4),
            Cell::number(units.energy(record.work), 4),
            Cell::number(units.energy(record.dissipation), 4),
        ];
        row.extend(record.contacts.map(Cell::count));
        table.row(row);
    }
    table.if_any()
}
