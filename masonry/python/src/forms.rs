//! Solves the forms of problems, each by the methods that treat the form.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use lcp::{BoxedLcp, HorizontalLcp, Lcp, Method, MixedLcp, Qp, Solution, WarmStart};
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::arrays::{GivenMatrix, GivenVector, vector};
use crate::options::{Options, by_method};
use crate::watch::{refused, solve};

/// Solves the linear complementarity problem `w = M z + q`, `w, z >= 0`, `w.z = 0`.
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

/// Solves the horizontal linear complementarity problem `A t + B y = c`, `t, y >= 0`, `t.y = 0`.
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

/// Solves the mixed linear complementarity problem `w = M z + q`, in which `z` is free and `w` zero at the places where
/// `free` is true; all other pairs satisfy `w, z >= 0`, `w z = 0`.
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

/// Solves the boxed linear complementarity problem `w = M z + q`, `lower <= z <= upper`, in which `w` may be positive
/// only at the lower bound and negative only at the upper one.
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

/// Solves the quadratic program: minimises `x.P x / 2 + q.x` subject to `l <= A x <= u` and bounds of `x`. The arrays
/// are `x`, the multipliers of rows and of bounds, and the objective.
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
