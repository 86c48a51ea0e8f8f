//! The forms of problems, each with the methods that treat it.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use lcp::{BoxedLcp, HorizontalLcp, Lcp, Method, MixedLcp, Qp, Solution, WarmStart};
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::arrays::{GivenMatrix, GivenVector, vector};
use crate::options::{Options, by_method};
use crate::watch::{refused, solve};

/// Solves `w = M z + q`.
#[pyfunction]
pub(crate) fn solve_standard(
    py: Python<'_>,
    m: GivenMatrix<'_>,
    q: GivenVector<'_>,
    options: Options,
) -> PyResult<Answer> {
    let problem = Lcp::new(m.matrix()?, vector(&q)).map_err(|error| refused(&error))?;
    let solution = by_method!(
        py, options, WarmStart::None, &problem,
        Newton => newton, Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    Ok(Answer::of_pairs(py, solution))
}

/// Solves `A t + B y = c`.
#[pyfunction]
pub(crate) fn solve_horizontal(
    py: Python<'_>,
    a: GivenMatrix<'_>,
    b: GivenMatrix<'_>,
    c: GivenVector<'_>,
    options: Options,
) -> PyResult<Answer> {
    let problem = HorizontalLcp::new(a.matrix()?, b.matrix()?, vector(&c));
    let problem = problem.map_err(|error| refused(&error))?;
    let solution = by_method!(
        py, options, WarmStart::None, &problem,
        Newton => newton, Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    Ok(Answer::of_pairs(py, solution))
}

/// Solves `w = M z + q` with free variables.
#[pyfunction]
pub(crate) fn solve_mixed(
    py: Python<'_>,
    m: GivenMatrix<'_>,
    q: GivenVector<'_>,
    free: Vec<bool>,
    options: Options,
) -> PyResult<Answer> {
    let problem = MixedLcp::new(m.matrix()?, vector(&q), free).map_err(|error| refused(&error))?;
    let solution = mixed(py, &problem, &options)?;
    let (z, w) = problem.variables(&solution);
    Ok(Answer::new(py, solution, vec![z, w]))
}

fn mixed(py: Python<'_>, problem: &MixedLcp, options: &Options) -> PyResult<Solution<MixedLcp>> {
    by_method!(
        py, options, WarmStart::None, problem,
        Interior => interior, QuadraticProgram => program
    )
}

/// Solves `w = M z + q` between bounds.
#[pyfunction]
pub(crate) fn solve_boxed(
    py: Python<'_>,
    m: GivenMatrix<'_>,
    q: GivenVector<'_>,
    lower: GivenVector<'_>,
    upper: GivenVector<'_>,
    options: Options,
) -> PyResult<Answer> {
    let problem = BoxedLcp::new(m.matrix()?, vector(&q), vector(&lower), vector(&upper));
    let problem = problem.map_err(|error| refused(&error))?;
    let solution = by_method!(
        py, options, WarmStart::None, &problem,
        Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    let (z, w) = problem.variables(&solution);
    Ok(Answer::new(py, solution, vec![z, w]))
}

/// Minimises `x.P x / 2 + q.x` with `l <= A x <= u` and bounds of `x`. The arrays are `x`, the multipliers of rows and
/// bounds, and the objective.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the data of a program")]
pub(crate) fn solve_program(
    py: Python<'_>,
    p: GivenMatrix<'_>,
    q: GivenVector<'_>,
    a: GivenMatrix<'_>,
    l: GivenVector<'_>,
    u: GivenVector<'_>,
    bounds: [GivenVector<'_>; 2],
    options: Options,
) -> PyResult<Answer> {
    let [lower, upper] = bounds.each_ref().map(vector);
    let program = Qp::new(p.matrix()?, vector(&q), a.matrix()?, vector(&l), vector(&u))
        .and_then(|program| program.with_bounds(lower, upper))
        .map_err(|error| refused(&error))?;
    let solution = mixed(py, program.mixed(), &options)?;
    let point = program.variables(&solution);
    let arrays = vec![point.x, point.rows, point.bounds, vec![point.objective]];
    Ok(Answer::new(py, solution, arrays))
}
