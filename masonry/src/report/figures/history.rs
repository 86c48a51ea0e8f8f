//! The steps of a load history.

use super::tables::{counts, reactions};
use super::{Column, Digits, Table, Value, members, values};
use crate::history::{History, Step};
use crate::model::Model;
use crate::report::format::{InUnits, Quantity};

/// Columns that are not in CSV.
const NOT_IN_CSV: [&str; 8] = ["number", "of", "place", "route", "W", "D", "dragged", "balance"];
const ON_PAGE: [&str; 9] =
    ["number", "stage", "step", "max_displacement", "work", "dissipation", "open", "stick", "slip"];
const IN_TEXT: [&str; 11] = [
    "stage",
    "place",
    "W",
    "D",
    "strain_energy",
    "balance",
    "max_displacement",
    "open",
    "stick",
    "slip",
    "way",
];
/// Before and after the factors and movements of a record in JSON.
const ACTIONS: [&str; 4] = ["stage", "step", "of", "gravity"];
const FOUND: [&str; 12] = [
    "route",
    "way",
    "factorisations",
    "residual",
    "work",
    "dissipation",
    "friction_power",
    "energy_created",
    "dragged",
    "strain_energy",
    "balance",
    "max_displacement",
];

/// A row for every step that was solved.
fn steps(model: &Model, history: &History) -> Table {
    let mut table = Table::new(InUnits(model.units), columns(model, history));
    let (mut work, mut dissipated, mut spent) = (0.0, 0.0, 0.0);
    for (index, record) in history.records.iter().enumerate() {
        work += record.work;
        dissipated += record.dissipation;
        spent += record.work - record.dissipation;
        let (step, actions) = (&record.step, &record.step.actions);
        let mut row = values![index + 1, &step.stage, step.number, step.of, place(step)];
        row.push(actions.gravity.into());
        row.extend(actions.loads.iter().map(|it| Value::from(*it)));
        row.extend(actions.movements.iter().flat_map(|it| values![it.x, it.y, it.turn]));
        row.extend(values![record.work, record.dissipation, work, dissipated]);
        row.extend(values![record.friction_power, record.energy_created, record.dragged]);
        row.extend(values![record.strain_energy, spent - record.strain_energy]);
        row.push(record.largest_displacement.into());
        row.extend(record.contacts.map(Value::from));
        row.extend(record.reactions.iter().flat_map(|it| values![it.fx, it.fy, it.m]));
        row.extend(values![record.residuals.worst(), record.route.name(), record.way.name()]);
        row.push(record.factorisations.into());
        table.row(row);
    }
    table
}

fn columns(model: &Model, history: &History) -> Vec<Column> {
    let number = |key: &str, quantity| Column::number(key, quantity, Digits::Aligned(3)).on_page(4);
    let of_supports = |parts: [(&'static str, Quantity); 3]| {
        let of = move |support: &str| {
            parts.map(|(part, quantity)| number(&format!("{support} {part}"), quantity))
        };
        model.supports.iter().flat_map(move |it| of(&it.name))
    };
    let energy = |key: &str| number(key, Quantity::Energy);
    let mut list = vec![Column::count("number"), Column::words("stage"), Column::count("step")];
    list.extend([Column::count("of"), Column::words("place"), number("gravity", Quantity::Pure)]);
    let factor = |name: &String| number(&format!("load {name}"), Quantity::Pure);
    list.extend(history.loads.iter().map(factor));
    let turn = ("turn", Quantity::Radians);
    list.extend(of_supports([("x", Quantity::Length), ("y", Quantity::Length), turn]));
    list.extend([energy("work"), energy("dissipation").named("dissipated")]);
    list.extend(["W", "D"].map(energy));
    list.push(number("friction_power", Quantity::Pure));
    list.extend(["energy_created", "dragged", "strain_energy", "balance"].map(energy));
    list.push(number("max_displacement", Quantity::Length).named("largest displacement"));
    list.extend(["open", "stick", "slip"].map(Column::count));
    let m = ("m", Quantity::Energy);
    list.extend(of_supports([("fx", Quantity::Force), ("fy", Quantity::Force), m]));
    list.push(number("residual", Quantity::Pure));
    list.extend(["route", "way"].map(Column::words));
    list.push(Column::count("factorisations"));
    list
}

/// The number of a step and of all of its stage.
pub(in crate::report) fn place(step: &Step) -> String {
    format!("{}/{}", step.number, step.of)
}

pub(in crate::report) fn in_csv(model: &Model, history: &History) -> Table {
    steps(model, history).without(&NOT_IN_CSV)
}

pub(in crate::report) fn on_page(model: &Model, history: &History) -> Table {
    steps(model, history).only(&ON_PAGE)
}

pub(in crate::report) fn in_text(model: &Model, history: &History) -> Table {
    steps(model, history).only(&IN_TEXT)
}

/// The object of a history; `failed` is the step that could not be solved.
pub(in crate::report) fn in_json(
    model: &Model,
    history: &History,
) -> Result<Value, serde_json::Error> {
    let units = InUnits(model.units);
    let all = steps(model, history);
    let [before, after] = [&ACTIONS[..], &FOUND].map(|keys| all.only(keys).objects());
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
    let at = |it: &Step| members! { "stage": &it.stage, "step": it.number, "of": it.of };
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
