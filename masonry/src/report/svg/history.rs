//! The curves of a load history: loads or reactions against displacements, and both step by step.

use super::curve::{Chart, Curve, charts};
use crate::data::state::Reaction;
use crate::history::{History, StepRecord};
use crate::model::Model;
use crate::report::format::InUnits;
use crate::scene::Movement;

/// Curves of one chart are at most so many.
const MOST: usize = 7;
/// What changes by less than this part of the largest value is constant.
const CONSTANT: f64 = 1e-9;

/// Factors of loads against the largest displacement, reactions against the movement of a support, and the largest
/// displacement and the reactions step by step. `None` for less than two steps.
pub fn history(title: &str, model: &Model, history: &History) -> Option<String> {
    curves(title, model, history, false)
}

/// The same, for a page with marks of the steps.
pub(in crate::report) fn curves(
    title: &str,
    model: &Model,
    history: &History,
    for_page: bool,
) -> Option<String> {
    let units = InUnits(model.units);
    let records = &history.records;
    let (length, force) = (units.0.length_name(), units.0.force_name());
    let displacement = format!("largest displacement [{length}]");
    let moved = |record: &StepRecord| units.length(record.largest_displacement);
    let steps: Vec<f64> = (1_u32..).take(records.len()).map(f64::from).collect();
    let by_step = |curves: Vec<Curve>, name: &str| Chart {
        axes: ["step".to_owned(), name.to_owned()],
        curves,
        stages: stages(records),
        steps: steps.clone(),
    };

    let mut list = Vec::new();
    let factors: Vec<Curve> = varying(factors(history), records, moved);
    if !factors.is_empty() {
        list.push(Chart {
            axes: [displacement.clone(), "factor of loads [-]".to_owned()],
            curves: factors,
            stages: Vec::new(),
            steps: records.iter().map(moved).collect(),
        });
    }
    if let Some((support, axis, place)) = most_moved(model, records, units) {
        let at = |record: &StepRecord| place(record.step.actions.movements[support]);
        let own = components(&[support], model, units);
        list.push(Chart {
            axes: [axis, format!("reaction of \"{}\" [{force}]", model.supports[support].name)],
            curves: own.iter().map(|(name, of)| curve(name, records, at, of)).collect(),
            stages: Vec::new(),
            steps: records.iter().map(at).collect(),
        });
    }
    let step = |record: &StepRecord| {
        let position = records.iter().position(|it| it.step == record.step);
        position.map_or(0.0, |k| steps[k])
    };
    list.push(by_step(vec![curve("displacement", records, step, moved)], &displacement));
    let all: Vec<usize> = (0..model.supports.len()).collect();
    let reactions = varying(components(&all, model, units), records, step);
    list.push(by_step(reactions, &format!("reactions [{force}]")));
    if !for_page {
        for chart in &mut list {
            chart.steps.clear();
        }
    }
    charts(&format!("{title}: load history"), &list)
}

/// A name, and what a record says about it.
type Quantity<'a> = (String, Box<dyn Fn(&StepRecord) -> f64 + 'a>);

fn factors(history: &History) -> Vec<Quantity<'_>> {
    let gravity: Quantity = ("gravity".to_owned(), Box::new(|it| it.step.actions.gravity));
    let loads = history.loads.iter().enumerate().map(|(k, name)| -> Quantity {
        (name.clone(), Box::new(move |it: &StepRecord| it.step.actions.loads[k]))
    });
    std::iter::once(gravity).chain(loads).collect()
}

/// The horizontal and the vertical reactions of supports.
fn components<'a>(supports: &[usize], model: &'a Model, units: InUnits) -> Vec<Quantity<'a>> {
    let mut list: Vec<Quantity<'a>> = Vec::new();
    for &support in supports {
        let name = &model.supports[support].name;
        let of = |part: fn(&Reaction) -> f64| {
            move |it: &StepRecord| it.reactions.get(support).map_or(0.0, |it| units.force(part(it)))
        };
        list.push((format!("{name} fx"), Box::new(of(|it| it.fx))));
        list.push((format!("{name} fy"), Box::new(of(|it| it.fy))));
    }
    list
}

fn curve(
    name: &str,
    records: &[StepRecord],
    x: impl Fn(&StepRecord) -> f64,
    y: impl Fn(&StepRecord) -> f64,
) -> Curve {
    Curve {
        name: name.to_owned(),
        points: records.iter().map(|record| [x(record), y(record)]).collect(),
    }
}

/// The curves of what is not the same in all steps, those first that change most.
fn varying(
    quantities: Vec<Quantity<'_>>,
    records: &[StepRecord],
    x: impl Fn(&StepRecord) -> f64,
) -> Vec<Curve> {
    let mut list: Vec<(f64, Curve)> = Vec::new();
    let mut largest = 0.0_f64;
    for (name, of) in quantities {
        let curve = curve(&name, records, &x, of);
        let values = || curve.points.iter().map(|it| it[1]);
        largest = values().fold(largest, |largest, value| largest.max(value.abs()));
        let low = values().fold(f64::INFINITY, f64::min);
        let change = values().fold(f64::NEG_INFINITY, f64::max) - low;
        list.push((change, curve));
    }
    list.retain(|(change, _)| *change > CONSTANT * largest);
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    list.into_iter().map(|(_, curve)| curve).take(MOST).collect()
}

/// A support, the name of what it does with the unit, and that of a movement.
type Moved<'a> = (usize, String, Box<dyn Fn(Movement) -> f64 + 'a>);

/// The support that moves furthest, and how: to the right, up, or by turning alone.
fn most_moved<'a>(model: &Model, records: &[StepRecord], units: InUnits) -> Option<Moved<'a>> {
    let name = |support: usize| &model.supports[support].name;
    let length = units.0.length_name();
    let furthest = |part: fn(Movement) -> f64| {
        let largest = |support: usize| {
            let places = records.iter().map(|it| part(it.step.actions.movements[support]).abs());
            (support, places.fold(0.0, f64::max))
        };
        (0..model.supports.len()).map(largest).max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let (right, up, turned) = (furthest(|it| it.x)?, furthest(|it| it.y)?, furthest(|it| it.turn)?);
    if up.1 > 0.0 && up.1 >= right.1 {
        let axis = format!("\"{}\" moves up by [{length}]", name(up.0));
        Some((up.0, axis, Box::new(move |it: Movement| units.length(it.y))))
    } else if right.1 > 0.0 {
        let axis = format!("\"{}\" moves to the right by [{length}]", name(right.0));
        Some((right.0, axis, Box::new(move |it: Movement| units.length(it.x))))
    } else if turned.1 > 0.0 {
        let axis = format!("\"{}\" turns by [rad]", name(turned.0));
        Some((turned.0, axis, Box::new(|it: Movement| it.turn)))
    } else {
        None
    }
}

/// The first step of every stage, and its name.
fn stages(records: &[StepRecord]) -> Vec<(f64, String)> {
    let first = |(number, record): (u32, &StepRecord)| {
        (record.step.number == 1).then(|| (f64::from(number), record.step.stage.clone()))
    };
    (1..).zip(records).filter_map(first).collect()
}
