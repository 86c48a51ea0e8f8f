//! Sentences that describe verdicts in the words of an engineer.

use lcp::Status;

use super::{Drift, Evidence, Findings, Verdict};
use crate::data::statics::Statics;
use crate::history::{History, HistoryStep, SecondLoading};
use crate::model::Model;
use crate::scene::Movement;

/// Returns the sentence of a verdict; for a load history, two sentences, of which the second describes the last step.
pub(super) fn of(
    known: &Findings<'_>,
    verdict: Verdict,
    evidence: Evidence,
    movement: Option<Drift>,
) -> String {
    let structure = known.structure;
    let failed = known.history.and_then(|history| history.failed.as_ref());
    let at = failed.map(at_step).unwrap_or_default();
    let first = match (verdict, evidence) {
        (Verdict::Stands, Evidence::AdmissibleForces) => match known.step.loading {
            Some(_) => format!(
                "The {structure} stands: contact forces within friction balance the loads (verified), and loading leads \
                     to rest."
            ),
            None => format!(
                "The {structure} stands: contact forces within friction balance the loads (verified)."
            ),
        },
        (Verdict::Stands, _) => match known.history {
            Some(history) => in_all_steps(structure, history),
            None => format!("The {structure} stands: equilibrium found and verified."),
        },
        (Verdict::Falls, Evidence::Motion) => format!(
            "The {structure} falls{at}: its blocks do not come to rest within small displacements (evidence, not a proof).{}",
            match known.step.statics {
                _ if known.step.loading.is_some() => {
                    " A prestress might produce contact forces within friction that balance the loads; loading from a \
                     state without stresses does not."
                }
                Some(Statics::Admissible(_)) => {
                    " Contact forces that balance the loads exist, but this loading does not lead to them."
                }
                _ => "",
            }
        ),
        (Verdict::Falls, _) => format!(
            "The {structure} falls{at}: no contact forces within friction balance the loads (proof checked)."
        ),
        (Verdict::Undecided, _) => {
            format!("Undecided{at}: {}", undecided(known, evidence, movement))
        }
    };
    match known
        .history
        .filter(|_| verdict != Verdict::Stands)
        .and_then(|it| reached(known.model, it))
    {
        Some(reached) => format!("{first} {reached}"),
        None => first,
    }
}

/// Describes the findings in all steps of a history.
fn in_all_steps(structure: &str, history: &History) -> String {
    let steps = history.steps;
    let stands = match history.steps_against_law() {
        0 => format!(
            "The {structure} stands in all {steps} steps: equilibrium found, and Coulomb's law verified, in each."
        ),
        count => format!(
            "The {structure} stands in all {steps} steps: equilibrium found and verified in each, but friction in {count} \
             of them did less work than Coulomb's law gives for the slips."
        ),
    };
    match history.second_loading {
        Some(SecondLoading::Ended(spread)) if !spread.is_unique() => format!(
            "{stands} Cracks and thrust are not unique: two loadings differ by {:.0} %.",
            100.0 * spread.largest()
        ),
        Some(SecondLoading::Stopped { solved, steps }) => format!(
            "{stands} Whether cracks and thrust are unique is not known: a second loading stopped after {solved} of {steps} \
             steps."
        ),
        _ => stands,
    }
}

/// Describes the size of a movement in words.
pub(super) fn of_movement(movement: Drift) -> String {
    let Drift { share, turned } = movement;
    format!(
        "blocks move against each other or are deformed by up to {share:.2} of their size, and turn by up to \
         {turned:.2} rad"
    )
}

fn undecided(known: &Findings<'_>, evidence: Evidence, movement: Option<Drift>) -> String {
    let info = &known.step.info;
    let tried = tried(known);
    match (info.status, evidence) {
        (Status::Solved, _) if known.step.loading.is_some() => {
            "forces within friction balance the loads; whether loading leads to these forces is not known.".to_owned()
        }
        (Status::Solved, _) => {
            let movement = movement.map(of_movement).unwrap_or_default();
            format!("an equilibrium was computed, but far beyond small displacements: {movement}.")
        }
        (Status::Cancelled, _) => "the solve was cancelled.".to_owned(),
        (Status::Infeasible, _) if info.proved => {
            "no displacements and forces satisfy gaps, supports and loads together (proved), but forces that \
             balance the loads may exist."
                .to_owned()
        }
        (_, Evidence::AdmissibleForces) if known.at_rest => format!(
            "forces within friction balance the loads, but not to the tolerance of the scene{tried}."
        ),
        (_, Evidence::AdmissibleForces) => format!(
            "forces within friction balance the loads, but no displacements were found that fit such \
             forces{tried}."
        ),
        _ => format!("neither an equilibrium nor a proof that there is none was found{tried}."),
    }
}

/// Lists the routes that were tried, with the residual of the nearest point.
fn tried(known: &Findings<'_>) -> String {
    let info = &known.step.info;
    let mut names: Vec<&str> = info.routes.iter().map(|end| end.route.name()).collect();
    names.retain(|name| *name != "forces");
    let near = info.residuals.worst();
    let near = if near.is_finite() {
        format!("; the nearest point has a residual of {near:.0e}")
    } else {
        String::new()
    };
    match names.as_slice() {
        [] => String::new(),
        names => format!(" (tried: {}{near})", names.join(", ")),
    }
}

fn at_step(step: &HistoryStep) -> String {
    format!(" in step {} of {} of stage \"{}\"", step.number, step.of, step.stage)
}

/// Describes how far a history came before the step that failed; `None` if no step failed.
fn reached(model: &Model, history: &History) -> Option<String> {
    let failed = history.failed.as_ref()?;
    let Some(last) = history.records.last() else {
        return Some("No earlier step was solved.".to_owned());
    };
    let (before, after) = (&last.step.actions, &failed.actions);
    let mut changed = Vec::new();
    let mut factor = |name: &str, [before, after]: [f64; 2]| {
        if (before - after).abs() > 0.0 {
            changed.push(format!(
                "{name} at {before:.4} times its full value (next step: {after:.4})"
            ));
        }
    };
    factor("gravity", [before.gravity, after.gravity]);
    for ((name, before), after) in history.loads.iter().zip(&before.loads).zip(&after.loads) {
        factor(&format!("load \"{name}\""), [*before, *after]);
    }
    let places = before.movements.iter().zip(&after.movements).zip(&model.supports);
    let moved = places.filter(|((before, after), _)| before != after);
    let length = model.units.length_to_si();
    changed.extend(moved.map(|((before, _), support)| {
        let Movement { x, y, turn } = before.in_lengths(1.0 / length);
        let [x, y, turn] = [x, y, turn].map(short);
        let unit = model.units.length_name();
        format!("support \"{}\" moved by ({x}, {y}) {unit} and turned by {turn} rad", support.name)
    }));
    let HistoryStep { stage, number, of, .. } = &last.step;
    let solved = history.records.len();
    let steps = history.steps;
    let place = format!(
        "It stood in {solved} of {steps} steps, up to step {number} of {of} of stage \"{stage}\""
    );
    Some(match changed.as_slice() {
        [] => format!("{place}."),
        changed => format!("{place}: {}.", changed.join("; ")),
    })
}

/// Rounds a value to six digits: interpolation between steps leaves more.
fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
