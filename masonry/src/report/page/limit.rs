//! The pages of a limit load and of the least thickness of an arch.

use nalgebra::Vector2;

use super::tables::{self, Cell, Table};
use super::{Choice, Page, size};
use crate::analysis::limit::{Answer, Associative, Change, Limit, Path, Thickness};
use crate::data::state::{ContactState, Reaction};
use crate::model::Model;
use crate::report::format::{InUnits, significant};
use crate::report::hinges::yielding;
use crate::report::limit::{carried_by_rest, table, thickness_table};
use crate::report::moving::moving_part;
use crate::report::svg;
use crate::rounding::{Side, outwards};

/// Rates of the corners of one block.
type Rates = Vec<Vector2<f64>>;

/// The page of a limit load.
pub fn limit(limit: &Limit) -> String {
    let (mut pictures, mut list) = (Vec::new(), Vec::new());
    let (title, mut curves) = (&limit.title, None);
    if let Some(found) = &limit.associative {
        let law = ByLaw {
            of: "associative flow",
            names: [("forces", "Forces"), ("mechanism", "Mechanism")],
            model: &limit.model,
            forces: found.forces.as_deref(),
            mechanism: found.mechanism.as_deref(),
            reactions: &found.reactions,
            events: None,
        };
        law.show(title, &mut pictures, &mut list);
    }
    if let Some(path) = &limit.path {
        let law = ByLaw {
            of: "path",
            names: [("path-forces", "Forces, path"), ("path-mechanism", "Mechanism, path")],
            model: &path.model,
            forces: path.contacts.as_deref(),
            mechanism: path.mechanism.as_deref(),
            reactions: &path.reactions,
            events: events(path),
        };
        law.show(title, &mut pictures, &mut list);
        curves = svg::path(title, &limit.group, path);
    }
    pictures.push(Choice::one("scene", "Scene", svg::scene(title, &limit.model)));
    Page {
        title: title.clone(),
        verdict: verdict(limit),
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

/// What a page shows of one law of friction.
struct ByLaw<'a> {
    /// The law, in titles.
    of: &'static str,
    /// Keys and switches of the pictures of forces and of the mechanism.
    names: [(&'static str, &'static str); 2],
    model: &'a Model,
    forces: Option<&'a [ContactState]>,
    mechanism: Option<&'a [Rates]>,
    reactions: &'a [Reaction],
    events: Option<Table>,
}

impl ByLaw<'_> {
    fn show(self, title: &str, pictures: &mut Vec<Choice>, list: &mut Vec<Table>) {
        let Self { of, names: [forces, mechanism], model, .. } = self;
        if let Some(found) = self.forces {
            let picture = svg::forces(&format!("{title}, {of}"), model, found);
            pictures.push(Choice::one(forces.0, forces.1, picture));
        }
        if let Some(rates) = self.mechanism {
            moving(pictures, list, (title, model), rates, (mechanism.0, mechanism.1, of));
        }
        let units = InUnits(model.units);
        list.extend(tables::reactions(&format!("Reactions, {of}"), self.reactions, units));
        list.extend(self.events);
        if let Some(found) = self.forces {
            list.extend(tables::joints(&format!("Joints, {of}"), model, found));
        }
    }
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
    let length = |it: Option<f64>, side| {
        let text = |it: f64| outwards(units.length(it), side, |it| significant(it, 6));
        it.map_or("none".to_owned(), |it| {
            format!("{}\u{a0}{}", text(it), model.units.length_name())
        })
    };
    Page {
        title: title.clone(),
        verdict: verdict_of(thickness),
        sentence: thickness.sentence.clone(),
        figures: vec![
            ("stands at".to_owned(), length(thickness.stands, Side::Above)),
            ("falls at".to_owned(), length(thickness.falls, Side::Below)),
            ("proved".to_owned(), yes_or_no(thickness.proved)),
        ],
        pictures,
        tables: list,
        text: thickness_table(thickness),
        ..Page::default()
    }
    .finish()
}

/// Whether the arch stands at the thickness of the scene.
fn verdict_of(thickness: &Thickness) -> &'static str {
    let Thickness { given, stands, falls, .. } = thickness;
    match (stands, falls) {
        (_, Some(falls)) if given <= falls => "falls",
        (Some(stands), _) if given >= stands => "stands",
        _ => "undecided",
    }
}

/// Picture and table of a mechanism.
fn moving(
    pictures: &mut Vec<Choice>,
    tables: &mut Vec<Table>,
    (title, model): (&str, &Model),
    rates: &[Rates],
    (key, name, of): (&str, &str, &str),
) {
    let picture = svg::mechanism_on_page(&format!("{title}, {of}"), model, rates);
    pictures.push(Choice::one(key, name, picture));
    let title = format!("Joints of the mechanism, {of}");
    tables.extend(tables::yielding(&title, model, &yielding(model, rates)));
}

/// Says whether the structure stands under the loads that stay, and some part of those that grow.
fn verdict(limit: &Limit) -> &'static str {
    if limit.falls_by_weight || limit.associative.as_ref().is_some_and(Associative::carries_nothing)
    {
        return "falls";
    }
    let answer = limit.associative.as_ref().map(|it| it.answer);
    let falls = |path: &Path| path.decided && path.load_factor.is_none();
    let is_open = limit.path.as_ref().is_some_and(|it| !it.decided);
    if answer == Some(Answer::Falls) || limit.path.as_ref().is_some_and(falls) {
        "falls"
    } else if answer == Some(Answer::Undecided) || is_open || limit.is_interrupted {
        "undecided"
    } else {
        "stands"
    }
}

fn yes_or_no(it: bool) -> String {
    if it { "yes" } else { "no" }.to_owned()
}

fn figures(limit: &Limit) -> Vec<(String, String)> {
    let bound = |it: Option<f64>, side| {
        it.map_or("none".to_owned(), |it| outwards(it, side, |it| significant(it, 5)))
    };
    let mut list = vec![("load that grows", limit.group.clone())];
    let moves = |it: &Option<Vec<Rates>>| {
        it.as_ref().map(|rates| ("moves", moving_part(&limit.model, rates)))
    };
    if let Some(path) = &limit.path {
        list.push(("factor along a path", bound(path.load_factor, Side::Below)));
        list.push(("falls at", bound(path.falls, Side::Above)));
        list.extend(moves(&path.mechanism));
    }
    if let Some(found) = &limit.associative {
        list.push(("factor, associative flow", bound(found.load_factor, Side::Below)));
        list.push(("cannot stand above", bound(found.bound, Side::Above)));
        if limit.path.is_none() {
            list.extend(moves(&found.mechanism));
        }
        list.extend(found.rest.map(|rest| ("the rest", carried_by_rest(rest))));
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
