//! What a study comes to, in sentences.

use crate::output::format::significant;
use crate::scene::Route;
use crate::study::{End, Record, Refining, Study, Verified};

/// Tolerances that are compared: the nearest ones of the study.
const COMPARED: [f64; 2] = [1e-4, 1e-8];
/// The largest algebraic error of an answer that the fastest route is named for.
const ACCURATE: f64 = 1e-6;
/// Answers this far from the reference at the tightest tolerance are others.
const ELSEWHERE: f64 = 1e-3;
/// Algebraic errors below this part of that of the mesh do not matter.
const NEGLIGIBLE: f64 = 0.1;

/// What a study comes to, in sentences: [`answer`], and what it rests on.
pub fn summary(study: &Study) -> Vec<String> {
    let mut sentences = answer(study);
    sentences.extend(gave_up(study));
    sentences.extend(elsewhere(study));
    sentences.extend(reference(study));
    sentences.extend(last_digits(study));
    sentences.extend(springs(study));
    sentences
}

/// What a user needs to know: what a tight tolerance costs, which route gets there first, and whether the mesh
/// is worth it.
pub fn answer(study: &Study) -> Vec<String> {
    [cost(study), fastest(study), mesh(study)].into_iter().flatten().collect()
}

/// "1e-8 costs 1.4 x the time of 1e-4 by lemke, 9 x by pgs."
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
    let ratio = |route: Route| {
        let ratio = seconds(route, tight)? / seconds(route, loose)?;
        Some(format!("{} x by {}", significant(ratio, 2), route.name()))
    };
    let mut ratios = study.routes().into_iter().filter_map(ratio);
    let first = ratios.next().filter(|_| tight < loose)?;
    let first = first.replacen(" x by", &format!(" x the time of {loose:e} by"), 1);
    let all: Vec<String> = std::iter::once(first).chain(ratios).collect();
    Some(format!("{tight:e} costs {}.", all.join(", ")))
}

fn fastest(study: &Study) -> Option<String> {
    let is_accurate = |record: &&Record| {
        let error = record.errors.and_then(|errors| errors.worst());
        record.end.is_solved() && error.is_some_and(|error| error <= ACCURATE)
    };
    let timed = study.on_first_mesh().filter(is_accurate).filter_map(|it| Some((it, it.seconds?)));
    let (record, seconds) = timed.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(format!(
        "Forces, stresses and energy to {ACCURATE:e} are had in the least time by {} at a tolerance of \
         {:e}: {} s.",
        record.route.name(),
        record.tolerance,
        significant(seconds, 2)
    ))
}

/// The loosest tolerance that each route does not reach.
fn gave_up(study: &Study) -> Vec<String> {
    let loosest = |route: Route| {
        let failed = study.on_first_mesh().filter(|it| it.route == route && !it.end.is_solved());
        failed.max_by(|a, b| a.tolerance.total_cmp(&b.tolerance))
    };
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
    study.routes().into_iter().filter_map(loosest).map(sentence).collect()
}

fn elsewhere(study: &Study) -> Vec<String> {
    let tightest = |route: Route| {
        let solved = study.on_first_mesh().filter(|it| it.route == route && it.end.is_solved());
        let record = solved.min_by(|a, b| a.tolerance.total_cmp(&b.tolerance))?;
        let error = record.errors?.worst().filter(|error| *error > ELSEWHERE)?;
        Some(format!(
            "{} ends {} from the reference at its tightest tolerance, {:e}: another equilibrium, of \
             which there may be several with friction, or a tolerance that says little here.",
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
            "There is no reference, since none of interior, lemke, alm and qp has an answer: no errors \
             are known."
                .to_owned(),
        );
    };
    let confirmed = match &reference.confirmed {
        Some(other) => format!(
            "{} found the same to {}",
            other.route.name(),
            other.refined.or(other.errors.worst()).map_or("-".to_owned(), |it| significant(it, 2))
        ),
        None => "no other route confirms it".to_owned(),
    };
    Some(format!(
        "The reference is by {} to {:e}, residual {:.1e}, balances {:.1e}{}; {confirmed}.",
        reference.route.name(),
        reference.tolerance,
        reference.residual,
        reference.balance,
        refined(reference.verified.as_ref())
    ))
}

fn refined(verified: Option<&Verified>) -> String {
    let Some(it) = verified else { return String::new() };
    let margin = it.margin.map_or(String::new(), |margin| format!(", margin {margin:.1e}"));
    if it.is_better() {
        format!(
            ", refined to a residual of {:.1e}{margin}, from which it was {} away",
            it.residual,
            it.distance.map_or("-".to_owned(), |it| significant(it, 2)),
        )
    } else {
        format!(
            ", which refinement does not confirm (residual {:.1e}{margin}): errors are against it as it is",
            it.residual
        )
    }
}

/// What the last digits cost.
fn last_digits(study: &Study) -> Option<String> {
    let [plain, single, extended] = &study.meshes.first()?.refinings[..] else { return None };
    let error = |it: &Refining| it.error.map(|error| significant(error, 2));
    Some(format!(
        "With the states of all contacts known, one solve takes {} s and errs by {}, one refinement brings that to \
         {} in {} x the time, and compensated refinement to {} in {} x.",
        significant(plain.seconds, 2),
        error(plain)?,
        error(single)?,
        significant(single.seconds / plain.seconds, 2),
        error(extended)?,
        significant(extended.seconds / plain.seconds, 2),
    ))
}

/// The error of the scene's own mesh, and the loosest tolerance that adds nothing to it.
fn mesh(study: &Study) -> Option<String> {
    let first = study.meshes.first()?;
    let finest = study.meshes.iter().filter(|it| it.values.is_some()).max_by_key(|it| it.factor)?;
    let error = first.errors?.energy?;
    let is_enough = |tolerance: f64| {
        let at = |record: &&Record| {
            record.tolerance <= tolerance && record.end.is_solved() && record.errors.is_some()
        };
        let errors = study.on_first_mesh().filter(at).filter_map(|it| it.errors?.energy);
        errors.fold(0.0, f64::max) <= NEGLIGIBLE * error
    };
    let tolerances = study.on_first_mesh().map(|record| record.tolerance);
    let loosest = tolerances.filter(|it| is_enough(*it)).reduce(f64::max);
    let enough = loosest.map_or(String::new(), |tolerance| {
        format!("; beside that, what solvers leave undone at {tolerance:e} does not count")
    });
    Some(format!(
        "The first mesh (factor {}) errs by {} in strain energy against that of factor {}{enough}.",
        first.factor,
        significant(error, 2),
        finest.factor
    ))
}

/// What the softest and the stiffest springs change, and take.
fn springs(study: &Study) -> Option<String> {
    let solved = study.springs.iter().filter(|it| it.end.is_solved());
    let mut told = solved.filter_map(|it| {
        let rounds = match it.rounds? {
            1 => "one round".to_owned(),
            rounds => format!("{rounds} rounds"),
        };
        Some(format!(
            "Springs of {:e} of the blocks' stiffness change displacements by {} before they are \
             centred anew; {rounds} to {:e} in {} s",
            it.stiffness,
            significant(it.bias?, 2),
            it.tolerance,
            significant(it.seconds?, 2)
        ))
    });
    let first = told.next()?;
    Some(match told.next_back() {
        Some(last) => format!("{first}. {last}."),
        None => first + ".",
    })
}
