//! Diagrams of a study: error against time, mesh against time, what the last digits cost, bias of springs; and of several: time against
//! size.

use super::diagram::{Line, Titles, diagram};
use crate::analysis::study::{Mesh, Record, Springs, Study};
use crate::scene::Route;

/// Errors below this are drawn at it: they are rounding, or those of the reference itself.
const ROUNDING: f64 = 1e-16;
/// The same of twice the digits.
const EXACT: f64 = 1e-32;
/// The tolerance of the answers whose time the picture of meshes shows: the nearest one of the study.
const USUAL: f64 = 1e-8;

/// The work-precision diagram of the first mesh: the worst algebraic error against the time, one line for
/// each route through its tolerances. `None` where no error is known.
pub fn accuracy(study: &Study) -> Option<String> {
    let routes = study.routes();
    let lines: Vec<Line> = routes.iter().map(|route| accuracy_line(study, *route)).collect();
    let titles = Titles {
        title: &format!("{}, {}: algebraic error and time", study.title, first_name(study)),
        x: "time of one solve [s]",
        y: "error of forces, stresses, energy, relative [-]",
    };
    let asked = || study.on_first_mesh().map(|it| it.tolerance);
    let (loosest, tightest) = (asked().reduce(f64::max)?, asked().reduce(f64::min)?);
    let solves =
        format!("One marker a solve, asked for {loosest:e} (first) to {tightest:e} (last).");
    let notes = std::iter::once(solves).chain(rounded(&lines, ROUNDING));
    let notes: Vec<String> = notes.chain(study.machine.clone()).collect();
    diagram(&titles, &lines, &notes)
}

fn first_name(study: &Study) -> &str {
    study.meshes.first().map_or("", |mesh| &mesh.name)
}

fn accuracy_line(study: &Study, route: Route) -> Line {
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
    let point = |it: &&&Record| Some([it.seconds?, it.errors?.worst()?.max(ROUNDING)]);
    let points = solved.filter_map(|it| point(&it)).collect();
    Line { name, style: style(route), dashed: false, points }
}

/// The worst error of every mesh against the time of a solve on it, one line for each route. `None` where only one
/// mesh has a reference, or nothing is elastic.
pub fn mesh(study: &Study) -> Option<String> {
    let tolerances = study.records.iter().map(|record| record.tolerance);
    let distance = |tolerance: &f64| (tolerance / USUAL).ln().abs();
    let usual = tolerances.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let lines: Vec<Line> =
        study.routes().into_iter().map(|route| mesh_line(study, route, usual)).collect();
    let finest = study.meshes.iter().filter(|it| it.values.is_some()).max_by_key(|it| it.factor)?;
    let titles = Titles {
        title: &format!("{}: error of the mesh and time", study.title),
        x: &format!("time of one solve to {usual:e} [s]"),
        y: "worst error of energy, thrust, displacement [-]",
    };
    let compared = by_factor(study).into_iter().filter(|mesh| mesh.errors.is_some());
    let compared: Vec<&str> = compared.map(|mesh| mesh.name.as_str()).collect();
    let notes = [
        format!("Every line goes from coarse to fine: {}.", compared.join(", ")),
        format!("Errors are against {}, the finest with a reference.", finest.name),
    ];
    let notes: Vec<String> = notes.into_iter().chain(study.machine.clone()).collect();
    diagram(&titles, &lines, &notes)
}

fn mesh_line(study: &Study, route: Route, tolerance: f64) -> Line {
    let record = |mesh: &Mesh| {
        study.records.iter().find(|it| {
            it.route == route
                && it.mesh == mesh.factor
                && it.tolerance.total_cmp(&tolerance).is_eq()
        })
    };
    let points = by_factor(study).into_iter().filter_map(|mesh| {
        let error = mesh.errors?.worst()?;
        Some([record(mesh).filter(|it| it.end.is_solved())?.seconds?, error.max(ROUNDING)])
    });
    let failed = by_factor(study)
        .into_iter()
        .filter(|mesh| record(mesh).is_none_or(|it| !it.end.is_solved()))
        .map(|mesh| mesh.factor.to_string());
    let failed: Vec<String> = failed.collect();
    let name = match &failed[..] {
        [] => route.name().to_owned(),
        _ => format!("{}, no answer on {}", route.name(), failed.join(", ")),
    };
    Line { name, style: style(route), dashed: false, points: points.collect() }
}

/// From coarse to fine.
fn by_factor(study: &Study) -> Vec<&Mesh> {
    let mut meshes: Vec<&Mesh> = study.meshes.iter().collect();
    meshes.sort_by_key(|mesh| mesh.factor);
    meshes
}

/// What the last digits cost: the error of the forces against the time of one solve with the states of all contacts
/// known, and one refinement, and compensated refinement, one line for each mesh; and, for comparison, the routes that
/// found these states. `None` where no reference is verified.
pub fn digits(study: &Study) -> Option<String> {
    let point = |seconds: f64, error: f64| [seconds, error.max(EXACT)];
    let meshes: Vec<&Mesh> =
        by_factor(study).into_iter().filter(|mesh| !mesh.refinings.is_empty()).collect();
    let of_mesh = |(style, mesh): (usize, &&Mesh)| Line {
        name: mesh.name.clone(),
        style,
        dashed: false,
        points: mesh.refinings.iter().filter_map(|it| Some(point(it.seconds, it.error?))).collect(),
    };
    let whole = |mesh: &&Mesh| {
        let reference = mesh.reference.as_ref()?;
        Some(point(reference.seconds, reference.verified.as_ref()?.distance?))
    };
    let mut lines: Vec<Line> = meshes.iter().enumerate().map(of_mesh).collect();
    let mut routes: Vec<&str> = meshes
        .iter()
        .filter_map(|mesh| mesh.reference.as_ref().map(|it| it.route.name()))
        .collect();
    routes.dedup();
    lines.push(Line {
        name: format!("whole solves in f64, by {}, on the same meshes", routes.join(", ")),
        style: lines.len(),
        dashed: true,
        points: meshes.iter().filter_map(whole).collect(),
    });
    lines.retain(|line| !line.points.is_empty());
    let titles = Titles {
        title: &format!("{}: what the last digits cost", study.title),
        x: "time [s]",
        y: "error of the forces on the nodes, relative [-]",
    };
    let ways = "Three markers a mesh, with the states of all contacts known: one solve; and one refinement in f64; and \
                compensated refinement, with residuals of twice the digits.";
    let notes = std::iter::once(ways.to_owned()).chain(rounded(&lines, EXACT));
    let notes: Vec<String> = notes.chain(study.machine.clone()).collect();
    diagram(&titles, &lines, &notes)
}

/// What soft springs change before they are centred anew, against their stiffness. `None` where no bias is known:
/// no springs were tried, or the problems that they belong to have no answer.
pub fn springs(study: &Study) -> Option<String> {
    let solved = || study.springs.iter().filter(|it| it.end.is_solved());
    solved().find(|it| it.bias.is_some())?;
    let line = |name: &str, style, of: fn(&Springs) -> Option<f64>| Line {
        name: name.to_owned(),
        style,
        dashed: false,
        points: solved().filter_map(|it| Some([it.stiffness, of(it)?.max(ROUNDING)])).collect(),
    };
    let mut lines = vec![
        line("bias: change of the displacements", 0, |it| it.bias),
        line("share of the load that the springs carry", 1, |it| it.share),
        line("error of the answer, after they were centred anew", 2, |it| it.errors?.worst()),
    ];
    lines.retain(|line| !line.points.is_empty());
    let titles = Titles {
        title: &format!(
            "{}, {}: soft springs, by quadratic programs",
            study.title,
            first_name(study)
        ),
        x: "stiffness of the springs, relative to that of the blocks [-]",
        y: "relative [-]",
    };
    let asked = study
        .springs
        .first()
        .map(|it| format!("One marker a solve, asked for a residual of {:e}.", it.tolerance));
    let failed = study.springs.iter().filter(|it| !it.end.is_solved());
    let failed: Vec<String> =
        failed.map(|it| format!("{:e} ({})", it.stiffness, it.end.name())).collect();
    let failed = (!failed.is_empty()).then(|| format!("No answer with {}.", failed.join(", ")));
    let notes = asked.into_iter().chain(failed).chain(rounded(&lines, ROUNDING));
    let notes: Vec<String> = notes.chain(study.machine.clone()).collect();
    diagram(&titles, &lines, &notes)
}

/// The time of a solve on the first mesh of every study against the number of blocks, for two tolerances: two
/// lines for each route, the first broken. `None` where no time is known.
pub fn sizes(title: &str, studies: &[Study], [loose, tight]: [f64; 2]) -> Option<String> {
    let mut routes: Vec<Route> = Vec::new();
    for route in studies.iter().flat_map(Study::routes) {
        if !routes.contains(&route) {
            routes.push(route);
        }
    }
    let line = |route: Route, tolerance: f64| {
        let point = |study: &Study| {
            let blocks = study.meshes.first()?.blocks as f64;
            let mut records = study.on_first_mesh().filter(|it| it.end.is_solved());
            let record = records
                .find(|it| it.route == route && it.tolerance.total_cmp(&tolerance).is_eq())?;
            Some([blocks, record.seconds?])
        };
        studies.iter().filter_map(point).collect()
    };
    let lines = |route: &Route| {
        let (style, name) = (style(*route), route.name().to_owned());
        let points = line(*route, loose);
        [
            Line { name: String::new(), style, dashed: true, points },
            Line { name, style, dashed: false, points: line(*route, tight) },
        ]
    };
    let lines: Vec<Line> = routes.iter().flat_map(lines).collect();
    let titles = Titles { title, x: "number of bricks [-]", y: "time of one solve [s]" };
    let meaning = format!("Full lines: to {tight:e}; broken ones: to {loose:e}.");
    let ends = "A line ends where a size was not solved within the time, or not tried.".to_owned();
    let machine = studies.first().and_then(|study| study.machine.clone());
    let notes: Vec<String> = [meaning, ends].into_iter().chain(machine).collect();
    diagram(&titles, &lines, &notes)
}

/// A note, where errors are below what is drawn.
fn rounded(lines: &[Line], rounding: f64) -> Option<String> {
    let errors = lines.iter().flat_map(|line| line.points.iter().map(|[_, error]| *error));
    let is_rounded = errors.reduce(f64::min).is_some_and(|least| least <= rounding);
    is_rounded.then(|| format!("Errors below {rounding:e} are drawn there."))
}

/// A route has the same colour in every picture.
fn style(route: Route) -> usize {
    match route {
        Route::Auto | Route::Forces | Route::Lemke => 0,
        Route::Interior => 1,
        Route::Qp => 2,
        Route::Pgs => 3,
        Route::Alm => 4,
        Route::Newton => 5,
    }
}
