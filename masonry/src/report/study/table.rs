//! A study as text.

use comfy_table::{ContentArrangement, Table};

use super::summary;
use crate::analysis::study::{End, Mesh, Study, Values};
use crate::report::format::{InUnits, significant};
use crate::report::table::{paragraph, section, table as columns};

/// The whole report: what it comes to, the records, the meshes.
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
    text += &section("Meshes");
    text += &meshes(study);
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

fn meshes(study: &Study) -> String {
    let units = InUnits(study.units);
    let (energy, force) = (study.units.energy_name(), study.units.force_name());
    let heads = [
        "mesh",
        "elements",
        "reference",
        &format!("energy [{energy}]"),
        "error",
        &format!("thrust [{force}]"),
        "error",
        &format!("moved [{}]", study.units.length_name()),
        "error",
    ];
    let mut table = wide(&heads, &[0, 1, 3, 4, 5, 6, 7, 8]);
    for mesh in &study.meshes {
        let (values, errors) = (mesh.values, mesh.errors);
        let value = |of: fn(InUnits, Values) -> f64| number(values.map(|it| of(units, it)), 5);
        table.add_row(vec![
            mesh.factor.to_string(),
            mesh.elements.to_string(),
            mesh.reference.as_ref().map_or_else(dash, |it| it.route.name().to_owned()),
            value(|units, it| units.energy(it.strain_energy)),
            power(errors.and_then(|it| it.energy)),
            value(|units, it| units.force(it.thrust)),
            power(errors.and_then(|it| it.thrust)),
            value(|units, it| units.length(it.displacement[0].hypot(it.displacement[1]))),
            power(errors.and_then(|it| it.displacement)),
        ]);
    }
    let refused =
        study.meshes.iter().filter_map(|mesh| Some((mesh.factor, mesh.refusal.as_ref()?)));
    let refused: String =
        refused.map(|(factor, why)| paragraph(&format!("Mesh {factor}: {why}"))).collect();
    table.trim_fmt()
        + "\n Errors are relative to the finest mesh that has a reference, which has an error too. Thrust\n \
           is that of the supports left of the middle; moved, a corner of a loaded block that moves most.\n"
        + &refused
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
