//! Exceptions about scenes and their results.

use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

create_exception!(
    lcp._native,
    SceneError,
    PyValueError,
    "A scene that is wrong, with the place and the remedy."
);

/// Returns the exception for a mistake in the scene.
pub(crate) fn wrong(error: impl std::fmt::Display) -> PyErr {
    SceneError::new_err(error.to_string())
}

/// Returns the exception for an error in writing results, which no data can cause.
pub(crate) fn failed(error: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
