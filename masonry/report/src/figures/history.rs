//! The steps of a load history.

use super::Digits::Aligned;
use super::tables::{counts, reactions};
use super::{Columns, Table, Value, members};
use crate::format::InUnits;
use crate::format::Quantity::{Energy, Force, Length, Pure, Radians};
use masonry::history::{History, HistoryStep, StepRecord};
use masonry::model::Model;

/// Keys of the first columns of a step in JSON, before its factors and movements.
const ACTIONS: &str = "stage step of gravity";
const FOUND: &str = "route way factorisations residual work dissipation friction_power energy_created dragged \
                     strain_energy balance max_displacement";

/// A step, and the sums of work and dissipation up to this step.
struct Row<'a> {
    number: usize,
    it: &'a StepRecord,
    work: f64,
    dissipated: f64,
    /// The work that friction has not dissipated: the sum of `work - dissipation` of all steps so far.
    left: f64,
}

/// Returns the table of a load history: a row for every step that was solved.
pub(crate) fn steps(model: &Model, history: &History) -> Table {
    let (mut work, mut dissipated, mut left) = (0.0, 0.0, 0.0);
    let rows = (1..).zip(&history.records).map(|(number, it)| {
        work += it.work;
        dissipated += it.dissipation;
        left += it.work - it.dissipation;
        Row { number, it, work, dissipated, left }
    });
    columns(model, history).table(InUnits(model.units), rows)
}

fn columns<'a>(model: &'a Model, history: &'a History) -> Columns<'a, Row<'a>> {
    let mut list = Columns::<Row<'_>>::new()
        .count("number", |it| it.number)
        .words("stage", |it| &it.it.step.stage)
        .count("step", |it| it.it.step.number)
        .count("of", |it| it.it.step.of)
        .words("place", |it| place(&it.it.step))
        .number("gravity", Pure, Aligned(3), |it| it.it.step.actions.gravity);
    for (k, name) in history.loads.iter().enumerate() {
        let of = move |it: &Row<'_>| it.it.step.actions.loads[k];
        list = list.number(&format!("load {name}"), Pure, Aligned(3), of);
    }
    for (k, support) in model.supports.iter().enumerate() {
        let key = |part| format!("{} {part}", support.name);
        let of = move |it: &Row<'_>| it.it.step.actions.movements[k];
        list = list
            .number(&key("x"), Length, Aligned(3), move |it| of(it).x)
            .number(&key("y"), Length, Aligned(3), move |it| of(it).y)
            .number(&key("turn"), Radians, Aligned(3), move |it| of(it).turn);
    }
    list = list
        .number("work", Energy, Aligned(3), |it| it.it.work)
        .number("dissipation", Energy, Aligned(3), |it| it.it.dissipation)
        .named("dissipated")
        .number("W", Energy, Aligned(3), |it| it.work)
        .number("D", Energy, Aligned(3), |it| it.dissipated)
        .number("friction_power", Pure, Aligned(3), |it| it.it.friction_power)
        .number("energy_created", Energy, Aligned(3), |it| it.it.energy_created)
        .number("dragged", Energy, Aligned(3), |it| it.it.dragged)
        .number("strain_energy", Energy, Aligned(3), |it| it.it.strain_energy)
        .number("balance", Energy, Aligned(3), |it| it.left - it.it.strain_energy)
        .number("max_displacement", Length, Aligned(3), |it| it.it.largest_displacement)
        .named("largest displacement")
        .count("open", |it| it.it.contacts[0])
        .count("stick", |it| it.it.contacts[1])
        .count("slip", |it| it.it.contacts[2]);
    for (k, support) in model.supports.iter().enumerate() {
        let key = |part| format!("{} {part}", support.name);
        let of = move |it: &Row<'a>| it.it.reactions.get(k);
        list = list
            .number(&key("fx"), Force, Aligned(3), move |it| Some(of(it)?.fx))
            .number(&key("fy"), Force, Aligned(3), move |it| Some(of(it)?.fy))
            .number(&key("m"), Energy, Aligned(3), move |it| Some(of(it)?.m));
    }
    list.number("residual", Pure, Aligned(3), |it| it.it.residuals.worst())
        .words("route", |it| it.it.route.name())
        .words("way", |it| it.it.way.name())
        .count("factorisations", |it| it.it.factorisations)
}

/// Returns the number of a step, and the number of all steps of its stage.
pub(crate) fn place(step: &HistoryStep) -> String {
    format!("{}/{}", step.number, step.of)
}

pub(crate) fn in_csv(model: &Model, history: &History) -> Table {
    steps(model, history).without("number of place route W D dragged balance")
}

pub(crate) fn on_page(model: &Model, history: &History) -> Table {
    steps(model, history)
        .only("number stage step max_displacement work dissipation open stick slip")
}

/// Returns the table for the report as text; a paragraph below the table gives the meanings and units of its short
/// names.
pub(crate) fn in_text(model: &Model, history: &History) -> Table {
    steps(model, history)
        .only("stage place W D strain_energy balance max_displacement open stick slip way")
        .with_names([
            "stage", "step", "W", "D", "U", "W-U-D", "moved", "open", "stick", "slip", "found by",
        ])
}

/// Returns the JSON object of a history; its `failed` is the step that could not be solved.
pub(crate) fn in_json(model: &Model, history: &History) -> Result<Value, serde_json::Error> {
    let units = InUnits(model.units);
    let all = steps(model, history);
    let [before, after] = [ACTIONS, FOUND].map(|keys| all.only(keys).objects());
    let mut records = Vec::with_capacity(history.records.len());
    for ((record, mut members), after) in history.records.iter().zip(before).zip(after) {
        let actions = &record.step.actions;
        let factors = history.loads.iter().cloned().zip(actions.loads.iter().copied());
        let factors = factors.map(|(name, factor)| (name, Value::Number(factor)));
        let places = model.supports.iter().zip(&actions.movements).map(|(support, it)| {
            let it = it.in_lengths(units.length(1.0));
            let it = members! { "x": it.x, "y": it.y, "turn": it.turn };
            (support.name.clone(), Value::Object(it))
        });
        members.push(("loads".to_owned(), Value::Object(factors.collect())));
        members.push(("moves".to_owned(), Value::Object(places.collect())));
        members.extend(after);
        members.extend(members! {
            "contacts": counts(record.contacts),
            "reactions": reactions(units, &record.reactions).by_name(),
        });
        records.push(Value::Object(members));
    }
    let at = |it: &HistoryStep| members! { "stage": &it.stage, "step": it.number, "of": it.of };
    Ok(Value::Object(members! {
        "steps": history.steps,
        "solved": history.records.len(),
        "failed": history.failed.as_ref().map(at),
        "work": units.energy(history.work()),
        "dissipation": units.energy(history.dissipation()),
        "second_loading": Value::of(&history.second_loading)?,
        "records": Value::List(records),
    }))
}
