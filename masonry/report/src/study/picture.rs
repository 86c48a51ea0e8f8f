//! The picture of a study: error against computing time.

use crate::svg::diagram::{Diagram, Look, Series, picture};
use masonry::analysis::study::{Record, Study};
use masonry::scene::Route;

/// Errors below this value are drawn at this value: they are rounding errors, or errors of the reference itself.
const ROUNDING: f64 = 1e-16;

/// Draws the work-precision diagram of the first mesh: the worst algebraic error against the time, one line for each
/// route through its tolerances. `None` if no error is known.
pub fn accuracy(study: &Study) -> Option<String> {
    let first = study.meshes.first()?;
    let diagram = Diagram {
        axes: ["time of one solve [s]", "error of forces, stresses, energy [-]"].map(str::to_owned),
        series: study.routes().into_iter().map(|route| series(study, route)).collect(),
        ..Diagram::default()
    };
    let asked = || study.on_first_mesh().map(|it| it.tolerance);
    let (loosest, tightest) = (asked().reduce(f64::max)?, asked().reduce(f64::min)?);
    let solves = format!(
        "One marker per solve, tolerance {loosest:e} (first) to {tightest:e} (last). Errors below {ROUNDING:e} are drawn there."
    );
    let notes: Vec<String> = std::iter::once(solves).chain(study.machine.clone()).collect();
    let title = format!("{}, {}: algebraic error and time", study.title, first.name);
    picture(&title, &[diagram], &notes)
}

fn series(study: &Study, route: Route) -> Series {
    let records: Vec<&Record> = study.on_first_mesh().filter(|it| it.route == route).collect();
    let solved = records.iter().filter(|it| it.end.is_solved());
    let tightest = solved.clone().map(|it| it.tolerance).reduce(f64::min);
    let failed = records.iter().find(|it| !it.end.is_solved()).map(|it| it.end.name());
    let name = route.name();
    let name = match (tightest, failed) {
        (None, Some(end)) => format!("{name}: {end}"),
        (Some(tightest), Some(end)) => format!("{name}, down to {tightest:e}; then {end}"),
        _ => name.to_owned(),
    };
    let points = solved.filter_map(|it| Some([it.seconds?, it.errors?.worst()?.max(ROUNDING)]));
    Series { name, style: style(route), look: Look::Full, points: points.collect() }
}

/// Returns the number of the colour and marker of a route, equal in every picture.
pub fn style(route: Route) -> usize {
    match route {
        Route::Forces | Route::Lemke => 0,
        Route::Interior => 1,
        Route::Qp => 2,
        Route::Pgs => 3,
        Route::Alm => 4,
    }
}
