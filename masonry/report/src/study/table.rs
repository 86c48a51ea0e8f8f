//! A study as text.

use comfy_table::ContentArrangement;

use super::{figures, summary};
use crate::figures::Table;
use crate::format::significant;
use crate::text::{drawn, paragraph, section, underlined};
use masonry::analysis::study::{End, Mesh, Study};

const RECORDS: &str =
    "route asked status residual took iterations error_force error_stress error_energy";

/// Returns the whole report of a study as text: the summary, the records, the meshes.
pub fn table(study: &Study) -> String {
    let title = format!("{}: what accuracy costs", study.title);
    let mut text = underlined(&title, "=") + "\n";
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
    let of_mesh = study.records.iter().filter(|it| it.mesh == mesh.factor);
    wide(&figures::records(study, of_mesh).only(RECORDS))
}

/// Lists the solves that were skipped: the meshes by route and reason.
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
    let refused =
        study.meshes.iter().filter_map(|mesh| Some((mesh.factor, mesh.refusal.as_ref()?)));
    let refused: String =
        refused.map(|(factor, why)| paragraph(&format!("Mesh {factor}: {why}"))).collect();
    wide(&figures::meshes(study))
        + " Errors are relative to the finest mesh that has a reference, which has an error too. Thrust is\n \
           that of the supports left of the middle; \"moved\" is the displacement of the corner of a loaded\n \
           block that moves most.\n"
        + &refused
}

/// Returns a table as text whose lines are never broken.
fn wide(table: &Table) -> String {
    let mut drawn = drawn(table);
    drawn.set_content_arrangement(ContentArrangement::Disabled);
    drawn.trim_fmt() + "\n"
}
