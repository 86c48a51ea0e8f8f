//! The records of a study as comma-separated values.

use crate::analysis::study::{Record, Study};
use crate::report::csv::quoted;
use crate::report::format::shortest;

/// The text of `study.csv`: one row for each mesh, route and tolerance.
///
/// Columns: `mesh` (factor), `route`, `tolerance`, `status` (a status, `Refused` or `Skipped`), `residual`,
/// `time_s`, `overrun` (whether that is more than the limit), `iterations` (pivots by `lemke`), relative errors `error_force`, `error_stress`, `error_energy`,
/// and the `reason` why it was refused or skipped. What is not known is empty. Numbers read back exactly,
/// and lines end with CR LF.
pub fn csv(study: &Study) -> String {
    let mut text = "mesh,route,tolerance,status,residual,time_s,overrun,iterations,error_force,\
                    error_stress,error_energy,reason\r\n"
        .to_owned();
    for record in &study.records {
        text += &row(record).join(",");
        text += "\r\n";
    }
    text
}

fn row(record: &Record) -> [String; 12] {
    let errors = record.errors;
    [
        record.mesh.to_string(),
        record.route.name().to_owned(),
        shortest(record.tolerance),
        record.end.name(),
        number(record.residual),
        number(record.seconds),
        record.overrun.to_string(),
        record.iterations.map_or_else(String::new, |count| count.to_string()),
        number(errors.and_then(|it| it.force)),
        number(errors.and_then(|it| it.stress)),
        number(errors.and_then(|it| it.energy)),
        record.end.reason().map_or_else(String::new, |it| quoted(it).into_owned()),
    ]
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, shortest)
}
