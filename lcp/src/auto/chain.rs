//! Runs one method after the other.

use web_time::{Duration, Instant};

use super::AutoSettings;
use super::constants::{FEW_ATTEMPTS, KEPT};
use super::method::{Budget, Planned, chain_of};
use crate::{Certificate, Error, Method, MethodRun, Observer, RunEnd, Solution, Status};

/// The rank of an answer; earlier variants are more decisive.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Rank {
    /// Solved, or proved to have no solution.
    Decided,
    /// Residuals are below the root of the tolerance.
    Near,
    Ray,
    Open,
}

/// Tries the methods of a problem until one has the answer.
pub(super) fn run<P: Planned>(
    problem: &P,
    settings: &AutoSettings,
    observer: &mut Observer<'_>,
) -> Result<Solution, Error> {
    let began = Instant::now();
    let mut runs = Vec::new();
    let mut best: Option<Solution> = None;
    let mut cut = None;
    let steps = chain_of(problem, settings.max_attempts);
    let count = steps.len();
    for (place, step) in steps.into_iter().enumerate() {
        let left = settings.time_limit.map(|limit| limit.saturating_sub(began.elapsed()));
        if best.is_some() && left == Some(Duration::ZERO) {
            cut = Some(Status::TimeLimit);
            break;
        }
        let most = settings.max_attempts.unwrap_or(usize::MAX);
        let few = step.is_brief.then_some(most.min(FEW_ATTEMPTS));
        let effort = Budget {
            tolerance: settings.tolerance,
            time_limit: left.map(|left| share(left, count - 1 - place)),
            max_attempts: few.or(settings.max_attempts),
            start: &settings.start,
        };
        let route_began = Instant::now();
        let answer = match problem.solver(step.method, &effort).solve_pairs(problem, observer) {
            Err(Error::NotTreated { reason, .. }) => Err(reason),
            answer => Ok(answer?),
        };
        let end = match &answer {
            Ok(Solution { status, residuals, .. }) => {
                RunEnd::Ended { status: *status, residual: residuals.worst() }
            }
            Err(reason) => RunEnd::Refused { reason: reason.clone() },
        };
        let info = answer.as_ref().map(|it| &it.info);
        runs.push(MethodRun {
            method: step.method,
            reason: step.told(problem).reason,
            end,
            pivots: info.map_or(0, |it| it.pivots),
            factorisations: info.map_or(0, |it| it.factorisations),
            seconds: route_began.elapsed().as_secs_f64(),
        });
        let Ok(solution) = answer else { continue };
        let (is_last, status) = (is_final(&solution), solution.status);
        best = Some(better(best, solution, settings.tolerance));
        if matches!(status, Status::Cancelled | Status::TimeLimit) {
            cut = Some(status);
        }
        if is_last {
            break;
        }
    }
    let mut solution = best.ok_or_else(|| all_refused(&runs))?;
    let (rank, _) = rank(&solution, settings.tolerance);
    let is_open = matches!(rank, Rank::Near | Rank::Open);
    if let Some(status) = cut
        && is_open
        && solution.status != Status::AlmostSolved
    {
        solution.status = status;
    }
    solution.info.runs = runs;
    solution.info.seconds = began.elapsed().as_secs_f64();
    Ok(solution)
}

/// Share of a method in the time left, if `others` methods follow.
pub(super) fn share(left: Duration, others: usize) -> Duration {
    if others > 0 { left.saturating_sub(left / KEPT) } else { left }
}

/// Whether no other method is tried after this solution.
pub(super) fn is_final(solution: &Solution) -> bool {
    match solution.status {
        Status::Solved | Status::Cancelled => true,
        Status::Infeasible | Status::NoSolution => {
            solution.certificate.as_ref().is_some_and(Certificate::is_proof)
        }
        _ => false,
    }
}

/// The more decisive solution; the earlier one if both have the same rank.
pub(super) fn better(best: Option<Solution>, other: Solution, tolerance: f64) -> Solution {
    match best {
        Some(best) if rank(&best, tolerance) <= rank(&other, tolerance) => best,
        _ => other,
    }
}

pub(super) fn rank(solution: &Solution, tolerance: f64) -> (Rank, f64) {
    let residual = solution.residuals.worst();
    let rank = match solution.status {
        Status::Solved | Status::Infeasible | Status::NoSolution => Rank::Decided,
        Status::AlmostSolved => Rank::Near,
        _ if residual <= tolerance.sqrt() => Rank::Near,
        Status::RayTermination if solution.ray().is_some() => Rank::Ray,
        _ => Rank::Open,
    };
    (rank, residual)
}

fn all_refused(runs: &[MethodRun]) -> Error {
    let reasons = runs.iter().filter_map(|run| match &run.end {
        RunEnd::Refused { reason } => Some(format!("{}: {reason}", run.method.full_name())),
        RunEnd::Ended { .. } => None,
    });
    let reasons: Vec<String> = reasons.collect();
    let reason = format!("no method of its chain does. {}", reasons.join("; "));
    Error::NotTreated { method: Method::Auto, reason }
}

#[cfg(test)]
mod tests {
    use faer::mat;

    use super::*;
    use crate::{Auto, Lcp, Solver};

    #[test]
    fn where_all_refuse_all_reasons_are_given() {
        let run = |method, reason: &str| MethodRun {
            method,
            reason: "a test".to_owned(),
            end: RunEnd::Refused { reason: reason.to_owned() },
            pivots: 0,
            factorisations: 0,
            seconds: 0.0,
        };
        let runs = [run(Method::Lemke, "no memory"), run(Method::Newton, "no diagonal")];
        let message = all_refused(&runs).to_string();
        assert!(message.contains("Lemke's method: no memory; semismooth Newton: no diagonal"));
    }

    /// Each method leaves time for those behind it, and the last one has all that is left.
    #[test]
    fn methods_share_the_time() {
        let hour = Duration::from_secs(3600);
        assert_eq!((share(hour, 2), share(hour, 0)), (Duration::from_secs(2700), hour));
    }

    #[test]
    fn a_proof_says_more_than_a_point_that_is_near_and_a_stall_less() {
        let lcp = Lcp::new(mat![[2.0]], vec![-1.0]).expect("one number each");
        let solved =
            Solver::<Lcp>::solve(&Auto::default(), &lcp).expect("valid settings").of_pairs();
        let with = |status, residual: f64| {
            let mut solution = solved.clone();
            (solution.status, solution.residuals.equation) = (status, residual);
            solution
        };
        let (stalled, near) = (with(Status::Stalled, 0.1), with(Status::Stalled, 1e-9));
        let proved = with(Status::Infeasible, 1.0);
        let chosen = |best: &Solution, other: &Solution| {
            better(Some(best.clone()), other.clone(), 1e-10).residuals.equation.to_bits()
        };
        assert_eq!(chosen(&stalled, &near), 1e-9_f64.to_bits());
        assert_eq!(chosen(&near, &stalled), 1e-9_f64.to_bits());
        assert_eq!(chosen(&near, &solved), solved.residuals.equation.to_bits());
        assert_eq!(chosen(&near, &proved), 1.0_f64.to_bits());
    }
}
