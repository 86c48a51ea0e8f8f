//! Solves that release the interpreter's lock, and that a callback or Ctrl-C can end.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use lcp::{Error, Iteration, Solution, Solver};
use pyo3::call::PyCallArgs;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// The longest time for which a signal waits until it is handled. Chosen: a person does not notice it, and the lock is
/// hardly taken.
pub(crate) const PATIENCE: Duration = Duration::from_millis(50);

/// An observer that ends the work if a callback or a signal of the process demands it. The interpreter's lock is
/// released during the work.
pub(crate) struct Watch<'a> {
    callback: Option<&'a Py<PyAny>>,
    looked: Instant,
    raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(callback: Option<&'a Py<PyAny>>) -> Self {
        Self { callback, looked: Instant::now(), raised: None }
    }

    /// Calls the callback with these arguments. An exception of the callback or of a signal ends the work.
    pub(crate) fn ask(&mut self, told: impl for<'py> PyCallArgs<'py>) -> ControlFlow<()> {
        if self.raised.is_some() {
            return ControlFlow::Break(());
        }
        if self.callback.is_none() && self.looked.elapsed() < PATIENCE {
            return ControlFlow::Continue(());
        }
        self.looked = Instant::now();
        match Python::attach(|py| self.asked(py, told)) {
            Ok(false) => ControlFlow::Continue(()),
            Ok(true) => ControlFlow::Break(()),
            Err(error) => {
                self.raised = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// Calls the callback at an iteration of a solver.
    pub(crate) fn at(&mut self, at: &Iteration) -> ControlFlow<()> {
        self.ask((at.iteration, at.residual))
    }

    /// Calls the callback, and returns whether it ends the work by returning a true value.
    fn asked(&self, py: Python<'_>, told: impl for<'py> PyCallArgs<'py>) -> PyResult<bool> {
        py.check_signals()?;
        match self.callback {
            Some(callback) => callback.call1(py, told)?.bind(py).is_truthy(),
            None => Ok(false),
        }
    }

    /// Returns the exception that has ended the work as an error; `Ok` if there is none.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}

/// Does work with the interpreter's lock released. A panic is a fault of the library, and becomes an exception that
/// Python can handle.
pub(crate) fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| catch_unwind(AssertUnwindSafe(work)).ok()).ok_or_else(|| {
        PyRuntimeError::new_err(
            "a fault of the library, reported on standard error: please report it with the data that led to it",
        )
    })
}

/// Solves a problem, with the interpreter's lock released.
pub(crate) fn solve<P: Sync>(
    py: Python<'_>,
    solver: &(impl Solver<P> + Sync),
    problem: &P,
    callback: Option<&Py<PyAny>>,
) -> PyResult<Solution<P>>
where
    Solution<P>: Send,
{
    let mut watch = Watch::new(callback);
    let solution = detached(py, || solver.solve_observed(problem, &mut |at| watch.at(at)))?;
    watch.finish()?;
    solution.map_err(|error| refused(&error))
}

/// Returns the exception for bad input.
pub(crate) fn refused(error: &Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
