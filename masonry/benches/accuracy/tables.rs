//! Tables of one study.

use std::fmt::Write as _;

use lcp::refine::Refinement;
use masonry::analysis::study::{End, Mesh, MeshErrors, Record, Study};

use super::Panel;

/// Time and algebraic error: a line for each route, a column for each tolerance.
pub(crate) fn by_tolerance(panel: &Study, mesh: u32) -> String {
    let on_mesh = || panel.records.iter().filter(move |it| it.mesh == mesh);
    let mut tolerances: Vec<f64> = on_mesh().map(|it| it.tolerance).collect();
    tolerances.sort_by(|a, b| b.total_cmp(a));
    tolerances.dedup_by(|a, b| a.total_cmp(b).is_eq());
    let heads: Vec<String> = tolerances.iter().map(|tolerance| format!("{tolerance:e}")).collect();
    let mut text =
        format!("| route | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(heads.len()));
    for route in panel.routes() {
        let cells: Vec<String> = on_mesh().filter(|it| it.route == route).map(cell).collect();
        let _ = writeln!(text, "| {} | {} |", route.name(), cells.join(" | "));
    }
    text + "\n"
}

/// Time, and the algebraic error or how it ended.
pub(crate) fn cell(record: &Record) -> String {
    let time = record.seconds.map(seconds);
    let error = record.errors.and_then(|errors| errors.worst());
    match (time, error.filter(|_| record.end.is_solved())) {
        (Some(time), Some(error)) => format!("{time}, {error:.0e}"),
        (Some(time), None) if record.end.is_solved() => time,
        (Some(time), None) => format!("{time}: {}", record.end.name()),
        (None, _) => record.end.name(),
    }
}

/// Seconds or milliseconds to two digits.
pub(crate) fn seconds(time: f64) -> String {
    match time {
        time if time >= 9.95 => format!("{time:.0} s"),
        time if time >= 0.995 => format!("{time:.1} s"),
        time if time >= 0.00995 => format!("{:.0} ms", 1e3 * time),
        time => format!("{:.1} ms", 1e3 * time),
    }
}

/// What was skipped or took longer than the limit, with the reason.
pub(crate) fn not_tried(study: &Study) -> String {
    let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
    for record in &study.records {
        let End::Skipped(reason) = &record.end else { continue };
        let what = match study.meshes.len() {
            1 => record.route.name().to_owned(),
            _ => format!("{} on {1} x {1}", record.route.name(), record.mesh),
        };
        match reasons.iter_mut().find(|(it, _)| it == reason) {
            Some((_, all)) if all.contains(&what) => {}
            Some((_, all)) => all.push(what),
            None => reasons.push((reason.clone(), vec![what])),
        }
    }
    let mut text = String::new();
    if !reasons.is_empty() {
        let all =
            reasons.into_iter().map(|(reason, what)| format!("{}: {reason}", what.join(", ")));
        let _ = writeln!(text, "Skipped: {}.", all.collect::<Vec<_>>().join("; "));
    }
    if study.records.iter().any(|record| record.overrun) {
        let _ = writeln!(
            text,
            "Times above the limit of {} are those of a factorisation or a program that is not interrupted.",
            seconds(study.time_limit.as_secs_f64())
        );
    }
    if text.is_empty() { text } else { text + "\n" }
}

/// Errors of the meshes.
pub(crate) fn meshes(panel: &Panel) -> String {
    let mut text = String::from(
        "| elements a square | elements | contact points | error of the energy | extrapolated | of the thrust | extrapolated | of the displacement | extrapolated |\n\
         |--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    let all: [fn(&MeshErrors) -> Option<f64>; 3] =
        [|it| it.energy, |it| it.thrust, |it| it.displacement];
    let meshes = panel.study.meshes.iter().zip(&panel.extrapolated);
    let mut meshes: Vec<(&Mesh, &MeshErrors)> = meshes.collect();
    meshes.sort_by_key(|(mesh, _)| mesh.factor);
    for (mesh, extrapolated) in meshes {
        let cells = all.map(|of| {
            let [error, limit] = [mesh.errors.as_ref().and_then(of), of(extrapolated)];
            format!("{} | {}", power(error), limit.map_or_else(String::new, |it| power(Some(it))))
        });
        let _ = writeln!(
            text,
            "| {0} x {0} | {1} | {2} | {3} |",
            mesh.factor,
            mesh.elements,
            mesh.contact_points,
            cells.join(" | "),
        );
    }
    text
}

/// Which energies are near that of the finest mesh by accident: nearer than those of a finer mesh, whose worst error
/// is smaller.
pub(crate) fn accident(panel: &Study) -> String {
    let meshes = by_factor(panel);
    let errors: Vec<(u32, MeshErrors)> =
        meshes.iter().filter_map(|mesh| Some((mesh.factor, mesh.errors?))).collect();
    let near = errors.windows(2).filter(|pair| {
        let [coarse, fine] = [pair[0].1, pair[1].1];
        coarse.energy < fine.energy && coarse.worst() > fine.worst()
    });
    let near: Vec<String> = near.map(|pair| format!("{0} x {0}", pair[0].0)).collect();
    if near.is_empty() {
        return String::new();
    }
    format!(
        "\nThe energy on {} is near that of the finest mesh by accident: thrust and displacement are not.\n",
        near.join(", ")
    )
}

/// Soft springs.
pub(crate) fn springs(panel: &Panel) -> String {
    let mut text = String::from(
        "| stiffness | ended | rounds | share of the load | bias | error after | time |\n|--:|---|--:|--:|--:|--:|--:|\n",
    );
    let dash = || "-".to_owned();
    for it in &panel.springs {
        let _ = writeln!(
            text,
            "| {:e} | {} | {} | {} | {} | {} | {} |",
            it.stiffness,
            it.end.name(),
            it.rounds.map_or_else(dash, |rounds| rounds.to_string()),
            power(it.share),
            power(it.bias),
            power(it.errors.and_then(|errors| errors.worst())),
            it.seconds.map_or_else(dash, seconds),
        );
    }
    text += "\n";
    let mut reasons: Vec<&str> = panel.springs.iter().filter_map(|it| it.end.reason()).collect();
    reasons.dedup();
    for reason in reasons {
        let _ = writeln!(text, "Skipped: {reason}.\n");
    }
    text
}

/// What verifies the references.
pub(crate) fn references(panel: &Study) -> String {
    let mut text = String::from(
        "| elements a square | route | its residual | residual, refined | margin of the inequalities | certain digits | distance of the route's answer | other route | its distance |\n\
         |--:|---|--:|--:|--:|--:|--:|---|--:|\n",
    );
    for mesh in by_factor(panel) {
        let Some(it) = &mesh.reference else { continue };
        let (verified, other) = (it.verified.as_ref(), it.confirmed.as_ref());
        let _ = writeln!(
            text,
            "| {0} x {0} | {1} | {2:.1e} | {3} | {4} | {5} | {6} | {7} | {8} |",
            mesh.factor,
            it.route.name(),
            it.residual,
            power(verified.map(|it| it.residual)),
            power(verified.and_then(|it| it.margin)),
            verified.map_or_else(|| "-".to_owned(), |it| format!("{:.0}", it.digits)),
            power(verified.and_then(|it| it.distance)),
            other.map_or("-", |it| it.route.name()),
            power(other.and_then(|it| it.refined.or(it.errors.worst()))),
        );
    }
    text
}

/// What the last digits cost.
pub(crate) fn refinings(panel: &Panel) -> String {
    let mut text = String::from(
        "| elements a square | route, all of a solve in `f64` | error | states known: one solve | error | and one refinement | error | and compensated refinement | error |\n\
         |--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    let meshes = panel.study.meshes.iter().zip(&panel.refinings).filter(|(_, it)| !it.is_empty());
    let mut meshes: Vec<_> = meshes.collect();
    meshes.sort_by_key(|(mesh, _)| mesh.factor);
    for (mesh, refinings) in meshes {
        let _ = write!(text, "| {0} x {0} |", mesh.factor);
        if let Some(it) = &mesh.reference {
            let distance = it.verified.as_ref().and_then(|it| it.distance);
            let _ = write!(
                text,
                " {}, {} | {} |",
                it.route.name(),
                seconds(it.seconds),
                power(distance)
            );
        }
        for it in refinings {
            let solves = match it.refinement {
                Refinement::Extended => format!(" ({} solves)", it.passes),
                _ => String::new(),
            };
            let _ = write!(text, " {}{solves} | {} |", seconds(it.seconds), power(it.error));
        }
        text += "\n";
    }
    text
}

/// From coarse to fine.
pub(crate) fn by_factor(panel: &Study) -> Vec<&Mesh> {
    let mut meshes: Vec<&Mesh> = panel.meshes.iter().collect();
    meshes.sort_by_key(|mesh| mesh.factor);
    meshes
}

fn power(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1e}"))
}
