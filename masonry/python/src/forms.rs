//! The problems, each by the methods that treat it.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use std::sync::{Mutex, PoisonError};

use lcp::{
    BoxedLcp, Contact2d, HorizontalLcp, Lcp, Matrix, Method, MixedLcp, Qp, Solution, Solver, Vector,
};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::arrays::{GivenMatrix, vector};
use crate::options::Options;
use crate::watch::{refused, solve};

type GivenVector<'py> = PyReadonlyArray1<'py, f64>;

/// Solves by the method of the options, one of those that treat the problem; `other` says which these are.
macro_rules! by_method {
    ($py:expr, $options:expr, $problem:expr, $($method:ident => $solver:ident),*) => {{
        let callback = $options.callback.as_ref();
        match $options.method()? {
            Method::Auto => solve($py, &$options.auto()?, $problem, callback),
            Method::Lemke => solve($py, &$options.lemke()?, $problem, callback),
            Method::Enumeration => solve($py, &$options.enumeration()?, $problem, callback),
            $(Method::$method => solve($py, &$options.$solver()?, $problem, callback),)*
            other => Err(untreated(other, &[$(Method::$method),*])),
        }
    }};
}

fn untreated(method: Method, others: &[Method]) -> PyErr {
    let all = [Method::Auto, Method::Lemke, Method::Enumeration];
    let names: Vec<&str> = all.iter().chain(others).map(|method| method.name()).collect();
    let (name, names) = (method.name(), names.join(", "));
    PyValueError::new_err(format!(
        "method {name:?} does not treat this form: choose one of {names}"
    ))
}

/// `w = M z + q`
#[pyfunction]
pub(crate) fn solve_standard(
    py: Python<'_>,
    m: GivenMatrix<'_>,
    q: GivenVector<'_>,
    options: Options,
) -> PyResult<Answer> {
    let problem = Lcp::new(m.matrix()?, vector(&q)).map_err(|error| refused(&error))?;
    let solution = by_method!(
        py, options, &problem,
        Newton => newton, Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    Ok(Answer::of_pairs(py, solution))
}

/// `A t + B y = c`
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
        py, options, &problem,
        Newton => newton, Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    Ok(Answer::of_pairs(py, solution))
}

/// `w = M z + q` with free variables.
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
    by_method!(py, options, problem, Interior => interior, QuadraticProgram => program)
}

/// `w = M z + q` between bounds.
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
        py, options, &problem,
        Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    let (z, w) = problem.variables(&solution);
    Ok(Answer::new(py, solution, vec![z, w]))
}

/// `min x.P x / 2 + q.x` with `l <= A x <= u` and bounds of `x`. The arrays are `x`, the multipliers of rows and bounds, and the
/// objective.
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

/// Bodies in contact. The arrays are `u`, `t_n` and `t_t`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the data of a contact problem")]
pub(crate) fn solve_contact(
    py: Python<'_>,
    k: GivenMatrix<'_>,
    f: GivenVector<'_>,
    c_n: GivenMatrix<'_>,
    c_t: GivenMatrix<'_>,
    gap: GivenVector<'_>,
    slip: GivenVector<'_>,
    mu: GivenVector<'_>,
    compliance: PyReadonlyArray2<'_, f64>,
    options: Options,
) -> PyResult<Answer> {
    let compliance = compliance.as_array().outer_iter().map(|row| [row[0], row[1]]).collect();
    let [gap, slip, mu] = [gap, slip, mu].each_ref().map(vector);
    let [k, c_n, c_t] = [k.matrix()?, c_n.matrix()?, c_t.matrix()?];
    let problem = Contact2d::new(k, vector(&f), c_n, c_t, gap, slip, mu)
        .and_then(|problem| problem.with_compliance(compliance))
        .map_err(|error| refused(&error))?;
    let solution = by_method!(
        py, options, &problem,
        Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
    )?;
    let state = problem.variables(&solution);
    Ok(Answer::new(py, solution, vec![state.u, state.t_n, state.t_t]))
}

/// Many standard problems on all cores, in their order.
#[pyfunction]
pub(crate) fn solve_many(
    py: Python<'_>,
    problems: Vec<(GivenMatrix<'_>, GivenVector<'_>)>,
    options: Options,
) -> PyResult<Vec<Answer>> {
    let problem = |(number, (m, q)): (usize, &(GivenMatrix<'_>, GivenVector<'_>))| {
        let named =
            |error: PyErr| PyValueError::new_err(format!("problem {number}: {}", error.value(py)));
        let problem = m.matrix().map(|m| Lcp::new(m, vector(q)).map_err(|error| refused(&error)));
        problem.and_then(|problem| problem).map_err(named)
    };
    let problems = problems.iter().enumerate().map(problem).collect::<PyResult<Vec<Lcp>>>()?;
    let solver = options.auto()?;
    let answers = py.detach(|| solver.solve_all(&problems));
    let answer = |answer: Result<Solution<Lcp>, lcp::Error>| {
        Ok(Answer::of_pairs(py, answer.map_err(|error| refused(&error))?))
    };
    answers.into_iter().map(answer).collect()
}

/// A standard problem that is solved for one `q` after the other.
#[pyclass(frozen)]
pub(crate) struct Sequence {
    /// One thread at a time solves.
    sequence: Mutex<lcp::Sequence<usize>>,
}

#[pymethods]
impl Sequence {
    #[new]
    fn new(m: GivenMatrix<'_>, options: Options) -> PyResult<Self> {
        let m: Matrix = m.matrix()?;
        let zero = vec![0.0; m.nrows()];
        let keys: Vec<usize> = (0..m.nrows()).collect();
        let lcp = Lcp::new(m, Vector::from(zero)).map_err(|error| refused(&error))?;
        let settings = options.auto()?.settings().clone();
        let sequence = lcp::Sequence::new(lcp, &keys, settings).map_err(|error| refused(&error))?;
        Ok(Self { sequence: Mutex::new(sequence) })
    }

    fn solve(&self, py: Python<'_>, q: GivenVector<'_>) -> PyResult<Answer> {
        let q = vector(&q);
        let solved = || {
            let mut sequence = self.sequence.lock().unwrap_or_else(PoisonError::into_inner);
            sequence.solve(&q).cloned()
        };
        let solution = py.detach(solved).map_err(|error| refused(&error))?;
        Ok(Answer::of_pairs(py, solution))
    }
}
