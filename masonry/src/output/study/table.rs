//! A study as text.

use comfy_table::{ContentArrangement, Table};

use super::summary;
use crate::output::format::{InUnits, significant};
use crate::output::table::{paragraph, section, table as columns};
use crate::study::{Mesh, Study, Values};

/// The whole report: what it comes to, the records, the meshes, the springs.
pub fn table(study: &Study) -> String {
    let title = format!("{}: what accuracy costs", study.title);
    let rule: String = title.chars().map(|_| '=').collect();
    let mut text = format!("{title}\n{rule}\n\n");
    for sentence in summary(study) {
        text += &paragraph(&sentence);
    }
    for mesh in &study.meshes {
        text += &section(&format!("Routes and tolerances, mesh of factor {}", mesh.factor));
        text += &records(study, mesh);
    }
    text += "\n Steps are pivots by lemke and iterations by the others; errors are relative to the reference of\n \
             the same mesh.\n";
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
            number(record.seconds, 3),
            record.iterations.map_or_else(dash, |count| count.to_string()),
            power(errors.and_then(|it| it.force)),
            power(errors.and_then(|it| it.stress)),
            power(errors.and_then(|it| it.energy)),
        ]);
    }
    table.trim_fmt() + "\n"
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
            value(|units, it| units.length(it.displacement)),
            power(errors.and_then(|it| it.displacement)),
        ]);
    }
    let refused =
        study.meshes.iter().filter_map(|mesh| Some((mesh.factor, mesh.refusal.as_ref()?)));
    let refused: String =
        refused.map(|(factor, why)| paragraph(&format!("Mesh {factor}: {why}"))).collect();
    table.trim_fmt()
        + "\n Errors are relative to the finest mesh that has a reference. Thrust is that of the supports left\n \
           of the middle; moved, a corner of a loaded block that moves most.\n"
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
    table.trim_fmt() + "\n"
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
