//! Solves that the interpreter's lock does not wait for, and that a callback and Ctrl-C may end.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use lcp::{Error, Iteration, Solution, Solver};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// How long signals may wait. Chosen: a person does not notice it, and the lock is hardly taken.
const PATIENCE: Duration = Duration::from_millis(50);

/// The solution of a problem, with the lock released. An exception of the callback, or of a signal, ends the solve and is raised.
pub(crate) fn solve<P: Sync>(
    py: Python<'_>,
    solver: &(impl Solver<P> + Sync),
    problem: &P,
    callback: Option<&Py<PyAny>>,
) -> PyResult<Solution<P>>
where
    Solution<P>: Send,
{
    let (solution, raised) = py.detach(|| {
        let (mut looked, mut raised) = (Instant::now(), None);
        let mut observer = |at: &Iteration| {
            if callback.is_none() && looked.elapsed() < PATIENCE {
                return ControlFlow::Continue(());
            }
            looked = Instant::now();
            match Python::attach(|py| asked(py, callback, at)) {
                Ok(false) => ControlFlow::Continue(()),
                Ok(true) => ControlFlow::Break(()),
                Err(error) => {
                    raised = Some(error);
                    ControlFlow::Break(())
                }
            }
        };
        let solution = solver.solve_observed(problem, &mut observer);
        (solution, raised)
    });
    match raised {
        Some(error) => Err(error),
        None => solution.map_err(|error| refused(&error)),
    }
}

/// Whether the callback asks for an end, by returning something true.
fn asked(py: Python<'_>, callback: Option<&Py<PyAny>>, at: &Iteration) -> PyResult<bool> {
    py.check_signals()?;
    match callback {
        Some(callback) => callback.call1(py, (at.iteration, at.residual))?.bind(py).is_truthy(),
        None => Ok(false),
    }
}

/// Bad input as an exception.
pub(crate) fn refused(error: &Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
