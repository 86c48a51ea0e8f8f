//! The results of a study in sentences.

use lcp::Status;

use crate::format::significant;
use masonry::analysis::study::{End, Record, Study, Verification};
use masonry::rounding::largest;
use masonry::scene::Route;

/// The two tolerances whose costs are compared; the nearest tolerances of the study stand for them.
const COMPARED: [f64; 2] = [1e-4, 1e-8];
/// The largest algebraic error of an answer that can count as the fastest accurate one.
const ACCURATE: f64 = 1e-6;
/// An answer at the tightest tolerance whose distance from the reference exceeds this value counts as a different
/// solution.
const ELSEWHERE: f64 = 1e-3;
/// Algebraic errors below this part of the discretisation error do not matter.
const NEGLIGIBLE: f64 = 0.1;
/// Two times whose ratio is below this factor count as equal within the accuracy of measurement; a time that falls
/// counts as equal, too.
const NOISE: f64 = 1.2;

/// Returns the results of a study in sentences: the cost of a tight tolerance, the fastest route, the benefit of a
/// finer mesh, and the reference of the errors.
pub fn summary(study: &Study) -> Vec<String> {
    let found = [interrupted(study), cost(study), in_short(study), mesh(study)];
    let mut sentences: Vec<String> = found.into_iter().flatten().collect();
    sentences.extend(gave_up(study));
    sentences.extend(elsewhere(study));
    sentences.extend(reference(study));
    sentences
}

/// Returns the one sentence that a user needs: the fastest route to an accurate answer, and the error of the mesh.
/// `None` if no error of a solve is small enough.
pub fn in_short(study: &Study) -> Option<String> {
    let (record, seconds) = fastest_record(study)?;
    let mesh = study.meshes.first()?;
    let error = mesh.errors.and_then(|it| it.worst()).map_or(String::new(), |error| {
        format!("; the error of the mesh is {}", significant(error, 2))
    });
    Some(format!(
        "On {}, the fastest route to an algebraic error below {ACCURATE:e} is {} at a tolerance of {:e}: {} s{error}.",
        mesh.name,
        record.route.name(),
        record.tolerance,
        significant(seconds, 2)
    ))
}

fn interrupted(study: &Study) -> Option<String> {
    let is_skipped =
        |it: &&Record| matches!(it.end, End::Skipped(_) | End::Ended(Status::Cancelled));
    let missing = study.records.iter().filter(is_skipped).count();
    study
        .is_interrupted
        .then(|| format!("Interrupted: {missing} of {} solves are missing.", study.records.len()))
}

/// Returns the cost of the tight tolerance in a sentence such as "Compared with 1e-4, 1e-8 takes as long (within 20 %)
/// with lemke, 9 times as long with pgs; alm (Stalled) does not reach it."
fn cost(study: &Study) -> Option<String> {
    let nearest = |wanted: f64| {
        let tolerances = study.on_first_mesh().map(|record| record.tolerance);
        tolerances.min_by(|a, b| (a / wanted).ln().abs().total_cmp(&(b / wanted).ln().abs()))
    };
    let [loose, tight] = COMPARED.map(nearest);
    let (loose, tight) = (loose?, tight?);
    let seconds = |route: Route, tolerance: f64| {
        let same = |record: &&Record| {
            record.route == route && record.tolerance.total_cmp(&tolerance).is_eq()
        };
        let record = study.on_first_mesh().find(same).filter(|record| record.end.is_solved())?;
        record.seconds
    };
    let ratio = |route: Route| Some((route, seconds(route, tight)? / seconds(route, loose)?));
    let ratios = study.routes().into_iter().filter_map(ratio);
    let (same, more): (Vec<_>, Vec<_>) = ratios.partition(|(_, ratio)| *ratio <= NOISE);
    if tight >= loose || same.is_empty() && more.is_empty() {
        return None;
    }
    let same: Vec<&str> = same.iter().map(|(route, _)| route.name()).collect();
    let more = more.iter().map(|(route, ratio)| {
        format!("{} times as long with {}", significant(*ratio, 2), route.name())
    });
    let costs =
        (!same.is_empty()).then(|| format!("as long (within 20 %) with {}", same.join(", ")));
    let costs: Vec<String> = costs.into_iter().chain(more).collect();
    Some(format!(
        "Compared with {loose:e}, {tight:e} takes {}{}.",
        costs.join(", "),
        without(study, tight)
    ))
}

/// Returns words for the routes that do not reach a tolerance, each with its status at the loosest tolerance that the
/// route does not reach.
fn without(study: &Study, tolerance: f64) -> String {
    let failed = study.routes().into_iter().filter_map(|route| {
        let here = |it: &&Record| it.route == route && it.tolerance.total_cmp(&tolerance).is_eq();
        study.on_first_mesh().find(here).filter(|it| !it.end.is_solved())?;
        let end = loosest_failure(study, route)?.end.name();
        Some(format!("{} ({end})", route.name()))
    });
    let failed: Vec<String> = failed.collect();
    match failed.len() {
        0 => String::new(),
        1 => format!("; {} does not reach it", failed[0]),
        _ => format!("; {} do not reach it", failed.join(", ")),
    }
}

fn fastest_record(study: &Study) -> Option<(&Record, f64)> {
    let is_accurate = |record: &&Record| {
        let error = record.errors.and_then(|errors| errors.worst());
        record.end.is_solved() && error.is_some_and(|error| error <= ACCURATE)
    };
    let timed = study.on_first_mesh().filter(is_accurate).filter_map(|it| Some((it, it.seconds?)));
    timed.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Returns a sentence for each route with the loosest tolerance that the route does not reach.
fn gave_up(study: &Study) -> Vec<String> {
    let sentence = |record: &Record| {
        let name = record.route.name();
        match &record.end {
            End::Ended(status) => format!(
                "{name} does not reach {:e}: {status} after {} s{}.",
                record.tolerance,
                record.seconds.map_or("-".to_owned(), |time| significant(time, 2)),
                record.residual.map_or(String::new(), |it| format!(", residual {it:.1e}")),
            ),
            End::Refused(reason) => format!("{name} refuses the scene: {reason}."),
            End::Skipped(reason) => {
                format!("{name} was not tried at {:e}: {reason}.", record.tolerance)
            }
        }
    };
    let routes = study.routes().into_iter();
    routes.filter_map(|route| loosest_failure(study, route)).map(sentence).collect()
}

fn loosest_failure(study: &Study, route: Route) -> Option<&Record> {
    let failed = study.on_first_mesh().filter(|it| it.route == route && !it.end.is_solved());
    failed.max_by(|a, b| a.tolerance.total_cmp(&b.tolerance))
}

fn elsewhere(study: &Study) -> Vec<String> {
    let tightest = |route: Route| {
        let solved = study.on_first_mesh().filter(|it| it.route == route && it.end.is_solved());
        let record = solved.min_by(|a, b| a.tolerance.total_cmp(&b.tolerance))?;
        let error = record.errors?.worst().filter(|error| *error > ELSEWHERE)?;
        Some(format!(
            "{} ends at a distance of {} from the reference at its tightest tolerance, {:e}: it has found another \
             equilibrium (there may be several if there is friction), or the tolerance does not bound the error.",
            route.name(),
            significant(error, 2),
            record.tolerance
        ))
    };
    study.routes().into_iter().filter_map(tightest).collect()
}

fn reference(study: &Study) -> Option<String> {
    let Some(reference) = study.meshes.first()?.reference.as_ref() else {
        return Some(
            "There is no reference, since none of interior, lemke, alm and qp found a solution, so errors are unknown."
                .to_owned(),
        );
    };
    let confirmed = match &reference.confirmed {
        Some(other) => format!(
            "{} agrees to {}",
            other.route.name(),
            other.refined.or(other.errors.worst()).map_or("-".to_owned(), |it| significant(it, 2))
        ),
        None => "no other route confirms it".to_owned(),
    };
    Some(format!(
        "The reference is the solution by {} at a tolerance of {:e}, with a residual of {:.1e} and an error of the balances of {:.1e}{}; {confirmed}.",
        reference.route.name(),
        reference.tolerance,
        reference.residual,
        reference.balance,
        refined(reference.verified.as_ref())
    ))
}

fn refined(verified: Option<&Verification>) -> String {
    let Some(it) = verified else { return String::new() };
    let margin = it
        .margin
        .map_or(String::new(), |margin| format!(" (margin of the inequalities {margin:.1e})"));
    if it.is_better() {
        format!(
            ". Refinement to a residual of {:.1e}{margin} changed the reference by {}",
            it.residual,
            it.distance.map_or("-".to_owned(), |it| significant(it, 2)),
        )
    } else {
        format!(
            ". Refinement to a residual of {:.1e}{margin} does not confirm the reference, so errors are relative to the unrefined \
             solution",
            it.residual
        )
    }
}

/// Returns a sentence with the error of the scene's own mesh, and the loosest tolerance whose error is negligible
/// beside it.
fn mesh(study: &Study) -> Option<String> {
    let first = study.meshes.first()?;
    let finest = study.meshes.iter().filter(|it| it.values.is_some()).max_by_key(|it| it.factor)?;
    let error = first.errors?.worst()?;
    let is_enough = |tolerance: f64| {
        let at = |record: &&Record| {
            record.tolerance <= tolerance && record.end.is_solved() && record.errors.is_some()
        };
        let errors = study.on_first_mesh().filter(at).filter_map(|it| it.errors?.worst());
        largest(errors) <= NEGLIGIBLE * error
    };
    let tolerances = study.on_first_mesh().map(|record| record.tolerance);
    let loosest = tolerances.filter(|it| is_enough(*it)).reduce(f64::max);
    let enough = loosest.map_or(String::new(), |tolerance| {
        format!("; algebraic errors at {tolerance:e} are negligible compared with it")
    });
    Some(format!(
        "The error of {} is {}, the largest of those of strain energy, thrust and displacement, relative to {}{enough}.",
        first.name,
        significant(error, 2),
        finest.name
    ))
}
