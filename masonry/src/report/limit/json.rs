//! A limit load, or the ranges of reactions, as one JSON object.

use serde::Serialize;

use crate::analysis::limit::{
    Answer, Directions, Extremes, Governs, Limit, Range, Rest, Thickness,
};
use crate::data::statics::Extreme;
use crate::report::format::InUnits;
use crate::report::json::{ByName, Force, named_force, rates_by_name};

pub(super) mod path;

/// The object of `limit.json` and of `masonry limit --json`, pretty-printed.
///
/// `associative` has the `answer`, the `load_factor` that forces carry, the `bound` above which it is proved that none do, the
/// `gap` between them, whether the answer is `proved`, the `reactions` under the load factor, and the `mechanism`: rates of the
/// corners of every block, the largest component one. If a single block or a tenth of them at most move in the mechanism, `rest` has the
/// `load_factor` and the `bound` of the other blocks while the moving ones are held. `path` has the `load_factor` up to which blocks rest, the factor at which
/// it `falls`, whether that is `decided`, the `last_stable` state, the `mechanism` after it, the `events` on the way and the
/// `curve`. What is not known is null, and so is a law of friction that was not chosen. `units` names the units.
///
/// # Errors
/// None that this data can cause; the signature is that of the serialiser.
pub fn json(limit: &Limit, files: &[String]) -> Result<String, serde_json::Error> {
    Ok(serde_json::to_string_pretty(&report(limit, files))? + "\n")
}

/// The object of `masonry limit --both --json`, pretty-printed: the object of [`json`] for the `given` direction of the load and for
/// the `opposite` one, and which of them `governs` (`both` if they carry the same, `unknown` if one is not decided); files are of
/// that one, else of the given one.
///
/// # Errors
/// As [`json`].
pub fn json_both(both: &Directions, files: &[String]) -> Result<String, serde_json::Error> {
    let is_opposite = both.governs == Governs::Opposite;
    let (of_given, of_opposite) = if is_opposite { (&[][..], files) } else { (files, &[][..]) };
    let (given, opposite) = (report(&both.given, of_given), report(&both.opposite, of_opposite));
    let both = Both { governs: both.governs, given, opposite };
    Ok(serde_json::to_string_pretty(&both)? + "\n")
}

fn report<'a>(limit: &'a Limit, files: &'a [String]) -> Report<'a> {
    let model = &limit.model;
    let units = InUnits(model.units);
    Report {
        sentence: &limit.sentence,
        warnings: &limit.warnings,
        interrupted: limit.is_interrupted,
        title: &limit.title,
        group: &limit.group,
        units: Names::of(units),
        associative: limit.associative.as_ref().map(|found| Associative {
            answer: found.answer,
            load_factor: found.load_factor,
            bound: found.bound,
            gap: found.bound.zip(found.load_factor).map(|(bound, factor)| bound - factor),
            proved: found.proved,
            reactions: ByName(found.reactions.iter().map(|it| named_force(it, units)).collect()),
            mechanism: found.mechanism.as_ref().map(|rates| rates_by_name(model, rates)),
            rest: found.rest,
        }),
        path: limit.path.as_ref().map(|it| path::of(it, units)),
        time_s: ByName(limit.times.iter().map(|it| (it.phase.as_str(), it.seconds)).collect()),
        files,
    }
}

/// The object of `masonry limit --range --json`, pretty-printed: by support the `min` and `max` of `fx` and `fy`, each with its
/// `value`, the `bound` that no forces exceed, and whether it is `unlimited`; `range` is null where no forces balance the loads.
///
/// # Errors
/// As [`json`].
pub fn range_json(range: &Range) -> Result<String, serde_json::Error> {
    let units = InUnits(range.model.units);
    let supports = range.supports.as_ref();
    let report = RangeReport {
        sentence: &range.sentence,
        title: &range.title,
        units: Names::of(units),
        range: supports.map(|supports| {
            let of = |it| Components::of(it, units);
            ByName(supports.iter().map(|it| (it.support.as_str(), of(it))).collect())
        }),
    };
    Ok(serde_json::to_string_pretty(&report)? + "\n")
}

/// The object of `masonry limit --thickness ARCH --json`, pretty-printed: the largest thickness that `falls` and the smallest that
/// `stands`, and whether they are `proved` to be one number.
///
/// # Errors
/// As [`json`].
pub fn thickness_json(it: &Thickness, files: &[String]) -> Result<String, serde_json::Error> {
    let units = InUnits(it.model.units);
    let length = |metres: Option<f64>| metres.map(|metres| units.length(metres));
    let report = ThicknessReport {
        sentence: &it.sentence,
        interrupted: it.is_interrupted,
        title: &it.title,
        arch: &it.arch,
        length: units.0.length_name(),
        falls: length(it.falls),
        stands: length(it.stands),
        proved: it.proved,
        mechanism: it.mechanism.as_ref().map(|rates| rates_by_name(&it.model, rates)),
        files,
    };
    Ok(serde_json::to_string_pretty(&report)? + "\n")
}

#[derive(Serialize)]
struct ThicknessReport<'a> {
    sentence: &'a str,
    interrupted: bool,
    title: &'a str,
    arch: &'a str,
    length: &'a str,
    falls: Option<f64>,
    stands: Option<f64>,
    proved: bool,
    mechanism: Option<ByName<'a, Vec<[f64; 2]>>>,
    files: &'a [String],
}

#[derive(Serialize)]
struct Both<'a> {
    governs: Governs,
    given: Report<'a>,
    opposite: Report<'a>,
}

#[derive(Serialize)]
struct Report<'a> {
    sentence: &'a str,
    warnings: &'a [String],
    interrupted: bool,
    title: &'a str,
    group: &'a str,
    units: Names,
    associative: Option<Associative<'a>>,
    path: Option<path::Path<'a>>,
    time_s: ByName<'a, f64>,
    files: &'a [String],
}

#[derive(Serialize)]
struct Associative<'a> {
    answer: Answer,
    load_factor: Option<f64>,
    bound: Option<f64>,
    gap: Option<f64>,
    proved: bool,
    reactions: ByName<'a, Force>,
    mechanism: Option<ByName<'a, Vec<[f64; 2]>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rest: Option<Rest>,
}

#[derive(Serialize)]
struct Names {
    load_factor: &'static str,
    length: &'static str,
    force: &'static str,
    moment: String,
    time_s: &'static str,
}

impl Names {
    fn of(units: InUnits) -> Self {
        let (force, moment) = (units.0.force_name(), units.0.energy_name());
        Self { load_factor: "1", length: units.0.length_name(), force, moment, time_s: "s" }
    }
}

#[derive(Serialize)]
struct RangeReport<'a> {
    sentence: &'a str,
    title: &'a str,
    units: Names,
    range: Option<ByName<'a, Components>>,
}

#[derive(Serialize)]
struct Components {
    fx: Ends,
    fy: Ends,
}

#[derive(Serialize)]
struct Ends {
    min: End,
    max: End,
}

#[derive(Serialize)]
struct End {
    value: Option<f64>,
    bound: Option<f64>,
    unlimited: bool,
}

impl Components {
    fn of(it: &Extremes, units: InUnits) -> Self {
        let ends =
            |[min, max]: [Extreme; 2]| Ends { min: End::of(min, units), max: End::of(max, units) };
        Self { fx: ends(it.fx), fy: ends(it.fy) }
    }
}

impl End {
    fn of(extreme: Extreme, units: InUnits) -> Self {
        let (value, bound) = match extreme {
            Extreme::Value { value, bound } => (Some(units.force(value)), Some(units.force(bound))),
            Extreme::Unlimited | Extreme::Open => (None, None),
        };
        Self { value, bound, unlimited: extreme == Extreme::Unlimited }
    }
}
