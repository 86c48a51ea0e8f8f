//! A limit load, or the ranges of reactions, as text.

use crate::figures::tables::reactions;
use crate::figures::{self, on_text};
use crate::format::{InUnits, significant};
use crate::text::{head, heads, pairs, section, table as columns};
use masonry::analysis::limit::{Directions, Governs, Limit, Path, Range, Thickness};
use masonry::data::state::Reaction;

/// The largest number of events in the report as text; the JSON object has all events.
const EVENTS: usize = 20;

/// Returns the report of a limit load as text: the sentence, the results of each law, the seismic check, and the times.
pub fn table(limit: &Limit) -> String {
    let mut text = heads(&limit.sentence, &limit.warnings);
    let units = InUnits(limit.model.units);
    if let Some(found) = &limit.associative {
        text += &section(&format!("Limit load of \"{}\", associative flow", limit.group));
        text += &pairs(&on_text(&figures::limit::associative(found, &limit.model)));
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
        text += &pairs(&on_text(&figures::limit::path(path)));
        text += &of_reactions("Reactions in the last state at rest", &path.reactions, units);
        text += &of_events(path);
    }
    if let Some(check) = &limit.seismic {
        text += &section("Seismic check, linear kinematic analysis (Circolare 7/2019, C8.7.1.2.1)");
        text += &pairs(&on_text(&figures::seismic::seismic(check, units)));
    }
    text += &section("Times");
    let millis = |seconds: f64| format!("{} ms", significant(1e3 * seconds, 4));
    let rows: Vec<_> =
        limit.times.iter().map(|it| (it.phase.as_str(), millis(it.seconds))).collect();
    text + &pairs(&rows)
}

/// Returns the sentences and seismic checks of both directions, and the report of the direction that governs.
pub fn table_both(both: &Directions) -> String {
    let which = match both.governs {
        Governs::Given => "The given direction governs:",
        Governs::Opposite => "The opposite direction governs:",
        Governs::Both => "Both directions carry the same. The given one:",
        Governs::Unknown => "The governing direction is not known. The given one:",
    };
    let Directions { given, opposite, .. } = both;
    let directions = [("Given direction", given), ("Opposite direction", opposite)];
    let sentences: String =
        directions.map(|(name, limit)| format!("{name}: {}\n", limit.sentence)).concat();
    let check = |(name, limit): (&str, &Limit)| {
        let answer = figures::seismic::answer(limit.seismic.as_ref()?);
        Some(format!("{name}, seismic check: {answer}\n"))
    };
    let checks: String = directions.into_iter().filter_map(check).collect();
    format!("{sentences}{checks}{which}\n\n{}", table(both.governing()))
}

fn of_events(path: &Path) -> String {
    if path.events.is_empty() {
        return String::new();
    }
    let mut list = figures::limit::events(path).without("number");
    "joint".clone_into(&mut list.columns[2].name);
    list.rows.truncate(EVENTS);
    let more = match path.events.len().saturating_sub(EVENTS) {
        0 => String::new(),
        more => format!(" and {more} more\n"),
    };
    section("Joints that open and slide, between two load factors") + &columns(&list) + &more
}

fn of_reactions(title: &str, list: &[Reaction], units: InUnits) -> String {
    if list.is_empty() {
        return String::new();
    }
    section(title) + &columns(&reactions(units, list)) + " Moments are about the origin.\n"
}

/// Returns the report of ranges as text: the least and the largest reaction of every support.
pub fn range_table(range: &Range) -> String {
    let text = head(&range.sentence);
    let Some(list) = figures::limit::range(range) else { return text };
    text + &section("Least and largest reactions on the structure")
        + &columns(&list)
        + "\nEach gap is between the forces of a limit and the motion that proves that no forces exceed it.\n"
}

/// Returns the report of a least thickness as text: the sentence, and the thicknesses at which the arch stands and
/// falls.
pub fn thickness_table(it: &Thickness) -> String {
    let rows = on_text(&figures::limit::thickness(it));
    head(&it.sentence) + &section(&format!("Least thickness of \"{}\"", it.arch)) + &pairs(&rows)
}
