//! A study as one JSON object.

use serde::Serialize;

use super::summary;
use crate::analysis::study::{Mesh, Record, Study, Values};
use crate::report::format::InUnits;

/// The object of `study.json` and of `masonry study --json`, pretty-printed: `title`, `units`,
/// `time_limit_s`, `machine`, `interrupted`, `records`, `meshes`, `summary`, `files`. Times are in seconds, errors and
/// residuals without dimension, and the values of meshes in the units of the scene, which
/// `units` names.
///
/// # Errors
/// None that this data can cause; the signature is that of the serialiser.
pub fn json(study: &Study, files: &[&str]) -> Result<String, serde_json::Error> {
    let units = InUnits(study.units);
    let report = Report {
        title: &study.title,
        units: Names {
            strain_energy: study.units.energy_name(),
            thrust: study.units.force_name(),
            displacement: study.units.length_name(),
            seconds: "s",
        },
        time_limit_s: study.time_limit.as_secs_f64(),
        machine: study.machine.as_deref(),
        interrupted: study.is_interrupted,
        records: &study.records,
        meshes: study.meshes.iter().map(|mesh| in_units(mesh, units)).collect(),
        summary: summary(study),
        files,
    };
    Ok(serde_json::to_string_pretty(&report)? + "\n")
}

#[derive(Serialize)]
struct Report<'a> {
    title: &'a str,
    units: Names,
    time_limit_s: f64,
    machine: Option<&'a str>,
    interrupted: bool,
    records: &'a [Record],
    meshes: Vec<Mesh>,
    summary: Vec<String>,
    files: &'a [&'a str],
}

#[derive(Serialize)]
struct Names {
    strain_energy: String,
    thrust: &'static str,
    displacement: &'static str,
    seconds: &'static str,
}

fn in_units(mesh: &Mesh, units: InUnits) -> Mesh {
    let converted = |values: Values| Values {
        strain_energy: units.energy(values.strain_energy),
        thrust: units.force(values.thrust),
        displacement: values.displacement.map(|it| units.length(it)),
    };
    let mut mesh = mesh.clone();
    mesh.values = mesh.values.map(converted);
    mesh
}
