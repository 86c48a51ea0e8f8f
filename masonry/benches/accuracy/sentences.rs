//! What the measurements come to, in three sentences.

use masonry::analysis::study::{MeshErrors, Record, Study};
use masonry::scene::Route;

use super::page::bricks;
use super::tables::seconds;
use super::{Panel, TOLERANCES};

/// The largest algebraic error of an accurate answer.
const ACCURATE: f64 = 1e-6;

/// What a tighter tolerance costs: for every route the worst panel.
pub(crate) fn of_tolerance(panels: &[Panel]) -> String {
    let [loose, tight] = TOLERANCES;
    let ratio = |study: &Study, route: Route| {
        let [loose, tight] = [loose, tight].map(|tolerance| solved(study, route, tolerance));
        Some(tight?.seconds? / loose?.seconds?)
    };
    let worst = |route: Route| {
        let ratios: Option<Vec<f64>> = panels.iter().map(|it| ratio(&it.study, route)).collect();
        ratios.map(|it| it.into_iter().fold(0.0, f64::max))
    };
    let routes = panels.first().map(|it| it.study.routes()).unwrap_or_default();
    let costs = routes.iter().filter_map(|route| Some((*route, worst(*route)?)));
    let costs = costs.map(|(route, it)| format!("{it:.1} times as long with {}", route.name()));
    let without = routes.iter().filter(|route| worst(**route).is_none()).map(|it| it.name());
    let without: Vec<&str> = without.collect();
    let without = match &without[..] {
        [] => String::new(),
        names => format!("; {} did not solve every panel", names.join(" and ")),
    };
    format!(
        "**Tolerance**: with {tight:e} instead of {loose:e} a solve takes at most {}{without}.",
        costs.collect::<Vec<_>>().join(", ")
    )
}

/// What no solver can reduce.
pub(crate) fn of_mesh(panels: &[Panel]) -> String {
    let of = |panel: &Panel| {
        let study = &panel.study;
        let error =
            study.meshes.first().and_then(|it| it.errors.as_ref().and_then(MeshErrors::worst));
        let error = error.map_or_else(|| "unknown".to_owned(), |it| format!("{it:.3}"));
        format!("{error} ({})", short(study))
    };
    let all: Vec<String> = panels.iter().map(of).collect();
    format!(
        "**Mesh**: the error of the mesh of the scene is {}; a tighter tolerance does not reduce it.",
        all.join(" and ")
    )
}

/// The fastest accurate answers.
pub(crate) fn of_time(panels: &[Panel], walls: &[Study]) -> String {
    let studies = panels.iter().map(|it| (&it.study, short(&it.study)));
    let wall = walls.last().map(|it| (it, format!("{} bricks", bricks(it))));
    let fastest = |(study, name): (&Study, String)| match fastest(study) {
        Some((record, time)) => format!("{} with {} ({name})", seconds(time), record.route.name()),
        None => format!("an unknown time ({name})"),
    };
    let all: Vec<String> = studies.chain(wall).map(fastest).collect();
    format!("**Time**: an algebraic error below {ACCURATE:e} takes {}.", all.join(", "))
}

/// A title without what all panels have in common.
fn short(study: &Study) -> String {
    study.title.split(',').next().unwrap_or_default().to_lowercase()
}

fn solved(study: &Study, route: Route, tolerance: f64) -> Option<&Record> {
    let near = |it: &f64| (it / tolerance).ln().abs() < 0.1;
    let is_it = |it: &&Record| it.route == route && near(&it.tolerance) && it.end.is_solved();
    study.on_first_mesh().find(is_it)
}

fn fastest(study: &Study) -> Option<(&Record, f64)> {
    let is_accurate = |record: &&Record| {
        let error = record.errors.and_then(|errors| errors.worst());
        record.end.is_solved() && error.is_some_and(|error| error <= ACCURATE)
    };
    let timed = study.on_first_mesh().filter(is_accurate).filter_map(|it| Some((it, it.seconds?)));
    timed.min_by(|a, b| a.1.total_cmp(&b.1))
}
