//! The result of a scene as one JSON object.

use super::figures::tables::{forces, loads, rates_by_name, reactions};
use super::figures::{Members, Value, history, in_json, members, solved, taken};
use super::format::InUnits;
use super::summary::{self, CornerSum, LoadGroup, Resultant, corner_sums, load_groups, reason};
use masonry::analysis::outcome::{Outcome, PhaseTime};
use masonry::model::Model;

/// Returns the object of `result.json` and of `masonry solve --json`, pretty-printed.
///
/// `verdict`, `evidence`, `sentence` and `warnings` come first, as in [`Judgement`](masonry::data::verdict::Judgement).
///
/// Physical quantities are in the units of the scene, which `units` names one by one. Without a solution, `residuals`,
/// `balance`, `reactions`, `contacts`, `strain_energy`, `max_displacement` and the stresses are null, and `reason`
/// gives the cause. If a mechanism is known, `mechanism` gives displacement rates of the corners of every block, scaled
/// to a largest component of one. `films`, the extremes of the stresses in mortar films, exists only if there are
/// films. `history` exists only if there is a load history, and has one record per step; if a step failed, the state is
/// that after the step before. `springs`, `proved` and `soft` are the fields of
/// [`SolveInfo`](masonry::analysis::outcome::SolveInfo). Numbers that are not finite become null.
///
/// # Errors
/// No error occurs for this data; the `Result` is that of the serialiser.
pub fn result(outcome: &Outcome, files: &[String]) -> Result<String, serde_json::Error> {
    let (model, solve, judgement) = (&outcome.model, &outcome.solve, &outcome.judgement);
    let (units, state) = (InUnits(model.units), outcome.state.as_ref());
    let mut figures = [solved::checks(outcome), solved::state(outcome)].concat();
    let mut object = members! {
        "verdict": Value::of(&judgement.verdict)?,
        "evidence": Value::of(&judgement.evidence)?,
        "sentence": &judgement.sentence,
        "warnings": judgement.warnings.as_slice(),
        "status": Value::of(&solve.status)?,
    };
    let attempts: Vec<String> = solve.attempts.iter().map(ToString::to_string).collect();
    object.extend(reason(outcome).map(|why| ("reason".to_owned(), why.into())));
    object.extend(members! {
        "title": &outcome.title,
        "units": names_of_units(units),
        "plan": Value::of(&outcome.plan)?,
        "route": Value::of(&solve.route)?,
        "why": &solve.because,
        "routes": Value::of(&solve.routes)?,
        "form": &solve.form,
        "order": solve.order,
        "attempts": attempts.as_slice(),
        "pivots": solve.pivots,
        "iterations": solve.iterations,
    });
    if !solve.convergence.is_empty() {
        object.extend(members! { "convergence": Value::of(&solve.convergence)? });
    }
    object.extend(members! {
        "factorisations": solve.factorisations,
        "memory_bytes": outcome.plan.memory_bytes(),
        "residuals": Value::of(&state.map(|_| solve.residuals))?,
        "coulomb_residuals": Value::of(&solve.coulomb_residuals)?,
    });
    object.extend(taken(&mut figures, "balance"));
    object.extend(members! {
        "reactions": state.map(|_| reactions(units, &outcome.reactions).by_name()),
        "corners": state.map(|_| corners(outcome)),
    });
    object.extend(totals(model));
    object.extend(members! { "load_groups": groups(model) });
    let of_state = "contacts strain_energy max_displacement max_compression max_tension";
    object.extend(taken(&mut figures, of_state));
    object.extend(in_json(figures));
    object.extend(members! { "proved": solve.proved, "soft": Value::of(&solve.soft)? });
    if let Some(found) = &outcome.history {
        object.extend(members! { "history": history::in_json(model, found)? });
    }
    object.extend(members! {
        "mechanism": outcome.mechanism.as_ref().map(|rates| rates_by_name(model, rates)),
        "time_s": times(&outcome.times),
        "files": files,
    });
    Value::Object(object).file()
}

/// Returns the unit of every physical quantity in the object; `1` for pure numbers.
fn names_of_units(units: InUnits) -> Value {
    let units = units.0;
    let (length, force) = (units.length_name(), units.force_name());
    let (stress, energy) = (&units.stress_name(), &units.energy_name());
    Value::Object(members! {
        "length": length,
        "force": force,
        "stress": stress,
        "moment": energy,
        "energy": energy,
        "time": "s",
        "residuals": "1",
        "balance": "1",
        "reactions": members! { "fx": force, "fy": force, "m": energy },
        "strain_energy": energy,
        "max_displacement": length,
        "max_compression": stress,
        "max_tension": stress,
        "films": stress,
        "positions": length,
        "time_s": "s",
    })
}

/// Returns the times \[s\] of the phases by name.
pub(super) fn times(times: &[PhaseTime]) -> Value {
    Value::Object(times.iter().map(|it| (it.phase.clone(), it.seconds.into())).collect())
}

/// Returns the sums of reactions at corners, at which the single reactions are not unique.
fn corners(outcome: &Outcome) -> Value {
    let units = InUnits(outcome.model.units);
    let of = |it: CornerSum| {
        let mut object = members! { "supports": it.supports.as_slice() };
        object.extend(parts(units, it.sum));
        Value::Object(object)
    };
    Value::List(corner_sums(outcome).into_iter().map(of).collect())
}

/// Returns the resultants of all self weights and of all loads.
fn totals(model: &Model) -> Members {
    let both = [("weight", summary::weight(model)), ("loads", summary::loads(model))];
    forces(InUnits(model.units), both).by_name()
}

fn parts(units: InUnits, sum: Resultant) -> Members {
    forces(units, [("", sum)]).without("support").objects().remove(0)
}

/// Returns the load groups by name: the resultant of each group, and its loads. A load has its resultant and its
/// factor, which is multiplied by the factor of the step.
fn groups(model: &Model) -> Value {
    let units = InUnits(model.units);
    let of = |group: LoadGroup<'_>| {
        let loads = loads(units, std::slice::from_ref(&group), false).without("group").by_name();
        let mut object = parts(units, group.sum);
        object.extend(members! { "loads": loads });
        (group.name.to_owned(), Value::Object(object))
    };
    Value::Object(load_groups(model).into_iter().map(of).collect())
}
