//! Solves that the interpreter's lock does not wait for, and that a callback and Ctrl-C may end.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use lcp::{Error, Iteration, Solution, Solver};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// How long signals may wait. Chosen: a person does not notice it, and the lock is hardly taken.
const PATIENCE: Duration = Duration::from_millis(50);

/// An observer that asks a callback, and the signals of the process, whether to go on. It is used with the lock released.
pub(crate) struct Watch<'a> {
    callback: Option<&'a Py<PyAny>>,
    looked: Instant,
    raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(callback: Option<&'a Py<PyAny>>) -> Self {
        Self { callback, looked: Instant::now(), raised: None }
    }

    /// Asks at an iteration with a residual. An exception of the callback or of a signal ends the work.
    pub(crate) fn ask(&mut self, iteration: usize, residual: f64) -> ControlFlow<()> {
        if self.callback.is_none() && self.looked.elapsed() < PATIENCE {
            return ControlFlow::Continue(());
        }
        self.looked = Instant::now();
        match Python::attach(|py| self.asked(py, iteration, residual)) {
            Ok(false) => ControlFlow::Continue(()),
            Ok(true) => ControlFlow::Break(()),
            Err(error) => {
                self.raised = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// Whether the callback asks for an end, by returning something true.
    fn asked(&self, py: Python<'_>, iteration: usize, residual: f64) -> PyResult<bool> {
        py.check_signals()?;
        match self.callback {
            Some(callback) => callback.call1(py, (iteration, residual))?.bind(py).is_truthy(),
            None => Ok(false),
        }
    }

    /// The exception that has ended the work, if one has.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}

/// The solution of a problem, with the lock released.
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
    let solution = py.detach(|| {
        let observer = &mut |at: &Iteration| watch.ask(at.iteration, at.residual);
        solver.solve_observed(problem, observer)
    });
    watch.finish()?;
    solution.map_err(|error| refused(&error))
}

/// Bad input as an exception.
pub(crate) fn refused(error: &Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
