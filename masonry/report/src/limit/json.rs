//! A limit load, or the ranges of reactions, as one JSON object.

use crate::figures::tables::{reactions, sides};
use crate::figures::{self, Value, in_json, members, taken};
use crate::format::InUnits;
use crate::json::times;
use masonry::analysis::limit::{
    Associative, Directions, Extremes, Governs, JointEvent, Limit, Path, Range, Thickness,
};
use masonry::data::statics::Extreme;
use masonry::model::Model;

/// A value of JSON, or the error of the serialiser.
type Written = Result<Value, serde_json::Error>;

/// Returns the object of `limit.json` and of `masonry limit --json`, pretty-printed. Members:
///
/// * `associative`: the `answer`, the `load_factor` that forces carry, the `bound` above which it is proved that no
///   forces balance the loads, the `gap` between the two, whether the answer is `proved`, the `reactions` under the
///   load factor, and the `mechanism`: rates of the corners of every block, scaled to a largest component of one. If
///   the mechanism moves a single block, or at most a tenth of the blocks, `rest` has the `load_factor` and the `bound`
///   of the other blocks while the moving blocks are held.
/// * `path`: the `load_factor` up to which blocks rest, the factor at which the structure `falls`, whether the limit is
///   `decided`, the `last_stable` state, the `mechanism` after that state, the `events` along the path and the `curve`.
/// * `seismic`: the check of a group of accelerations: the `law` of factor and mechanism, `alpha_0`, the `weight` that
///   moves, `mass` M* in kg, `fraction` e*, `FC`, `a_0` in m/s^2, the least `a_0_least` of all mechanisms of the limit,
///   the data of the site, the `demand`, and whether the demand is `satisfied`: null if this mechanism satisfies it,
///   but not every mechanism.
/// * `units`: the names of the units.
///
/// Unknown values are null; `associative` or `path` is null if that law of friction was not chosen.
///
/// # Errors
/// No error occurs for this data; the `Result` is that of the serialiser.
pub fn json(limit: &Limit, files: &[String]) -> Result<String, serde_json::Error> {
    report(limit, files)?.file()
}

/// Returns the object of `masonry limit --both --json`, pretty-printed: the object of [`json`] for the `given`
/// direction of the load and for the `opposite` direction, and the direction that `governs` (`both` if the directions
/// carry the same, `unknown` if one direction is not decided). The files are those of the governing direction; without
/// a governing direction, those of the given direction.
///
/// # Errors
/// As [`json`].
pub fn json_both(both: &Directions, files: &[String]) -> Result<String, serde_json::Error> {
    let is_opposite = both.governs == Governs::Opposite;
    let (of_given, of_opposite) = if is_opposite { (&[][..], files) } else { (files, &[][..]) };
    Value::Object(members! {
        "governs": Value::of(&both.governs)?,
        "given": report(&both.given, of_given)?,
        "opposite": report(&both.opposite, of_opposite)?,
    })
    .file()
}

fn report(limit: &Limit, files: &[String]) -> Written {
    let model = &limit.model;
    let found = limit.associative.as_ref().map(|found| associative(found, model)).transpose()?;
    let units = InUnits(model.units);
    let seismic = limit.seismic.as_ref().map(|it| figures::seismic::seismic(it, units));
    Ok(Value::Object(members! {
        "sentence": &limit.sentence,
        "warnings": limit.warnings.as_slice(),
        "interrupted": limit.is_interrupted,
        "title": &limit.title,
        "group": &limit.group,
        "units": names_of_units(model),
        "associative": found,
        "path": limit.path.as_ref().map(path).transpose()?,
        "seismic": seismic.map(in_json),
        "time_s": times(&limit.times),
        "files": files,
    }))
}

fn associative(found: &Associative, model: &Model) -> Written {
    let mut figures = figures::limit::associative(found, model);
    let mut object = members! { "answer": Value::of(&found.answer)? };
    object.extend(taken(&mut figures, "load_factor bound gap proved"));
    let reactions = reactions(InUnits(model.units), &found.reactions);
    object.extend(members! { "reactions": reactions.by_name() });
    object.extend(taken(&mut figures, "mechanism"));
    object.extend(in_json(figures));
    Ok(Value::Object(object))
}

fn path(path: &Path) -> Written {
    let mut figures = figures::limit::path(path);
    let units = InUnits(path.model.units);
    let curve = figures::limit::curve(path).objects();
    let last = curve.last().map(|state| {
        let mut state = state.clone();
        state.extend(members! { "reactions": reactions(units, &path.reactions).by_name() });
        state
    });
    let events: Result<Vec<_>, _> = path.events.iter().map(|it| event(&path.model, it)).collect();
    let mut object = taken(&mut figures, "load_factor falls decided");
    object.extend(members! { "last_stable": last });
    object.extend(taken(&mut figures, "mechanism"));
    object.extend(in_json(figures));
    object.extend(members! {
        "events": Value::List(events?),
        "curve": Value::List(curve.into_iter().map(Value::Object).collect()),
        "dry_joints": path.model.dry_joints(),
    });
    Ok(Value::Object(object))
}

/// Returns an event of a path: the two bodies that meet, the middle of their joint, and the behaviour of the joint
/// between two load factors.
fn event(model: &Model, event: &JointEvent) -> Written {
    let units = InUnits(model.units);
    let joint = &model.joints[event.joint.index()];
    let middle = nalgebra::center(&joint.from, &joint.to);
    let at = [middle.x, middle.y].map(|it| units.length(it).into());
    Ok(Value::Object(members! {
        "between": Value::List(sides(model, joint).map(Value::from).to_vec()),
        "at": Value::List(at.to_vec()),
        "change": Value::of(&event.change)?,
        "after": event.after,
        "before": event.before,
    }))
}

fn names_of_units(model: &Model) -> Value {
    let units = model.units;
    Value::Object(members! {
        "load_factor": "1",
        "length": units.length_name(),
        "force": units.force_name(),
        "moment": units.energy_name(),
        "mass": "kg",
        "a_0": "m/s2",
        "a_0_least": "m/s2",
        "time_s": "s",
    })
}

/// Returns the object of `masonry limit --range --json`, pretty-printed: for every support the `min` and `max` of `fx`
/// and `fy`, each with its `value`, the `bound` that no forces exceed, and whether it is `unlimited`. `range` is null
/// if no forces balance the loads. `value` and `bound` are null for a `min` or `max` that is unlimited, or that an
/// `interrupted` search did not find.
///
/// # Errors
/// As [`json`].
pub fn range_json(range: &Range) -> Result<String, serde_json::Error> {
    let units = InUnits(range.model.units);
    let components = |it: &Extremes| {
        let object = members! { "fx": ends(it.fx, units), "fy": ends(it.fy, units) };
        (it.support.clone(), Value::Object(object))
    };
    let supports = range.supports.as_ref();
    Value::Object(members! {
        "sentence": &range.sentence,
        "interrupted": range.is_interrupted,
        "title": &range.title,
        "units": names_of_units(&range.model),
        "range": supports.map(|list| list.iter().map(components).collect::<Vec<_>>()),
    })
    .file()
}

fn ends([min, max]: [Extreme; 2], units: InUnits) -> Value {
    let end = |extreme: Extreme| {
        let (value, bound) = match extreme {
            Extreme::Value { value, bound } => (Some(units.force(value)), Some(units.force(bound))),
            Extreme::Unlimited | Extreme::Open => (None, None),
        };
        let is_unlimited = extreme == Extreme::Unlimited;
        members! { "value": value, "bound": bound, "unlimited": is_unlimited }
    };
    Value::Object(members! { "min": end(min), "max": end(max) })
}

/// Returns the object of `masonry limit --thickness ARCH --json`, pretty-printed: the largest thickness at which the
/// arch `falls`, the smallest at which it `stands`, and whether it is `proved` that these two thicknesses are equal.
///
/// # Errors
/// As [`json`].
pub fn thickness_json(it: &Thickness, files: &[String]) -> Result<String, serde_json::Error> {
    let mut object = members! {
        "sentence": &it.sentence,
        "interrupted": it.is_interrupted,
        "title": &it.title,
        "arch": &it.arch,
        "length": it.model.units.length_name(),
    };
    let mut figures = figures::limit::thickness(it);
    object.extend(taken(&mut figures, "falls"));
    object.extend(in_json(figures));
    let rates = it.mechanism.as_ref();
    object.extend(members! {
        "mechanism": rates.map(|rates| figures::tables::rates_by_name(&it.model, rates)),
        "files": files,
    });
    Value::Object(object).file()
}
