//! `lcp solve`.

use std::fmt::Write as _;
use std::io::Write;
use std::time::Duration;

use serde::Serialize;

use super::{
    Failure, NOT_SOLVED, SOLVED, SolveArgs, Solver, in_file, print, print_json, residual_lines,
};
use crate::io::{Problem, ProblemFile};
use crate::{
    Attempt, ContactForces, Lemke, LemkeSettings, Perturbation, Ray, Residuals, Solution, Status,
};

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Answer<'a> {
    status: Status,
    kind: &'static str,
    solver: &'static str,
    n: usize,
    time_s: f64,
    pivots: usize,
    residuals: Residuals,
    z: Vec<f64>,
    w: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts: Option<ContactForces>,
    certificate: Option<Certificate<'a>>,
    attempts: &'a [Attempt],
}

/// Why there is no solution, or none was found, in the general form.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Certificate<'a> {
    Ray(&'a Ray),
    Farkas { pi: &'a [f64] },
}

pub(super) fn run(args: &SolveArgs, out: &mut dyn Write) -> Result<u8, Failure> {
    let file = args.input.read()?;
    // There is one method so far, which is then also the one that suits best.
    let solver = match args.solver {
        Solver::Auto | Solver::Lemke => "lemke",
    };
    let problem = file.problem.to_general();
    if !problem.is_sparse() {
        check_memory(problem.order())?;
    }
    let solution = Lemke::new(settings(args)?).solve(&problem)?;
    if let Some(path) = &args.trace {
        let trace = serde_json::to_string(&solution.trace)? + "\n";
        std::fs::write(path, trace).map_err(|error| in_file(path, &error))?;
    }
    let answer = answer(&file.problem, &solution, solver);
    if args.input.json {
        print_json(out, &answer)?;
    } else {
        print(out, &report(&file, &answer))?;
    }
    Ok(if solution.is_solved() { SOLVED } else { NOT_SOLVED })
}

/// Refuses orders of dense problems for which the system has not the memory that [`Lemke`] takes, before it takes it.
fn check_memory(order: usize) -> Result<(), Failure> {
    const MATRICES: usize = 5;
    let entries = order.checked_mul(order).and_then(|square| square.checked_mul(MATRICES));
    let mut trial: Vec<f64> = Vec::new();
    match trial.try_reserve_exact(std::hint::black_box(entries.unwrap_or(usize::MAX))) {
        Ok(()) => Ok(()),
        Err(_) => Err(format!(
            "order {order} takes about {:.0} GB, which the system does not have: the method works \
             with {MATRICES} dense matrices of this order",
            (MATRICES * size_of::<f64>()) as f64 * (order as f64).powi(2) / 1e9
        )
        .into()),
    }
}

fn settings(args: &SolveArgs) -> Result<LemkeSettings, Failure> {
    let mut settings = LemkeSettings {
        max_pivots: args.max_pivots,
        trace: args.trace.is_some(),
        ..LemkeSettings::default()
    };
    if let Some(tolerance) = args.tol {
        settings.tolerance = tolerance;
    }
    if let Some(seconds) = args.time_limit {
        let limit = Duration::try_from_secs_f64(seconds)
            .map_err(|error| format!("--time-limit {seconds}: {error}"))?;
        settings.time_limit = Some(limit);
    }
    Ok(settings)
}

fn answer<'a>(problem: &Problem, solution: &'a Solution, solver: &'static str) -> Answer<'a> {
    let (z, w) = problem.recover(&solution.t, &solution.y);
    let contacts = match problem {
        Problem::Friction(problem) => Some(problem.forces(&z)),
        _ => None,
    };
    let farkas = solution.farkas.as_deref().map(|pi| Certificate::Farkas { pi });
    Answer {
        status: solution.status,
        kind: problem.kind(),
        solver,
        n: problem.order(),
        time_s: solution.info.seconds,
        pivots: solution.info.pivots,
        residuals: solution.residuals,
        z,
        w,
        contacts,
        certificate: farkas.or(solution.ray.as_ref().map(Certificate::Ray)),
        attempts: &solution.info.attempts,
    }
}

/// What a status means for the user, where its name does not say it.
fn meaning(status: Status) -> Option<&'static str> {
    Some(match status {
        Status::AlmostSolved => {
            "The residuals are above the tolerance; the best point is printed with --json."
        }
        Status::Infeasible => "There is no solution; --json prints the proof.",
        Status::RayTermination => {
            "No solution was found. That is no proof that there is none; --json prints the first ray."
        }
        Status::NoComplementaryBasis => {
            "No complementary basis is nonsingular, and with artificial columns no solution was found."
        }
        Status::PivotLimit => "The pivots were used up; --max-pivots allows more.",
        Status::TimeLimit => "The time was used up; --time-limit allows more.",
        Status::Cycling => {
            "A basis came back in an attempt, and the others found no solution either."
        }
        Status::NumericalTrouble => "Rounding errors could not be brought under control.",
        _ => return None,
    })
}

fn report(file: &ProblemFile, answer: &Answer<'_>) -> String {
    const LONGEST: usize = 40;
    let Answer { status, solver, n, pivots, time_s, .. } = answer;
    let mut text = format!("{} of order {n}, read as {}\n", answer.kind, file.format);
    let _ = writeln!(text, "{status}: {solver}, {pivots} pivots, {time_s:.3} s");
    if let Some(meaning) = meaning(*status) {
        let _ = writeln!(text, "{meaning}");
    }
    text.push('\n');
    text += &residual_lines(&answer.residuals);
    if *status != Status::Solved {
        for (number, attempt) in answer.attempts.iter().enumerate() {
            let Attempt { start, covering, perturbation, end, pivots, .. } = attempt;
            let perturbation = match perturbation {
                Perturbation::None => "as given".to_owned(),
                other => other.to_string(),
            };
            let number = number + 1;
            let _ = writeln!(
                text,
                "attempt {number}: start {start}, covering {covering}, data {perturbation}: {end:?} after \
                 {pivots} pivots"
            );
        }
        return text;
    }
    let (names, columns) = match &answer.contacts {
        Some(forces) => (["normal", "tangential"], [&forces.normal, &forces.tangential]),
        None => (["z", "w"], [&answer.z, &answer.w]),
    };
    let _ = writeln!(text, "\n{:>5} {:>16} {:>16}", "", names[0], names[1]);
    for (i, (first, second)) in columns[0].iter().zip(columns[1]).enumerate().take(LONGEST) {
        let _ = writeln!(text, "{i:>5} {first:>16.8e} {second:>16.8e}");
    }
    let more = columns[0].len().saturating_sub(LONGEST);
    if more > 0 {
        let _ = writeln!(text, "      and {more} more, all of them with --json");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three million unknowns: five dense matrices of them are more than any memory.
    #[test]
    fn an_order_beyond_the_memory_is_refused() {
        let message = check_memory(3_000_000).map_err(|error| error.to_string());
        let expected = "order 3000000 takes about 360000 GB, which the system does not have";
        assert!(message.is_err_and(|message| message.starts_with(expected)));
        assert!(check_memory(10).is_ok());
    }
}
