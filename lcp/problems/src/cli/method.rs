//! The method named on the command line, applied to the problem of the file.

use std::io::Read;

use super::args::SolveArgs;
use super::input::Point;
use super::output::Failure;
use crate::io::{Problem, each};
use lcp::{
    Auto, AutoSettings, Basis, BoxedLcp, Contact2d, Enumeration, Error, Friction2d, HorizontalLcp,
    InteriorPoint, InteriorPointSettings, Lcp, Lemke, LemkeSettings, Method, MixedLcp,
    ProjectedGaussSeidel, ProjectedGaussSeidelSettings, QuadraticProgram, QuadraticProgramSettings,
    SemismoothNewton, SemismoothNewtonSettings, Side, Solution, Solver, WarmStart,
};

/// Solves by a method in the forms that it treats: friction in the standard form if the method treats only that, and
/// others in their general form. An answer to another form is judged by the problem of the file.
macro_rules! in_a_form {
    ($solver:expr, $problem:expr, $($own:ident)|+ $(, standard of $standard:ident)?) => {
        match $problem {
            $(Problem::$own(problem) => $solver.solve(problem).map(Solution::of_pairs),)+
            $(Problem::$standard(problem) => {
                let solution = $solver.solve(problem.standard());
                solution.map(|it| judged($problem, it.of_pairs(), $solver.settings().tolerance))
            })?
            other => {
                let solution = $solver.solve(&other.to_general());
                solution.map(|it| judged(other, it, $solver.settings().tolerance))
            }
        }
    };
}

/// A point of another form of the problem, judged by the problem itself.
fn judged(problem: &Problem, mut solution: Solution, tolerance: f64) -> Solution {
    let (z, w) = problem.recover(&solution.t, &solution.y);
    solution.judge_again(problem.residuals(&z, &w), tolerance);
    solution
}

/// Solves the problem in its own form if the method treats that, else in the general form. The solution has the pairs
/// of the general form in any case.
pub(super) fn solve(
    args: &SolveArgs,
    stdin: &mut dyn Read,
    problem: &Problem,
) -> Result<Solution, Failure> {
    if let Problem::Qp(program) = problem {
        return solve(args, stdin, &Problem::Mixed(program.mixed().clone()));
    }
    let SolveArgs { time_limit, max_pivots, attempts: max_attempts, .. } = *args;
    let start = start(args, stdin, problem)?;
    let tolerance = |default| args.tol.unwrap_or(default);
    /// A method with these options, and its own defaults for the others.
    macro_rules! iterative {
        ($method:ident, $settings:ident) => {{
            let mut settings = $settings::default();
            settings.tolerance = tolerance(settings.tolerance);
            settings.max_iterations = args.max_iterations.unwrap_or(settings.max_iterations);
            (settings.time_limit, settings.start) = (time_limit, start);
            $method::new(settings)
        }};
    }
    let solution = match method(args)? {
        Method::Auto => {
            let tolerance = tolerance(AutoSettings::default().tolerance);
            let settings = AutoSettings { tolerance, time_limit, max_attempts, start };
            in_its_form(&Auto::new(settings), problem)
        }
        Method::Lemke => {
            let defaults = LemkeSettings::default();
            let settings = LemkeSettings {
                tolerance: tolerance(defaults.tolerance),
                max_pivots,
                max_attempts,
                covering: args.covering.clone().unwrap_or_default(),
                trace: args.trace.is_some(),
                time_limit,
                start,
                ..defaults
            };
            in_its_form(&Lemke::new(settings), problem)
        }
        Method::Enumeration => {
            let tolerance = tolerance(AutoSettings::default().tolerance);
            in_its_form(&Enumeration { tolerance, time_limit }, problem)
        }
        Method::GaussSeidel => {
            let solver = iterative!(ProjectedGaussSeidel, ProjectedGaussSeidelSettings);
            in_a_form!(solver, problem, Lcp | Horizontal | Boxed | Friction | Contact)
        }
        Method::QuadraticProgram => {
            let solver = iterative!(QuadraticProgram, QuadraticProgramSettings);
            in_a_form!(solver, problem, Lcp | Mixed | Boxed | Contact, standard of Friction)
        }
        Method::Newton => {
            let solver = iterative!(SemismoothNewton, SemismoothNewtonSettings);
            in_a_form!(solver, problem, Lcp, standard of Friction)
        }
        Method::Interior => {
            let solver = iterative!(InteriorPoint, InteriorPointSettings);
            in_a_form!(solver, problem, Lcp | Mixed | Boxed | Friction | Contact)
        }
        other => return Err(format!("{other} is not a method of the command").into()),
    };
    Ok(solution?)
}

/// The method, after a check of the options that only some methods have.
fn method(args: &SolveArgs) -> Result<Method, Failure> {
    let pivots = [
        ("--max-pivots", args.max_pivots.is_some()),
        ("--covering", args.covering.is_some()),
        ("--trace", args.trace.is_some()),
        ("--attempts", args.attempts.is_some()),
    ];
    let asked = pivots.iter().find_map(|&(option, is_given)| is_given.then_some(option));
    match (args.solver, asked) {
        (Method::Auto | Method::Lemke, _) if args.max_iterations.is_some() => Err(
            "--max-iterations is for one of the iterative methods: choose it by --solver pgs, qp, newton \
             or interior, or leave the option out; pivots of lemke have --max-pivots"
                .into(),
        ),
        (Method::Auto, Some("--attempts")) => Ok(Method::Auto),
        (Method::Auto, Some(_)) => Ok(Method::Lemke),
        (method, None) | (method @ Method::Lemke, _) => Ok(method),
        (method, Some(option)) => Err(format!(
            "{option} is about the pivots of Lemke's method, and {} has none: leave it out, or take \
             --solver lemke",
            method.full_name()
        )
        .into()),
    }
}

fn start(args: &SolveArgs, stdin: &mut dyn Read, problem: &Problem) -> Result<WarmStart, Failure> {
    let Some(start) = &args.start else { return Ok(WarmStart::None) };
    let all = |side| WarmStart::Basis(Basis::all(side, problem.to_general().order()));
    match start.to_str() {
        Some("all-y") => Ok(all(Side::Y)),
        Some("all-t") => Ok(all(Side::T)),
        _ => {
            let (t, y) = Point::read(start, stdin, problem)?.pairs;
            Ok(WarmStart::Point { t, y })
        }
    }
}

/// Solves by a method that treats every form.
fn in_its_form<S>(solver: &S, problem: &Problem) -> Result<Solution, Error>
where
    S: Solver<Lcp>
        + Solver<HorizontalLcp>
        + Solver<MixedLcp>
        + Solver<BoxedLcp>
        + Solver<Friction2d>
        + Solver<Contact2d>,
{
    each!(problem, problem => solver.solve(problem).map(Solution::of_pairs))
}
