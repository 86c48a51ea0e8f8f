//! Diagrams of a study: error against time, mesh against time, bias of springs; and of several: time against
//! size.

use super::diagram::{Line, Titles, diagram};
use crate::scene::Route;
use crate::study::{Mesh, Record, Study};

/// Errors below this are drawn at it: they are rounding, or those of the reference itself.
const ROUNDING: f64 = 1e-16;
/// The tolerance of the answers whose time the picture of meshes shows: the nearest one of the study.
const USUAL: f64 = 1e-8;

/// The work-precision diagram of the first mesh: the worst algebraic error against the time, one line for
/// each route through its tolerances. `None` where no error is known.
pub fn accuracy(study: &Study) -> Option<String> {
    let routes = study.routes();
    let lines: Vec<Line> = routes.iter().map(|route| accuracy_line(study, *route)).collect();
    let titles = Titles {
        title: &format!("{}: algebraic error and time", study.title),
        x: "time of one solve [s]",
        y: "error of forces, stresses, energy, relative [-]",
    };
    let tolerances = "Every line goes through the tolerances of the study, each solve to its own.";
    let notes = std::iter::once(tolerances.to_owned()).chain(rounded(&lines));
    let notes: Vec<String> = notes.chain(study.machine.clone()).collect();
    diagram(&titles, &lines, &notes)
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

/// The error of every mesh in the strain energy against the time of a solve on it, one line for each
/// route. `None` where only one mesh has a reference, or nothing is elastic.
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
        y: "error of the strain energy, relative [-]",
    };
    let notes = [
        format!(
            "Every line goes from coarse to fine; numbers of elements times {}.",
            factors(study)
        ),
        format!(
            "Errors are against the mesh of factor {}, the finest with a reference.",
            finest.factor
        ),
    ];
    let notes: Vec<String> = notes.into_iter().chain(study.machine.clone()).collect();
    diagram(&titles, &lines, &notes)
}

fn mesh_line(study: &Study, route: Route, tolerance: f64) -> Line {
    let mut meshes: Vec<&Mesh> = study.meshes.iter().collect();
    meshes.sort_by_key(|mesh| mesh.factor);
    let points = meshes.into_iter().filter_map(|mesh| {
        let error = mesh.errors?.energy?;
        let is_same = |it: &&Record| {
            it.route == route
                && it.mesh == mesh.factor
                && it.tolerance.total_cmp(&tolerance).is_eq()
                && it.end.is_solved()
        };
        Some([study.records.iter().find(is_same)?.seconds?, error.max(ROUNDING)])
    });
    let failed = study.records.iter().find(|it| {
        it.route == route && it.tolerance.total_cmp(&tolerance).is_eq() && !it.end.is_solved()
    });
    let name = match failed {
        Some(record) => format!("{}: {} on {}", route.name(), record.end.name(), record.mesh),
        None => route.name().to_owned(),
    };
    Line { name, style: style(route), dashed: false, points: points.collect() }
}

fn factors(study: &Study) -> String {
    let compared = study.meshes.iter().filter(|mesh| mesh.errors.is_some());
    let mut factors: Vec<u32> = compared.map(|mesh| mesh.factor).collect();
    factors.sort_unstable();
    factors.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")
}

/// What soft springs change before they are centred anew, against their stiffness. `None` where no
/// springs were tried, or there is no answer with them.
pub fn springs(study: &Study) -> Option<String> {
    let line = |name: &str, style, of: fn(&crate::study::Springs) -> Option<f64>| Line {
        name: name.to_owned(),
        style,
        dashed: false,
        points: study
            .springs
            .iter()
            .filter(|it| it.end.is_solved())
            .filter_map(|it| Some([it.stiffness, of(it)?.max(ROUNDING)]))
            .collect(),
    };
    let lines = [
        line("bias: change of the displacements", 0, |it| it.bias),
        line("share of the load that the springs carry", 1, |it| it.share),
        line("error of the answer, after they were centred anew", 2, |it| it.errors?.worst()),
    ];
    let titles = Titles {
        title: &format!("{}: soft springs, by quadratic programs", study.title),
        x: "stiffness of the springs, relative to that of the blocks [-]",
        y: "relative [-]",
    };
    let notes: Vec<String> = rounded(&lines).into_iter().chain(study.machine.clone()).collect();
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
fn rounded(lines: &[Line]) -> Option<String> {
    let errors = lines.iter().flat_map(|line| line.points.iter().map(|[_, error]| *error));
    let is_rounded = errors.reduce(f64::min).is_some_and(|least| least <= ROUNDING);
    is_rounded.then(|| format!("Errors below {ROUNDING:e} are drawn there."))
}

/// A route has the same colour in every picture.
fn style(route: Route) -> usize {
    match route {
        Route::Auto | Route::Lemke => 0,
        Route::Interior => 1,
        Route::Qp => 2,
        Route::Pgs => 3,
        Route::Alm => 4,
        Route::Newton => 5,
    }
}
