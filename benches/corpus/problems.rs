//! Complementarity problems: generated families, and published files where they are at hand.

use lcp::{Auto, HorizontalLcp, Lcp, MixedLcp, Solution, Solver};
use lcp_problems::families::{self, Instance};
use lcp_problems::io::{Problem, read_file};

use crate::common;
use crate::forms::{CLASSES, Random};
use crate::line::Line;
use crate::transform::Equivalent;

type Keep<'a> = &'a mut dyn FnMut(Line);

/// Solves all that are chosen.
pub(crate) fn solve(is_chosen: &dyn Fn(&str) -> bool, keep: Keep<'_>) {
    standard(is_chosen, keep);
    let seeds = 0..3;
    for n in [9, 24, 60] {
        for seed in seeds.clone() {
            for (name, family) in HORIZONTAL {
                one(&format!("horizontal/{name} {n} {seed}"), is_chosen, keep, || {
                    family(n, seed).problem
                });
            }
            for (name, family) in MIXED {
                one(&format!("mixed/{name} {n} {seed}"), is_chosen, keep, || {
                    family(n, seed).problem
                });
            }
        }
    }
    for steps in [5, 10, 20, 40] {
        for seed in 0..20 {
            let control = || families::control(steps, seed).problem;
            one(&format!("control/boxed {steps} {seed}"), is_chosen, keep, control);
            let as_general = || control().to_general();
            one(&format!("control/general {steps} {seed}"), is_chosen, keep, as_general);
        }
    }
    for seed in 0..3 {
        let control = || families::control(400, seed).problem;
        one(&format!("control/boxed 400 {seed}"), is_chosen, keep, control);
    }
    for n in [10, 100, 1000] {
        for (interest, volatility) in [(0.02, 0.4), (0.1, 0.2)] {
            let name = format!("options/{n} {interest} {volatility}");
            one(&name, is_chosen, keep, || {
                families::perpetual_option(n, interest, volatility).problem
            });
        }
    }
    published(is_chosen, keep);
}

type Family<P> = fn(usize, u64) -> Instance<P>;

const STANDARD: [(&str, Family<Lcp>); 10] = [
    ("positive definite", families::positive_definite),
    ("positive semidefinite", families::positive_semidefinite),
    ("P", families::p_matrix),
    ("strictly copositive", families::strictly_copositive),
    ("copositive-plus", families::copositive_plus),
    ("ties", families::ties),
    ("Harker and Pang", families::harker_pang),
    ("infeasible", families::infeasible_semidefinite),
    ("indefinite", families::indefinite),
    ("triangular", families::triangular),
];
const HORIZONTAL: [(&str, Family<HorizontalLcp>); 3] = [
    ("monotone", families::horizontal_monotone),
    ("singular", families::horizontal_singular),
    ("infeasible", families::infeasible),
];
const MIXED: [(&str, Family<MixedLcp>); 2] =
    [("monotone", families::mixed_monotone), ("singular", families::mixed_singular)];

fn standard(is_chosen: &dyn Fn(&str) -> bool, keep: Keep<'_>) {
    for n in [6, 12, 18, 30, 60] {
        for seed in 0..3 {
            for (name, family) in STANDARD {
                let name = format!("standard/{name} {n} {seed}");
                one(&name, is_chosen, keep, || family(n, seed).problem);
            }
            let game = || families::bimatrix(n / 2, n / 2, seed).problem;
            one(&format!("games/{n} {seed}"), is_chosen, keep, game);
        }
    }
    for seed in 0..6 {
        let game = || families::bimatrix(60, 60, seed).problem;
        one(&format!("games/120 {seed}"), is_chosen, keep, game);
    }
    for n in [5, 10, 15] {
        one(&format!("textbook/Murty {n}"), is_chosen, keep, || families::murty(n).problem);
        one(&format!("textbook/Fathi {n}"), is_chosen, keep, || families::fathi(n).problem);
    }
    for side in [10, 40] {
        let obstacle = || families::obstacle(side).problem;
        one(&format!("textbook/obstacle {side}"), is_chosen, keep, obstacle);
    }
}

fn one<P>(name: &str, is_chosen: &dyn Fn(&str) -> bool, keep: Keep<'_>, problem: impl FnOnce() -> P)
where
    Auto: Solver<P>,
{
    if is_chosen(name) {
        let solution = Auto::default().solve(&problem()).expect("sound data");
        keep(Line::of_solution(name.to_owned(), &solution));
    }
}

/// Where published problems, and those that once went wrong, are looked for, beside the repository.
const FILES: [(&str, &str); 2] =
    [("published", "../shared/lcp-problems"), ("cases", "../shared/cases")];

fn published(is_chosen: &dyn Fn(&str) -> bool, keep: Keep<'_>) {
    let files = FILES.into_iter().flat_map(|(group, folder)| {
        let folder = std::fs::read_dir(common::root().join(folder)).into_iter().flatten();
        folder.filter_map(move |entry| Some((group, entry.ok()?.path())))
    });
    for (group, path) in files {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let Ok(file) = read_file(&path, None) else { continue };
        if group == "published" {
            forms_of(&stem, &file.problem, is_chosen, keep);
        }
        let name = format!("{group}/{stem}");
        if !is_chosen(&name) {
            continue;
        }
        let solution = match &file.problem {
            Problem::Lcp(problem) => Auto::default().solve(problem).map(Solution::of_pairs),
            Problem::Horizontal(problem) => Auto::default().solve(problem),
            Problem::Mixed(problem) => Auto::default().solve(problem).map(Solution::of_pairs),
            Problem::Boxed(problem) => Auto::default().solve(problem).map(Solution::of_pairs),
            Problem::Friction(problem) => Auto::default().solve(problem).map(Solution::of_pairs),
            Problem::Contact(problem) => Auto::default().solve(problem).map(Solution::of_pairs),
            other => unreachable!("{} is no kind of problem here", other.kind()),
        };
        keep(Line::of_solution(name, &solution.expect("sound data")));
    }
}

/// The first form of every class of forms that have the same solutions.
fn forms_of(stem: &str, problem: &Problem, is_chosen: &dyn Fn(&str) -> bool, keep: Keep<'_>) {
    let original = Equivalent::original(problem.to_general());
    // The first class is the problem itself.
    for (class, forms) in &CLASSES[1..] {
        let form = forms(&mut Random::new(0), &original).swap_remove(0);
        one(&format!("forms/{stem} {class}"), is_chosen, keep, || form.problem);
    }
}
