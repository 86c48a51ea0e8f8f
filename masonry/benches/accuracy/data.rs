//! The same numbers as comma-separated values; what is not known is empty, and numbers read back exactly.

use lcp::refine::Refinement;
use masonry_report::study;

use super::digits::Refining;
use super::springs::Springs;
use super::{Panel, springs};

/// Names and contents of all files of a panel.
pub(crate) fn files(panel: &Panel) -> Vec<(String, String)> {
    let tables = [
        (String::new(), study::csv(&panel.study)),
        ("_refinement".to_owned(), refinements(panel)),
        ("_springs".to_owned(), springs(panel)),
    ];
    let named = |(what, table)| (format!("accuracy_{}{what}.csv", panel.name), table);
    tables.map(named).into()
}

fn refinements(panel: &Panel) -> String {
    let row = |factor: u32, it: &Refining| {
        let name = match it.refinement {
            Refinement::Plain => "plain",
            Refinement::Single => "single",
            Refinement::Extended => "extended",
        };
        let Refining { passes, seconds, residual, .. } = it;
        format!("{factor},{name},{passes},{seconds:e},{residual:e},{}\r\n", number(it.error))
    };
    let meshes = panel.study.meshes.iter().zip(&panel.refinings);
    let rows = meshes.flat_map(|(mesh, all)| all.iter().map(move |it| row(mesh.factor, it)));
    rows.fold("mesh,refinement,solves,time_s,residual,error\r\n".to_owned(), |text, it| text + &it)
}

fn springs(panel: &Panel) -> String {
    let row = |it: &Springs| {
        let errors = it.errors;
        let fields = [
            format!("{:e}", it.stiffness),
            format!("{:e}", springs::TOLERANCE),
            it.end.name(),
            number(it.seconds),
            it.rounds.map_or_else(String::new, |rounds| rounds.to_string()),
            number(it.share),
            number(it.bias),
            number(errors.and_then(|it| it.force)),
            number(errors.and_then(|it| it.stress)),
            number(errors.and_then(|it| it.energy)),
            it.end.reason().map_or_else(String::new, |it| format!("\"{it}\"")),
        ];
        fields.join(",") + "\r\n"
    };
    let heads = "stiffness,tolerance,status,time_s,rounds,share,bias,error_force,error_stress,error_energy,reason\r\n";
    panel.springs.iter().map(row).fold(heads.to_owned(), |text, it| text + &it)
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |it| format!("{it:e}"))
}
