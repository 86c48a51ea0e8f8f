//! A study as one JSON object.

use super::summary;
use crate::figures::{Value, members};
use crate::format::InUnits;
use masonry::analysis::study::{Mesh, Study, Values};

/// Returns the object of `study.json` and of `masonry study --json`, pretty-printed: `title`, `units`, `time_limit_s`,
/// `machine`, `interrupted`, `records`, `meshes`, `summary`, `files`. Times are in seconds, errors and residuals are
/// dimensionless, and the values of meshes are in the units of the scene, which `units` names.
///
/// # Errors
/// No error occurs for this data; the `Result` is that of the serialiser.
pub fn json(study: &Study, files: &[&str]) -> Result<String, serde_json::Error> {
    let units = study.units;
    let meshes: Vec<Mesh> =
        study.meshes.iter().map(|mesh| in_units(mesh, InUnits(units))).collect();
    Value::Object(members! {
        "title": &study.title,
        "units": members! {
            "strain_energy": units.energy_name(),
            "thrust": units.force_name(),
            "displacement": units.length_name(),
            "seconds": "s",
        },
        "time_limit_s": study.time_limit.as_secs_f64(),
        "machine": study.machine.as_ref(),
        "interrupted": study.is_interrupted,
        "records": Value::of(&study.records)?,
        "meshes": Value::of(&meshes)?,
        "summary": summary(study).as_slice(),
        "files": Value::of(files)?,
    })
    .file()
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
