//! Answers of solvers for Python.

use lcp::{Certificate, Info, Residuals, Solution};
use numpy::PyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde_json::json;

/// The answer of a solver: arrays, and the other results as JSON on request.
#[pyclass(frozen)]
pub(crate) struct Answer {
    /// The name of the status, such as `Solved`.
    #[pyo3(get)]
    status: String,
    /// The arrays of the solution, in the order in which the Python half names them.
    #[pyo3(get)]
    arrays: Vec<Py<PyArray1<f64>>>,
    residuals: Residuals,
    certificate: Option<Certificate>,
    info: Info,
    condition: Option<f64>,
}

impl Answer {
    /// Creates the answer whose arrays are the complementary variables `t` and `y` of the solution.
    pub(crate) fn of_pairs<P>(py: Python<'_>, mut solution: Solution<P>) -> Self {
        let pairs = [&mut solution.t, &mut solution.y].map(std::mem::take);
        Self::new(py, solution, pairs.into())
    }

    pub(crate) fn new<P>(py: Python<'_>, solution: Solution<P>, point: Vec<Vec<f64>>) -> Self {
        let arrays = point.into_iter().map(|it| PyArray1::from_vec(py, it).unbind()).collect();
        let Solution { status, residuals, certificate, info, condition, .. } = solution;
        Self { status: status.to_string(), arrays, residuals, certificate, info, condition }
    }
}

#[pymethods]
impl Answer {
    /// Returns residuals, certificate, cost and condition number as JSON.
    fn details(&self) -> PyResult<String> {
        let Self { residuals, certificate, info, condition, .. } = self;
        let details = json!({
            "residuals": residuals, "certificate": certificate, "info": info, "condition": condition
        });
        serde_json::to_string(&details).map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }
}
