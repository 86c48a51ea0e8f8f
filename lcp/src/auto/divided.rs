//! Independent parts one by one: each has a chain, units and limits of its own.

use web_time::{Duration, Instant};

use super::AutoSettings;
use super::chain::{self, Rank};
use super::constants::MANY_PARTS;
use super::method::{Choice, Planned, chain_of};
use crate::divide::{Joined, Part, put};
use crate::{
    Basis, Certificate, Error, Method, MethodRun, Observer, RunEnd, Side, Solution, Status,
};

/// A part and its answer.
type PartAnswer<P> = (Part<P>, Solution);

/// Solves a problem by its parts, if it has several.
pub(super) fn run<P: Planned>(
    problem: &P,
    settings: &AutoSettings,
    observer: &mut Observer<'_>,
) -> Result<Solution, Error> {
    settings.validate(problem.pairs())?;
    let Some(parts) = problem.parts() else { return chain::run(problem, settings, observer) };
    let began = Instant::now();
    let mut tried = None;
    if parts.len() > MANY_PARTS {
        let time_limit = settings.time_limit.map(|limit| chain::share(limit, 1));
        let settings = AutoSettings { time_limit, ..settings.clone() };
        let solution = chain::run(problem, &settings, observer)?;
        if chain::is_final(&solution) {
            return Ok(solution);
        }
        tried = Some(solution);
    }
    match solve(parts, settings, began, observer) {
        Ok(answers) => {
            let mut whole = join(problem, answers, settings.tolerance);
            whole.info.seconds = began.elapsed().as_secs_f64();
            Ok(chain::better(tried, whole, settings.tolerance))
        }
        Err(error) => tried.ok_or(error),
    }
}

/// The plans of the parts; a method at the same place of several plans is listed there once.
pub(super) fn plan<P: Planned>(problem: &P, max_attempts: Option<usize>) -> Vec<Choice> {
    let Some(parts) = problem.parts().filter(|parts| parts.len() <= MANY_PARTS) else {
        return told(problem, max_attempts);
    };
    let plans = parts.iter().map(|part| told(&part.problem, max_attempts));
    let is_same = |a: &Choice, b: &Choice| a.method == b.method;
    merged(plans, is_same, |_, _| {})
        .into_iter()
        .map(|(step, count)| Choice { reason: named(&step.reason, count, parts.len()), ..step })
        .collect()
}

fn told<P: Planned>(problem: &P, max_attempts: Option<usize>) -> Vec<Choice> {
    chain_of(problem, max_attempts).into_iter().map(|step| step.told(problem)).collect()
}

fn named(reason: &str, count: usize, parts: usize) -> String {
    format!("{count} of {parts} independent parts, the first: {reason}")
}

/// Merges the lists of several parts: equal entries at the same place become one entry, with their number.
fn merged<T>(
    lists: impl Iterator<Item = Vec<T>>,
    is_same: impl Fn(&T, &T) -> bool,
    add: impl Fn(&mut T, &T),
) -> Vec<(T, usize)> {
    let mut places: Vec<Vec<(T, usize)>> = Vec::new();
    for list in lists {
        for (place, entry) in list.into_iter().enumerate() {
            if place == places.len() {
                places.push(Vec::new());
            }
            match places[place].iter_mut().find(|(first, _)| is_same(first, &entry)) {
                Some((first, count)) => {
                    *count += 1;
                    add(first, &entry);
                }
                None => places[place].push((entry, 1)),
            }
        }
    }
    places.into_iter().flatten().collect()
}

fn is_same_end(a: &MethodRun, b: &MethodRun) -> bool {
    let status = |run: &MethodRun| match &run.end {
        RunEnd::Ended { status, .. } => Some(*status),
        RunEnd::Refused { .. } => None,
    };
    a.method == b.method && status(a) == status(b)
}

/// Adds the work of another run, and keeps the larger residual.
fn add_run(first: &mut MethodRun, other: &MethodRun) {
    first.pivots += other.pivots;
    first.factorisations += other.factorisations;
    first.seconds += other.seconds;
    if let RunEnd::Ended { residual: largest, .. } = &mut first.end
        && let RunEnd::Ended { residual, .. } = &other.end
    {
        *largest = largest.max(*residual);
    }
}

/// Solves one part after the other, until one of them proves that the linear conditions have no solution. The time left
/// is divided evenly among the remaining parts: the smallest come first and leave their unused time to the others.
fn solve<P: Planned>(
    parts: Vec<Part<P>>,
    settings: &AutoSettings,
    began: Instant,
    observer: &mut Observer<'_>,
) -> Result<Vec<PartAnswer<P>>, Error> {
    let mut answers: Vec<Option<PartAnswer<P>>> = parts.iter().map(|_| None).collect();
    let mut order: Vec<(usize, Part<P>)> = parts.into_iter().enumerate().collect();
    order.sort_by_key(|(_, part)| part.pairs.len());
    let count = u32::try_from(order.len()).unwrap_or(u32::MAX);
    for ((place, part), remaining) in order.into_iter().zip((1..=count).rev()) {
        let left = |limit: Duration| limit.saturating_sub(began.elapsed());
        let settings = AutoSettings {
            time_limit: settings.time_limit.map(|limit| left(limit) / remaining),
            start: part.start(&settings.start),
            ..settings.clone()
        };
        let answer = chain::run(&part.problem, &settings, observer)?;
        let is_last = match answer.status {
            Status::Infeasible => is_proof(&answer),
            status => status == Status::Cancelled,
        };
        answers[place] = Some((part, answer));
        if is_last {
            break;
        }
    }
    Ok(answers.into_iter().flatten().collect())
}

/// The answer of the whole: its status is the least decisive one of the parts, unless one part proves that the whole
/// has no solution.
fn join<P: Planned>(problem: &P, mut answers: Vec<PartAnswer<P>>, tolerance: f64) -> Solution {
    let pairs = problem.pairs();
    let (mut t, mut y) = (vec![0.0; pairs], vec![0.0; pairs]);
    for (part, answer) in &answers {
        put(&part.pairs, &answer.t, &mut t);
        put(&part.pairs, &answer.y, &mut y);
    }
    let (otherwise, certificate) = outcome(&answers, tolerance, pairs);
    let Joined { residuals, contact, boxed } = problem.join(&t, &y, &answers);
    let whole = Solution::judged(t, y, residuals, tolerance, otherwise);
    let mut whole = Solution { contact, boxed, ..whole };
    whole.certificate = certificate.filter(|_| whole.status == otherwise);
    whole.basis = joined_basis(&answers, pairs);
    // Blocks are equilibrated, so that their norms are alike.
    let mut conditions = answers.iter().map(|(_, answer)| answer.condition);
    whole.condition = conditions.try_fold(0.0_f64, |largest, it| Some(largest.max(it?)));
    // The first of the largest parts represents all.
    let largest = answers.iter().rev().max_by_key(|(part, _)| part.pairs.len());
    whole.info.method = largest.map_or(Method::Auto, |(_, answer)| answer.info.method);
    for (_, answer) in &mut answers {
        whole.info.add_work(&mut answer.info);
    }
    let count = answers.len();
    let runs = answers.into_iter().map(|(_, answer)| answer.info.runs);
    for (mut run, of_parts) in merged(runs, is_same_end, add_run) {
        run.reason = named(&run.reason, of_parts, count);
        whole.info.runs.push(run);
    }
    whole
}

fn is_proof(answer: &Solution) -> bool {
    answer.certificate.as_ref().is_some_and(Certificate::is_proof)
}

fn outcome<P>(
    answers: &[PartAnswer<P>],
    tolerance: f64,
    pairs: usize,
) -> (Status, Option<Certificate>) {
    let says = |(_, answer): &&PartAnswer<P>| match chain::rank(answer, tolerance).0 {
        _ if is_proof(answer) && answer.status == Status::Infeasible => 4,
        _ if is_proof(answer) => 3,
        Rank::Decided => 0,
        Rank::Near | Rank::Ray | Rank::Open => 1,
    };
    let Some((part, answer)) = answers.iter().max_by_key(says) else {
        return (Status::Stalled, None);
    };
    let certificate = answer.certificate.as_ref();
    (answer.status, certificate.map(|it| part.certificate(it, pairs)))
}

/// The basis of the whole, if all parts have one.
fn joined_basis<P>(answers: &[PartAnswer<P>], pairs: usize) -> Option<Basis> {
    let mut sides = vec![Side::T; pairs];
    for (part, answer) in answers {
        put(&part.pairs, answer.basis.as_ref()?.sides(), &mut sides);
    }
    let covered: usize = answers.iter().map(|(part, _)| part.pairs.len()).sum();
    (covered == pairs).then(|| Basis::new(sides))
}
