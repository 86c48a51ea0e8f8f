//! The pictures that a study alone does not have: mesh against time, the last digits, soft springs, size against time.

use masonry::analysis::study::{Mesh, Record, Study};
use masonry::scene::Route;
use masonry_report::study::style;
use masonry_report::svg::diagram::{Diagram, Look, Series, picture};

use super::Panel;
use super::springs::{self, Springs};
use super::tables::by_factor;

/// Errors below this are drawn at it: they are rounding, or those of the reference itself.
const ROUNDING: f64 = 1e-16;
/// The same of twice the digits.
const EXACT: f64 = 1e-32;
/// The tolerance of the answers whose time the picture of meshes shows.
const USUAL: f64 = 1e-8;

fn drawn(title: &str, axes: [&str; 2], series: Vec<Series>, notes: &[String]) -> Option<String> {
    let axes = axes.map(str::to_owned);
    picture(title, &[Diagram { axes, series, ..Diagram::default() }], notes)
}

fn line(name: impl Into<String>, style: usize, points: Vec<[f64; 2]>) -> Series {
    Series { name: name.into(), style, look: Look::Full, points }
}

fn notes(study: &Study, words: &[&str]) -> Vec<String> {
    words.iter().map(|it| (*it).to_owned()).chain(study.machine.clone()).collect()
}

fn record(study: &Study, mesh: u32, route: Route, tolerance: f64) -> Option<&Record> {
    let near = |it: &f64| (it / tolerance).ln().abs() < 0.1;
    let is_it = |it: &&Record| it.mesh == mesh && it.route == route && near(&it.tolerance);
    study.records.iter().find(is_it).filter(|it| it.end.is_solved())
}

/// The worst error of every mesh against the time of a solve on it, one line for each route. `None` where only one
/// mesh has a reference.
pub(crate) fn mesh(study: &Study) -> Option<String> {
    let finest = study.meshes.iter().filter(|it| it.values.is_some()).max_by_key(|it| it.factor)?;
    let meshes = by_factor(study);
    let series = |route: Route| {
        let solved = |mesh: &Mesh| record(study, mesh.factor, route, USUAL);
        let point = |mesh: &&Mesh| Some([solved(mesh)?.seconds?, mesh.errors?.worst()?]);
        let failed = meshes.iter().filter(|mesh| solved(mesh).is_none());
        let failed: Vec<String> = failed.map(|mesh| mesh.factor.to_string()).collect();
        let name = match &failed[..] {
            [] => route.name().to_owned(),
            _ => format!("{}, no answer on {}", route.name(), failed.join(", ")),
        };
        line(name, style(route), meshes.iter().filter_map(point).collect())
    };
    let compared: Vec<&str> =
        meshes.iter().filter(|it| it.errors.is_some()).map(|it| &it.name[..]).collect();
    let words = format!(
        "Every line goes from coarse to fine: {}. Errors are against {}, the finest with a reference.",
        compared.join(", "),
        finest.name
    );
    drawn(
        &format!("{}: error of the mesh and time", study.title),
        [
            &format!("time of one solve to {USUAL:e} [s]"),
            "worst error of energy, thrust, displacement [-]",
        ],
        study.routes().into_iter().map(series).collect(),
        &notes(study, &[&words]),
    )
}

/// The error of the forces against the time of one solve with the states of all contacts known, one refinement, and
/// compensated refinement, one line for each mesh; and the routes that found these states.
pub(crate) fn digits(panel: &Panel) -> Option<String> {
    let study = &panel.study;
    let point = |seconds: f64, error: f64| [seconds, error.max(EXACT)];
    let meshes = study.meshes.iter().zip(&panel.refinings).filter(|(_, it)| !it.is_empty());
    let mut meshes: Vec<_> = meshes.collect();
    meshes.sort_by_key(|(mesh, _)| mesh.factor);
    let whole = |(mesh, _): &(&Mesh, _)| {
        let reference = mesh.reference.as_ref()?;
        Some(point(reference.seconds, reference.verified.as_ref()?.distance?))
    };
    let mut series: Vec<Series> = Vec::new();
    for (k, (mesh, refinings)) in meshes.iter().enumerate() {
        let points = refinings.iter().filter_map(|it| Some(point(it.seconds, it.error?)));
        series.push(line(&mesh.name, k, points.collect()));
    }
    let name = "whole solves in f64, by the routes of the references";
    series.push(line(name, series.len(), meshes.iter().filter_map(whole).collect()));
    let words = "Three markers a mesh, with the states of all contacts known: one solve; and one refinement in f64; and \
                 compensated refinement, with residuals of twice the digits.";
    drawn(
        &format!("{}: what the last digits cost", study.title),
        ["time [s]", "error of the forces on the nodes [-]"],
        series,
        &notes(study, &[words]),
    )
}

/// What soft springs change before they are centred anew, against their stiffness. `None` where fewer than two biases
/// are known.
pub(crate) fn springs(panel: &Panel) -> Option<String> {
    let solved = || panel.springs.iter().filter(|it| it.end.is_solved());
    solved().filter(|it| it.bias.is_some()).nth(1)?;
    let of = |name: &str, style, of: fn(&Springs) -> Option<f64>| {
        let points = solved().filter_map(|it| Some([it.stiffness, of(it)?.max(ROUNDING)]));
        line(name, style, points.collect())
    };
    let failed = panel.springs.iter().filter(|it| !it.end.is_solved());
    let failed: Vec<String> =
        failed.map(|it| format!("{:e} ({})", it.stiffness, it.end.name())).collect();
    let asked = format!("One marker per solve, at a tolerance of {:e}.", springs::TOLERANCE);
    let failed = (!failed.is_empty()).then(|| format!("No answer with {}.", failed.join(", ")));
    let words: Vec<&str> = std::iter::once(&asked).chain(&failed).map(String::as_str).collect();
    drawn(
        &format!("{}: soft springs, by quadratic programs", panel.study.title),
        ["stiffness of the springs, relative to that of the blocks [-]", "relative [-]"],
        vec![
            of("bias: change of the displacements", 0, |it| it.bias),
            of("share of the load that the springs carry", 1, |it| it.share),
            of("error of the answer, after they were centred anew", 2, |it| it.errors?.worst()),
        ],
        &notes(&panel.study, &words),
    )
}

/// The time of a solve on the first mesh of every study against the number of blocks, for two tolerances.
pub(crate) fn sizes(title: &str, walls: &[Study], [loose, tight]: [f64; 2]) -> Option<String> {
    let first = walls.first()?;
    let points = |route: Route, tolerance: f64| {
        let point = |study: &Study| {
            let mesh = study.meshes.first()?;
            Some([mesh.blocks as f64, record(study, mesh.factor, route, tolerance)?.seconds?])
        };
        walls.iter().filter_map(point).collect()
    };
    let series = |route: Route| {
        let loosely = line("", style(route), points(route, loose));
        let tightly = line(route.name(), style(route), points(route, tight));
        [Series { look: Look::Hollow, ..loosely }, tightly]
    };
    let words = format!(
        "Full markers: to {tight:e}; hollow ones: to {loose:e}. A line ends where a size was not solved within the time, \
         or not tried."
    );
    drawn(
        title,
        ["number of bricks [-]", "time of one solve [s]"],
        first.routes().into_iter().flat_map(series).collect(),
        &notes(first, &[&words]),
    )
}
