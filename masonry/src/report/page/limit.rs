//! The pages of a limit load and of the least thickness of an arch.

use nalgebra::Vector2;

use super::tables::{self, Cell, Table};
use super::{Choice, Page, size};
use crate::analysis::limit::{Answer, Change, Limit, Path, Thickness};
use crate::model::Model;
use crate::report::format::{InUnits, significant};
use crate::report::hinges::yielding;
use crate::report::limit::{table, thickness_table};
use crate::report::svg;

/// The page of a limit load.
pub fn limit(limit: &Limit) -> String {
    let units = InUnits(limit.model.units);
    let (mut pictures, mut list) = (Vec::new(), Vec::new());
    if let Some(found) = &limit.associative {
        let of = "associative flow";
        if let Some(forces) = &found.forces {
            let title = format!("{}, {of}", limit.title);
            let picture = svg::forces(&title, &limit.model, forces);
            pictures.push(Choice::one("forces", "Forces", picture));
        }
        if let Some(rates) = &found.mechanism {
            let keys = ("mechanism", "Mechanism", of);
            moving(&mut pictures, &mut list, (&limit.title, &limit.model), rates, keys);
        }
        list.extend(tables::reactions(&format!("Reactions, {of}"), &found.reactions, units));
        if let Some(forces) = &found.forces {
            list.extend(tables::joints(&format!("Joints, {of}"), &limit.model, forces));
        }
    }
    let mut curves = None;
    if let Some(path) = &limit.path {
        let of = "path";
        if let Some(contacts) = &path.contacts {
            let title = format!("{}, {of}", limit.title);
            let picture = svg::forces(&title, &path.model, contacts);
            pictures.push(Choice::one("path-forces", "Forces, path", picture));
        }
        if let Some(rates) = &path.mechanism {
            let keys = ("path-mechanism", "Mechanism, path", of);
            moving(&mut pictures, &mut list, (&limit.title, &path.model), rates, keys);
        }
        list.extend(tables::reactions(&format!("Reactions, {of}"), &path.reactions, units));
        list.extend(events(path));
        if let Some(contacts) = &path.contacts {
            list.extend(tables::joints(&format!("Joints, {of}"), &path.model, contacts));
        }
        curves = svg::path(&limit.title, &limit.group, path);
    }
    pictures.push(Choice::one("scene", "Scene", svg::scene(&limit.title, &limit.model)));
    Page {
        title: limit.title.clone(),
        verdict: if is_known(limit) { "stands" } else { "undecided" },
        sentence: limit.sentence.clone(),
        warnings: limit.warnings.clone(),
        figures: figures(limit),
        pictures,
        curves,
        tables: list,
        text: table(limit),
        ..Page::default()
    }
    .finish()
}

/// The page of the least thickness of an arch.
pub fn thickness(thickness: &Thickness) -> String {
    let (title, model) = (&thickness.title, &thickness.model);
    let (mut pictures, mut list) = (Vec::new(), Vec::new());
    if let Some(forces) = &thickness.forces {
        pictures.push(Choice::one("forces", "Forces", svg::forces(title, model, forces)));
        list.extend(tables::joints("Joints", model, forces));
    }
    if let Some(rates) = &thickness.mechanism {
        let keys = ("mechanism", "Mechanism", "of the thicker that falls");
        moving(&mut pictures, &mut list, (title, model), rates, keys);
    }
    pictures.push(Choice::one("scene", "Scene", svg::scene(title, model)));
    let units = InUnits(model.units);
    let length = |it: Option<f64>| it.map_or("none".to_owned(), |it| units.length_text(it));
    Page {
        title: title.clone(),
        verdict: if thickness.proved { "stands" } else { "undecided" },
        sentence: thickness.sentence.clone(),
        figures: vec![
            ("stands at".to_owned(), length(thickness.stands)),
            ("falls at".to_owned(), length(thickness.falls)),
            ("proved".to_owned(), yes_or_no(thickness.proved)),
        ],
        pictures,
        tables: list,
        text: thickness_table(thickness),
        ..Page::default()
    }
    .finish()
}

/// Picture and table of a mechanism.
fn moving(
    pictures: &mut Vec<Choice>,
    tables: &mut Vec<Table>,
    (title, model): (&str, &Model),
    rates: &[Vec<Vector2<f64>>],
    (key, name, of): (&str, &str, &str),
) {
    let picture = svg::mechanism_on_page(&format!("{title}, {of}"), model, rates);
    pictures.push(Choice::one(key, name, picture));
    let title = format!("Joints of the mechanism, {of}");
    tables.extend(tables::yielding(&title, model, &yielding(model, rates)));
}

fn is_known(limit: &Limit) -> bool {
    let proved = limit.associative.as_ref().is_none_or(|it| it.answer != Answer::Undecided);
    proved && limit.path.as_ref().is_none_or(|path| path.decided)
}

fn yes_or_no(it: bool) -> String {
    if it { "yes" } else { "no" }.to_owned()
}

fn figures(limit: &Limit) -> Vec<(String, String)> {
    let number = |it: Option<f64>| it.map_or("none".to_owned(), |it| significant(it, 5));
    let mut list = vec![("load that grows", limit.group.clone())];
    if let Some(path) = &limit.path {
        list.push(("factor along a path", number(path.load_factor)));
        list.push(("falls at", number(path.falls)));
    }
    if let Some(found) = &limit.associative {
        list.push(("factor, associative flow", number(found.load_factor)));
        list.push(("cannot stand above", number(found.bound)));
        list.push(("proved", yes_or_no(found.proved)));
    }
    list.push(("size", size(&limit.model)));
    let seconds: f64 = limit.times.iter().map(|it| it.seconds).sum();
    list.push(("time", format!("{} s", significant(seconds, 2))));
    list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn events(path: &Path) -> Option<Table> {
    let heads = ["number", "between", "and", "change", "after", "before"];
    let mut table = Table::new("Joints that open and slide along the path", &heads)
        .with_note("Each between two load factors.");
    for (index, event) in path.events.iter().enumerate() {
        let mut row = vec![Cell::count(index + 1)];
        row.extend(tables::sides(&path.model, event.joint.index()));
        row.push(Cell::words(match event.change {
            Change::Hinges => "hinges",
            Change::Opens => "opens",
            Change::Slides => "slides",
        }));
        row.extend([Cell::number(event.after, 5), Cell::number(event.before, 5)]);
        table.row(row);
    }
    table.if_any()
}
