//! A limit load, or the ranges of reactions, as text.

use crate::analysis::limit::{Limit, Range, Thickness};
use crate::method::statics::limit::Extreme;
use crate::report::format::{InUnits, aligned, significant};
use crate::report::table::{head, pairs, section, table as columns};

/// The report: the sentence, both bounds and their gap, and the reactions under the load factor.
pub fn table(limit: &Limit) -> String {
    let found = &limit.associative;
    let number = |it: Option<f64>| it.map_or("none".to_owned(), |it| significant(it, 10));
    let mut text = head(&limit.sentence);
    for warning in &limit.warnings {
        text += &head(&format!("Warning: {warning}"));
    }
    text += &section(&format!("Limit load of \"{}\", associative flow", limit.group));
    let gap = found.bound.zip(found.load_factor).map(|(bound, factor)| bound - factor);
    let mut rows = vec![
        (
            "load factor",
            format!("{}, carried by forces within friction", number(found.load_factor)),
        ),
        ("bound", format!("{}, above which a motion proves that none do", number(found.bound))),
        ("gap", gap.map_or("none".to_owned(), |gap| significant(gap, 2))),
        ("proved", if found.proved { "yes" } else { "no" }.to_owned()),
    ];
    for time in &limit.times {
        rows.push((&time.phase, format!("{} ms", significant(1e3 * time.seconds, 4))));
    }
    text += &pairs(&rows);
    if !found.reactions.is_empty() {
        text += &section("Reactions under the load factor, of one set of forces");
        let units = InUnits(limit.model.units);
        let (force, moment) = (units.0.force_name(), units.0.energy_name());
        let heads = [
            "support",
            &format!("fx [{force}]"),
            &format!("fy [{force}]"),
            &format!("m [{moment}]"),
        ];
        let mut list = columns(&heads, &[1, 2, 3]);
        let parts = |of: fn(&crate::state::Reaction) -> f64| found.reactions.iter().map(of);
        let forces: Vec<f64> =
            parts(|it| it.fx).chain(parts(|it| it.fy)).map(|it| units.force(it)).collect();
        let moments: Vec<f64> = parts(|it| it.m).map(|it| units.energy(it)).collect();
        let (forces, moments) = (aligned(&forces, 6), aligned(&moments, 6));
        for (k, reaction) in found.reactions.iter().enumerate() {
            let fy = &forces[found.reactions.len() + k];
            list.add_row(vec![&reaction.support, &forces[k], fy, &moments[k]]);
        }
        text += &(list.trim_fmt() + "\n Moments are about the origin.\n");
    }
    text
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
    text + &list.trim_fmt() + "\n"
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
