//! The records of a study, what the last digits cost, and soft springs, as comma-separated values.

use lcp::refine::Refinement;

use crate::analysis::study::{End, Record, Refining, Springs, Study};
use crate::report::csv::quoted;
use crate::report::format::shortest;

const END: &str = "\r\n";

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
        text += END;
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
        reason(&record.end),
    ]
}

fn reason(end: &End) -> String {
    end.reason().map_or_else(String::new, |it| quoted(it).into_owned())
}

/// The text of `refinement.csv`: one row for each mesh with a verified reference and each way to solve the
/// equations of its states; `None` where there is none.
///
/// Columns: `mesh` (factor), `refinement` (`plain`, `single`, `extended`), `solves`, `time_s`, `residual`,
/// `error`. Numbers read back exactly, and lines end with CR LF.
pub fn refinement_csv(study: &Study) -> Option<String> {
    let row = |factor: u32, it: &Refining| {
        let name = match it.refinement {
            Refinement::Plain => "plain",
            Refinement::Single => "single",
            Refinement::Extended => "extended",
        };
        let numbers = [Some(it.seconds), Some(it.residual), it.error];
        let [seconds, residual, error] = numbers.map(number);
        format!("{factor},{name},{},{seconds},{residual},{error}{END}", it.passes)
    };
    let meshes = study.meshes.iter();
    let rows: String =
        meshes.flat_map(|mesh| mesh.refinings.iter().map(|it| row(mesh.factor, it))).collect();
    (!rows.is_empty()).then(|| format!("mesh,refinement,solves,time_s,residual,error{END}{rows}"))
}

/// The text of `springs.csv`: one row for each stiffness; `None` where there is none.
///
/// Columns: `stiffness`, `tolerance` (of the answer), `status`, `time_s`, `rounds`, `share`, `bias`, the relative errors of the answer
/// `error_force`, `error_stress`, `error_energy`, and the `reason` why it was refused or skipped. What is not known is
/// empty. Numbers read back exactly, and lines end with CR LF.
pub fn springs_csv(study: &Study) -> Option<String> {
    let row = |it: &Springs| {
        let fields = [
            shortest(it.stiffness),
            shortest(it.tolerance),
            it.end.name(),
            number(it.seconds),
            it.rounds.map_or_else(String::new, |rounds| rounds.to_string()),
            number(it.share),
            number(it.bias),
            number(it.errors.and_then(|it| it.force)),
            number(it.errors.and_then(|it| it.stress)),
            number(it.errors.and_then(|it| it.energy)),
            reason(&it.end),
        ];
        fields.join(",") + END
    };
    let rows: String = study.springs.iter().map(row).collect();
    (!rows.is_empty()).then(|| {
        format!(
            "stiffness,tolerance,status,time_s,rounds,share,bias,error_force,error_stress,error_energy,reason{END}{rows}"
        )
    })
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, shortest)
}
