//! A limit load, or the ranges of reactions, as text.

use super::json::path::sides;
use crate::analysis::limit::{
    Associative, Change, Directions, Governs, Limit, Path, Range, Rest, Stand, Thickness,
};
use crate::data::state::Reaction;
use crate::data::statics::Extreme;
use crate::model::Model;
use crate::report::format::{InUnits, aligned, significant};
use crate::report::moving::moving_part;
use crate::report::table::{head, pairs, section, table as columns};
use crate::rounding::{Side, outwards};

/// So many events are printed; all are in the JSON object.
const EVENTS: usize = 20;

/// The report: the sentence, what was found by each law, and the times.
pub fn table(limit: &Limit) -> String {
    let mut text = head(&limit.sentence);
    for warning in &limit.warnings {
        text += &head(&format!("Warning: {warning}"));
    }
    let units = InUnits(limit.model.units);
    if let Some(found) = &limit.associative {
        text += &section(&format!("Limit load of \"{}\", associative flow", limit.group));
        text += &of_associative(found, &limit.model);
        let under = match found.load_factor {
            Some(_) => "under the load factor".to_owned(),
            None => format!("without \"{}\"", limit.group),
        };
        let title = format!("Reactions {under}, of one set of forces");
        text += &of_reactions(&title, &found.reactions, units);
    }
    if let Some(path) = &limit.path {
        text +=
            &section(&format!("Limit load of \"{}\", path with Coulomb's friction", limit.group));
        text += &of_path(path, units);
        text += &of_reactions("Reactions in the last state at rest", &path.reactions, units);
        text += &of_events(path);
    }
    text += &section("Times");
    let millis = |seconds: f64| format!("{} ms", significant(1e3 * seconds, 4));
    let rows: Vec<_> =
        limit.times.iter().map(|it| (it.phase.as_str(), millis(it.seconds))).collect();
    text + &pairs(&rows)
}

/// The sentences of both directions, and the report of the one that governs.
pub fn table_both(both: &Directions) -> String {
    let which = match both.governs {
        Governs::Given => "The given direction governs:",
        Governs::Opposite => "The opposite direction governs:",
        Governs::Both => "Both directions carry the same. The given one:",
        Governs::Unknown => "Which direction governs is not known. The given one:",
    };
    let Directions { given, opposite, .. } = both;
    format!(
        "Given direction: {}\nOpposite direction: {}\n{which}\n\n{}",
        given.sentence,
        opposite.sentence,
        table(both.governing())
    )
}

fn bound(it: Option<f64>, side: Side) -> String {
    it.map_or("none".to_owned(), |it| outwards(it, side, |it| significant(it, 10)))
}

fn yes_or_no(it: bool) -> String {
    if it { "yes" } else { "no" }.to_owned()
}

fn of_associative(found: &Associative, model: &Model) -> String {
    let with = |it: Option<f64>, side, what: &str| match it {
        Some(_) => format!("{}, {what}", bound(it, side)),
        None => "none".to_owned(),
    };
    let gap = found.bound.zip(found.load_factor).map(|(bound, factor)| bound - factor);
    let mut rows = vec![
        ("load factor", with(found.load_factor, Side::Below, "carried by forces within friction")),
        ("bound", with(found.bound, Side::Above, "above which a motion proves that none do")),
        ("gap", gap.map_or("none".to_owned(), |gap| significant(gap, 2))),
        ("proved", yes_or_no(found.proved)),
    ];
    rows.extend(found.mechanism.as_ref().map(|rates| ("moves", moving_part(model, rates))));
    rows.extend(found.rest.map(|rest| ("the rest", carried_by_rest(rest))));
    pairs(&rows)
}

/// What the rest of a structure carries if the part that moves is held.
pub(in crate::report) fn carried_by_rest(Rest { load_factor, bound }: Rest) -> String {
    let told = |it, side| outwards(it, side, |it| significant(it, 5));
    let if_held = "if the blocks that move are held (they may support others)";
    match (load_factor, bound) {
        (Some(carried), Some(bound)) => {
            let (carried, bound) = (told(carried, Side::Below), told(bound, Side::Above));
            format!("carries {carried} and not {bound}, {if_held}")
        }
        (Some(carried), None) => {
            format!("carries {} at least, {if_held}", told(carried, Side::Below))
        }
        (None, Some(bound)) => format!("does not carry {}, {if_held}", told(bound, Side::Above)),
        (None, None) => format!("has no limit that was found, {if_held}"),
    }
}

fn of_path(path: &Path, units: InUnits) -> String {
    let mut rows = vec![
        (
            "load factor",
            format!("{}, the last at which blocks rest", bound(path.load_factor, Side::Below)),
        ),
        ("falls at", bound(path.falls, Side::Above)),
        ("decided", yes_or_no(path.decided)),
        ("states at rest", path.curve.len().to_string()),
    ];
    if let Some(Stand { displacement, contacts: [open, stick, slip], .. }) = path.curve.last() {
        let moved = significant(units.length(*displacement), 4);
        rows.push(("displacement", format!("{moved} {}, the largest", units.0.length_name())));
        rows.push(("contact points", format!("{open} open, {stick} stick, {slip} slide")));
    }
    rows.extend(path.mechanism.as_ref().map(|rates| ("moves", moving_part(&path.model, rates))));
    pairs(&rows)
}

fn of_events(path: &Path) -> String {
    if path.events.is_empty() {
        return String::new();
    }
    let mut list = columns(&["between", "and", "joint", "after", "before"], &[3, 4]);
    for event in path.events.iter().take(EVENTS) {
        let [behind, front] = sides(&path.model, event).map(str::to_owned);
        let change = match event.change {
            Change::Hinges => "hinges",
            Change::Opens => "opens",
            Change::Slides => "slides",
        };
        let factor = |it: f64| significant(it, 5);
        let (after, before) = (factor(event.after), factor(event.before));
        list.add_row(vec![behind, front, change.to_owned(), after, before]);
    }
    let more = match path.events.len().saturating_sub(EVENTS) {
        0 => String::new(),
        more => format!(" and {more} more\n"),
    };
    section("Joints that open and slide, between two load factors")
        + &list.trim_fmt()
        + "\n"
        + &more
}

fn of_reactions(title: &str, reactions: &[Reaction], units: InUnits) -> String {
    if reactions.is_empty() {
        return String::new();
    }
    let (force, moment) = (units.0.force_name(), units.0.energy_name());
    let heads =
        ["support", &format!("fx [{force}]"), &format!("fy [{force}]"), &format!("m [{moment}]")];
    let mut list = columns(&heads, &[1, 2, 3]);
    let parts = |of: fn(&Reaction) -> f64| reactions.iter().map(of);
    let forces: Vec<f64> =
        parts(|it| it.fx).chain(parts(|it| it.fy)).map(|it| units.force(it)).collect();
    let moments: Vec<f64> = parts(|it| it.m).map(|it| units.energy(it)).collect();
    let (forces, moments) = (aligned(&forces, 6), aligned(&moments, 6));
    for (k, reaction) in reactions.iter().enumerate() {
        let fy = &forces[reactions.len() + k];
        list.add_row(vec![&reaction.support, &forces[k], fy, &moments[k]]);
    }
    section(title) + &list.trim_fmt() + "\n Moments are about the origin.\n"
}

/// The report of ranges: by support the least and the largest reaction.
pub fn range_table(range: &Range) -> String {
    let mut text = head(&range.sentence);
    let Some(supports) = &range.supports else { return text };
    let units = InUnits(range.model.units);
    let force = units.0.force_name();
    text += &section("Least and largest reactions on the structure");
    let heads = ["support", "", &format!("least [{force}]"), &format!("largest [{force}]"), "gaps"];
    let mut list = columns(&heads, &[2, 3, 4]);
    let value = |it: Extreme| match it {
        // Less than what is left open is nothing.
        Extreme::Value { value, bound } if value.abs() <= (bound - value).abs() => "0".to_owned(),
        Extreme::Value { value, .. } => significant(units.force(value), 7),
        Extreme::Unlimited => "unlimited".to_owned(),
        Extreme::Open => "not found".to_owned(),
    };
    let gap = |it: Extreme| match it {
        Extreme::Value { value, bound } => significant(units.force((bound - value).abs()), 1),
        Extreme::Unlimited | Extreme::Open => "-".to_owned(),
    };
    for it in supports {
        for (name, [least, largest]) in [("fx", it.fx), ("fy", it.fy)] {
            let gaps = format!("{}, {}", gap(least), gap(largest));
            list.add_row(vec![
                it.support.clone(),
                name.to_owned(),
                value(least),
                value(largest),
                gaps,
            ]);
        }
    }
    text += &list.trim_fmt();
    text + "\n\nThe gaps are between the forces of a limit and the motion that proves that none are beyond it.\n"
}

/// The report of a least thickness: the sentence, and both thicknesses.
pub fn thickness_table(it: &Thickness) -> String {
    let units = InUnits(it.model.units);
    let length = |metres: Option<f64>| match metres {
        Some(metres) => {
            format!("{} {}", significant(units.length(metres), 8), units.0.length_name())
        }
        None => "none".to_owned(),
    };
    let rows = [
        ("stands at", length(it.stands)),
        ("falls at", length(it.falls)),
        ("proved", if it.proved { "yes" } else { "no" }.to_owned()),
    ];
    head(&it.sentence) + &section(&format!("Least thickness of \"{}\"", it.arch)) + &pairs(&rows)
}
