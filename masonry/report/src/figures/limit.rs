//! Figures of a limit load, of the least thickness of an arch, and of ranges of reactions.

use super::Digits::Significant;
use super::tables::{rates_by_name, sides};
use super::{Columns, Figure, Table, Value, members, yes_or_no};
use crate::format::Quantity::{Force, Length, Pure};
use crate::format::{InUnits, significant};
use crate::moving::moving_part;
use masonry::analysis::limit::{
    Associative, JointChange, JointEvent, Path, Range, Rest, Stand, Thickness,
};
use masonry::data::statics::Extreme;
use masonry::model::Model;
use masonry::rounding::{BoundSide, outwards};

fn bound(it: Option<f64>, side: BoundSide, digits: usize) -> String {
    it.map_or("none".to_owned(), |it| outwards(it, side, |it| significant(it, digits)))
}

/// Returns the figures of the limit load by associated flow.
pub(crate) fn associative(found: &Associative, model: &Model) -> Vec<Figure> {
    let Associative { load_factor, bound: limit, .. } = *found;
    let meant = |it: Option<f64>, side, what: &str| match it {
        Some(_) => format!("{}, {what}", bound(it, side, 10)),
        None => "none".to_owned(),
    };
    let gap = limit.zip(load_factor).map(|(bound, factor)| bound - factor);
    let factor = meant(load_factor, BoundSide::Below, "carried by forces within friction");
    let above =
        meant(limit, BoundSide::Above, "above which a motion proves that no forces carry the load");
    let mut list = vec![
        Figure::new("load_factor", load_factor)
            .text("load factor", factor)
            .page("factor, associative flow", bound(load_factor, BoundSide::Below, 5)),
        Figure::new("bound", limit)
            .text("bound", above)
            .page("cannot stand above", bound(limit, BoundSide::Above, 5)),
        Figure::new("gap", gap)
            .text("gap", gap.map_or("none".to_owned(), |gap| significant(gap, 2))),
        Figure::new("proved", found.proved).both("proved", yes_or_no(found.proved)),
    ];
    list.extend(found.mechanism.as_ref().map(|rates| moves(model, rates)));
    list.extend(found.rest.map(|rest| {
        let object = members! { "load_factor": rest.load_factor, "bound": rest.bound };
        Figure::new("rest", object).both("the rest", carried_by_rest(rest))
    }));
    list
}

fn moves(model: &Model, rates: &[Vec<nalgebra::Vector2<f64>>]) -> Figure {
    let part = moving_part(model, rates);
    Figure::new("mechanism", rates_by_name(model, rates)).both("moves", part)
}

/// Returns in words the load factor that the other blocks carry if the moving blocks are held.
fn carried_by_rest(Rest { load_factor, bound }: Rest) -> String {
    let told = |it, side| outwards(it, side, |it| significant(it, 5));
    let if_held = "if the blocks that move are held (they may support others)";
    match (load_factor, bound) {
        (Some(carried), Some(bound)) => {
            let (carried, bound) = (told(carried, BoundSide::Below), told(bound, BoundSide::Above));
            format!("carries {carried} and not {bound}, {if_held}")
        }
        (Some(carried), None) => {
            format!("carries {} at least, {if_held}", told(carried, BoundSide::Below))
        }
        (None, Some(bound)) => {
            format!("does not carry {}, {if_held}", told(bound, BoundSide::Above))
        }
        (None, None) => format!("has no limit that was found, {if_held}"),
    }
}

/// Returns the figures of the limit load along a path.
pub(crate) fn path(path: &Path) -> Vec<Figure> {
    let units = InUnits(path.model.units);
    let factor = bound(path.load_factor, BoundSide::Below, 10);
    let factor = format!("{factor}, the last at which blocks rest");
    let mut list = vec![
        Figure::new("load_factor", path.load_factor)
            .text("load factor", factor)
            .page("factor along a path", bound(path.load_factor, BoundSide::Below, 5)),
        Figure::new("falls", path.falls)
            .text("falls at", bound(path.falls, BoundSide::Above, 10))
            .page("falls at", bound(path.falls, BoundSide::Above, 5)),
        Figure::new("decided", path.decided).text("decided", yes_or_no(path.decided)),
        Figure::new("", path.curve.len()).text("states at rest", path.curve.len().to_string()),
    ];
    if let Some(Stand { displacement, contacts: [open, stick, slip], .. }) = path.curve.last() {
        let moved = significant(units.length(*displacement), 4);
        let moved = format!("{moved} {}, the largest", units.0.length_name());
        let points = format!("{open} open, {stick} stick, {slip} slide");
        list.push(Figure::new("", *displacement).text("displacement", moved));
        list.push(Figure::new("", *open).text("contact points", points));
    }
    list.extend(path.mechanism.as_ref().map(|rates| moves(&path.model, rates)));
    list
}

/// Returns the table of the states of rest along a path, by growing load factor.
pub(crate) fn curve(path: &Path) -> Table {
    Columns::<&Stand>::new()
        .number("load_factor", Pure, Significant(5), |it| it.load_factor)
        .number("displacement", Length, Significant(5), |it| it.displacement)
        .count("open", |it| it.contacts[0])
        .count("stick", |it| it.contacts[1])
        .count("slip", |it| it.contacts[2])
        .table(InUnits(path.model.units), &path.curve)
}

/// Returns the table of the joints that open and slide along a path, each between two load factors.
pub(crate) fn events(path: &Path) -> Table {
    let model = &path.model;
    let sides = |it: &JointEvent| sides(model, &model.joints[it.joint.index()]);
    Columns::<(usize, &JointEvent)>::new()
        .count("number", |it| it.0)
        .words("between", |it| sides(it.1)[0])
        .words("and", |it| sides(it.1)[1])
        .words("change", |it| match it.1.change {
            JointChange::Hinges => "hinges",
            JointChange::Opens => "opens",
            JointChange::Slides => "slides",
        })
        .number("after", Pure, Significant(5), |it| it.1.after)
        .number("before", Pure, Significant(5), |it| it.1.before)
        .table(InUnits(model.units), (1..).zip(&path.events))
}

/// Returns the figures of the least thickness of an arch.
pub(crate) fn thickness(it: &Thickness) -> Vec<Figure> {
    let units = InUnits(it.model.units);
    let unit = units.0.length_name();
    let figure = |key, name, metres: Option<f64>, side| {
        let value = metres.map(|metres| units.length(metres));
        let or_none = |text: Option<String>| text.unwrap_or("none".to_owned());
        let text = value.map(|it| format!("{} {unit}", significant(it, 8)));
        let short = value.map(|_| format!("{}\u{a0}{unit}", bound(value, side, 6)));
        Figure::new(key, value).text(name, or_none(text)).page(name, or_none(short))
    };
    vec![
        figure("stands", "stands at", it.stands, BoundSide::Above),
        figure("falls", "falls at", it.falls, BoundSide::Below),
        Figure::new("proved", it.proved).both("proved", yes_or_no(it.proved)),
    ]
}

/// Returns the table of the least and the largest reactions of supports.
pub(crate) fn range(range: &Range) -> Option<Table> {
    let units = InUnits(range.model.units);
    let is_whole = !range.is_interrupted;
    let value = move |it: Extreme| match it {
        // A value that is at most as far from zero as from its bound counts as zero if the search is complete.
        Extreme::Value { value, bound } if is_whole && value.abs() <= (bound - value).abs() => {
            Value::from("0")
        }
        Extreme::Value { value, .. } => value.into(),
        Extreme::Unlimited => "unlimited".into(),
        Extreme::Open => "not found".into(),
    };
    let gap = move |it: Extreme| match it {
        Extreme::Value { value, bound } => significant(units.force((bound - value).abs()), 1),
        Extreme::Unlimited | Extreme::Open => "-".to_owned(),
    };
    let supports = range.supports.as_ref()?.iter();
    let rows = supports.flat_map(|it| [(&it.support, "fx", it.fx), (&it.support, "fy", it.fy)]);
    let table = Columns::<(&String, &str, [Extreme; 2])>::new()
        .words("support", |it| it.0)
        .words("", |it| it.1)
        .number("least", Force, Significant(7), move |it| value(it.2[0]))
        .number("largest", Force, Significant(7), move |it| value(it.2[1]))
        .words("gaps", move |it| it.2.map(gap).join(", "))
        .right(true)
        .table(units, rows);
    Some(table)
}
