//! A study as text.

use comfy_table::{ContentArrangement, Table};
use lcp::refine::Refinement;

use super::summary;
use crate::analysis::study::{End, Mesh, Study, Values};
use crate::report::format::{InUnits, significant};
use crate::report::table::{paragraph, section, table as columns};

/// The whole report: what it comes to, the records, the meshes, the springs.
pub fn table(study: &Study) -> String {
    let title = format!("{}: what accuracy costs", study.title);
    let rule: String = title.chars().map(|_| '=').collect();
    let mut text = format!("{title}\n{rule}\n\n");
    for sentence in summary(study) {
        text += &paragraph(&sentence);
    }
    for mesh in &study.meshes {
        text += &section(&format!("Routes and tolerances, {}", mesh.name));
        text += &records(study, mesh);
    }
    if let Some(machine) = &study.machine {
        text += &paragraph(&format!("Times are those of {machine}."));
    }
    text += "\n Steps are pivots by lemke and iterations by the others; errors are relative to the reference of\n \
             the same mesh.\n";
    if study.records.iter().any(|record| record.overrun) {
        text += &paragraph(&format!(
            "! took more than the limit of {} s: one factorisation, reduction or program was not interrupted.",
            significant(study.time_limit.as_secs_f64(), 3)
        ));
    }
    for line in not_tried(study) {
        text += &paragraph(&line);
    }
    text += &section("References");
    text += &references(study);
    if study.meshes.iter().any(|mesh| !mesh.refinings.is_empty()) {
        text += &section("The last digits");
        text += &refinings(study);
    }
    text += &section("Meshes");
    text += &meshes(study);
    if !study.springs.is_empty() {
        text += &section("Soft springs, by qp");
        text += &springs(study);
    }
    text
}

fn records(study: &Study, mesh: &Mesh) -> String {
    let heads = [
        "route",
        "tolerance",
        "status",
        "residual",
        "time [s]",
        "steps",
        "force",
        "stress",
        "energy",
    ];
    let mut table = wide(&heads, &[1, 3, 4, 5, 6, 7, 8]);
    for record in study.records.iter().filter(|record| record.mesh == mesh.factor) {
        let errors = record.errors;
        table.add_row(vec![
            record.route.name().to_owned(),
            format!("{:e}", record.tolerance),
            record.end.name(),
            power(record.residual),
            number(record.seconds, 3) + if record.overrun { " !" } else { "" },
            record.iterations.map_or_else(dash, |count| count.to_string()),
            power(errors.and_then(|it| it.force)),
            power(errors.and_then(|it| it.stress)),
            power(errors.and_then(|it| it.energy)),
        ]);
    }
    table.trim_fmt() + "\n"
}

/// What was skipped: for each route and reason the meshes.
fn not_tried(study: &Study) -> Vec<String> {
    let mut all: Vec<(&str, &str, Vec<u32>)> = Vec::new();
    for record in &study.records {
        let End::Skipped(reason) = &record.end else { continue };
        let route = record.route.name();
        match all.iter_mut().find(|it| it.0 == route && it.1 == reason) {
            Some((.., meshes)) if meshes.contains(&record.mesh) => {}
            Some((.., meshes)) => meshes.push(record.mesh),
            None => all.push((route, reason, vec![record.mesh])),
        }
    }
    let line = |(route, reason, meshes): (&str, &str, Vec<u32>)| {
        let meshes: Vec<String> = meshes.iter().map(u32::to_string).collect();
        format!("Not tried: {route} on mesh {}, since {reason}.", meshes.join(", "))
    };
    all.into_iter().map(line).collect()
}

fn references(study: &Study) -> String {
    let heads = [
        "mesh", "route", "residual", "refined", "margin", "digits", "distance", "other", "distance",
    ];
    let mut table = wide(&heads, &[0, 2, 3, 4, 5, 6, 8]);
    for mesh in &study.meshes {
        let Some(it) = &mesh.reference else { continue };
        let (verified, other) = (it.verified.as_ref(), it.confirmed.as_ref());
        let holds = verified.is_none_or(|it| it.holds);
        table.add_row(vec![
            mesh.factor.to_string(),
            it.route.name().to_owned(),
            power(Some(it.residual)),
            power(verified.map(|it| it.residual)),
            power(verified.and_then(|it| it.margin)) + if holds { "" } else { " violated" },
            verified.map_or_else(dash, |it| format!("{:.0}", it.digits)),
            power(verified.and_then(|it| it.distance)),
            other.map_or_else(dash, |it| it.route.name().to_owned()),
            power(other.and_then(|it| it.refined.or(it.errors.worst()))),
        ]);
    }
    table.trim_fmt()
        + "\n Refined is the residual after refinement with numbers of twice the digits. Margin is what the\n \
           inequalities of the contact law leave then at the contact that is nearest to another state,\n \
           relative to the largest force or displacement: but for rounding, a solution has none below zero.\n \
           Digits are those of its forces that are certain; where redundant contacts contradict each other, rounding errors\n \
           of the data take the rest. The first distance is that of the route's answer from it, the second\n \
           that of another route's, refined as well.\n"
}

fn refinings(study: &Study) -> String {
    let heads = ["mesh", "what is solved", "solves", "time [s]", "residual", "error"];
    let mut table = wide(&heads, &[0, 2, 3, 4, 5]);
    for mesh in study.meshes.iter().filter(|mesh| !mesh.refinings.is_empty()) {
        if let Some(route) = &mesh.reference {
            table.add_row(vec![
                mesh.factor.to_string(),
                format!("all, by {}", route.route.name()),
                dash(),
                number(Some(route.seconds), 3),
                power(Some(route.residual)),
                power(route.verified.as_ref().and_then(|it| it.distance)),
            ]);
        }
        for it in &mesh.refinings {
            let what = match it.refinement {
                Refinement::Plain => "states known: one solve",
                Refinement::Single => "and one refinement",
                Refinement::Extended => "and compensated refinement",
            };
            table.add_row(vec![
                mesh.factor.to_string(),
                what.to_owned(),
                it.passes.to_string(),
                number(Some(it.seconds), 3),
                power(Some(it.residual)),
                power(it.error),
            ]);
        }
    }
    table.trim_fmt()
        + "\n Errors are those of the forces on the nodes, against the refined reference. With the states of all\n \
           contacts known there is one factorisation, with springs in the place of hard contacts: what they\n \
           leave open after one solve, the next ones close. A route refines by itself, and has to find the\n \
           states first. Where redundant contacts contradict each other, the residual stops falling, and\n \
           solves begin anew without what is left, or with softer springs: that takes many.\n"
}

fn meshes(study: &Study) -> String {
    let units = InUnits(study.units);
    let (energy, force) = (study.units.energy_name(), study.units.force_name());
    let heads = [
        "mesh",
        "elements",
        "reference",
        &format!("energy [{energy}]"),
        "error",
        "extrap.",
        &format!("thrust [{force}]"),
        "error",
        "extrap.",
        &format!("moved [{}]", study.units.length_name()),
        "error",
        "extrap.",
    ];
    let mut table = wide(&heads, &[0, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
    for mesh in &study.meshes {
        let (values, errors, limit) = (mesh.values, mesh.errors, mesh.extrapolated);
        let value = |of: fn(InUnits, Values) -> f64| number(values.map(|it| of(units, it)), 5);
        table.add_row(vec![
            mesh.factor.to_string(),
            mesh.elements.to_string(),
            mesh.reference.as_ref().map_or_else(dash, |it| it.route.name().to_owned()),
            value(|units, it| units.energy(it.strain_energy)),
            power(errors.and_then(|it| it.energy)),
            power(limit.and_then(|it| it.energy)),
            value(|units, it| units.force(it.thrust)),
            power(errors.and_then(|it| it.thrust)),
            power(limit.and_then(|it| it.thrust)),
            value(|units, it| units.length(it.displacement)),
            power(errors.and_then(|it| it.displacement)),
            power(limit.and_then(|it| it.displacement)),
        ]);
    }
    let refused =
        study.meshes.iter().filter_map(|mesh| Some((mesh.factor, mesh.refusal.as_ref()?)));
    let refused: String =
        refused.map(|(factor, why)| paragraph(&format!("Mesh {factor}: {why}"))).collect();
    table.trim_fmt()
        + "\n Errors are relative to the finest mesh that has a reference, which has an error too. Those\n \
           extrapolated are relative to what the three finest converge to, where differences fall at a rate\n \
           of some order (0.5 to 2.5). Thrust is that of the supports left of the middle; moved, a corner of\n \
           a loaded block that moves most.\n"
        + &refused
}

fn springs(study: &Study) -> String {
    let heads = ["stiffness", "status", "time [s]", "rounds", "share", "bias", "error after"];
    let mut table = wide(&heads, &[0, 2, 3, 4, 5, 6]);
    for it in &study.springs {
        table.add_row(vec![
            format!("{:e}", it.stiffness),
            it.end.name(),
            number(it.seconds, 3),
            it.rounds.map_or_else(dash, |rounds| rounds.to_string()),
            power(it.share),
            power(it.bias),
            power(it.errors.and_then(|errors| errors.worst())),
        ]);
    }
    let reasons = study.springs.iter().filter_map(|it| Some((it.stiffness, it.end.reason()?)));
    let reasons: String = reasons
        .map(|(stiffness, why)| paragraph(&format!("Springs of {stiffness:e}: {why}.")))
        .collect();
    let asked = study.springs.first().map_or(String::new(), |it| {
        paragraph(&format!(
            "Asked for a residual of {:e}. Share and bias are those before springs are centred anew: of the load that \
             they carry, and of the displacements that they change. They take solves more, for which time may be short.",
            it.tolerance
        ))
    });
    table.trim_fmt() + "\n" + &asked + &reasons
}

/// A table whose lines are never broken.
fn wide(heads: &[&str], right: &[usize]) -> Table {
    let mut table = columns(heads, right);
    table.set_content_arrangement(ContentArrangement::Disabled);
    table
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(dash, |value| significant(value, digits))
}

fn power(value: Option<f64>) -> String {
    value.map_or_else(dash, |value| format!("{value:.1e}"))
}

fn dash() -> String {
    "-".to_owned()
}
