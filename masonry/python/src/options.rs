//! Options of a solve, equal for all forms of problems.

use std::time::Duration;

use lcp::{
    Auto, AutoSettings, Enumeration, InteriorPoint, InteriorPointSettings, Lemke, LemkeSettings,
    Method, ProjectedGaussSeidel, ProjectedGaussSeidelSettings, QuadraticProgram,
    QuadraticProgramSettings, SemismoothNewton, SemismoothNewtonSettings, WarmStart,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The options of a solve; `None` stands for the default of the method.
#[derive(FromPyObject)]
pub(crate) struct Options {
    #[pyo3(item)]
    method: String,
    #[pyo3(item)]
    tol: Option<f64>,
    #[pyo3(item)]
    time_limit: Option<f64>,
    #[pyo3(item)]
    max_iterations: Option<usize>,
    #[pyo3(item)]
    pub(crate) callback: Option<Py<PyAny>>,
}

/// Solves a problem by the method in the options: one of the listed methods of the problem, or one of the methods for
/// all problems.
macro_rules! by_method {
    ($py:expr, $options:expr, $start:expr, $problem:expr, $($method:ident => $solver:ident),*) => {{
        let callback = $options.callback.as_ref();
        match $options.method()? {
            Method::Auto => solve($py, &$options.auto($start)?, $problem, callback),
            Method::Lemke => solve($py, &$options.lemke($start)?, $problem, callback),
            Method::Enumeration => solve($py, &$options.enumeration()?, $problem, callback),
            $(Method::$method => solve($py, &$options.$solver($start)?, $problem, callback),)*
            other => Err($crate::options::untreated(other, &[$(Method::$method),*])),
        }
    }};
}
pub(crate) use by_method;

/// Returns the error for a method that does not treat the form of a problem; its message names the methods that do.
pub(crate) fn untreated(method: Method, others: &[Method]) -> PyErr {
    let all = [Method::Auto, Method::Lemke, Method::Enumeration];
    let names: Vec<&str> = all.iter().chain(others).map(|method| method.name()).collect();
    let (name, names) = (method.name(), names.join(", "));
    PyValueError::new_err(format!(
        "method {name:?} does not treat this form: choose one of {names}"
    ))
}

/// Defines functions that create iterative methods, with settings from the options and the defaults of the method.
macro_rules! iterative {
    ($name:ident, $method:ident, $settings:ident) => {
        pub(crate) fn $name(&self, start: WarmStart) -> PyResult<$method> {
            let mut settings = $settings { start, ..$settings::default() };
            settings.tolerance = self.tol.unwrap_or(settings.tolerance);
            settings.max_iterations = self.max_iterations.unwrap_or(settings.max_iterations);
            settings.time_limit = self.time()?;
            Ok($method::new(settings))
        }
    };
}

impl Options {
    pub(crate) fn method(&self) -> PyResult<Method> {
        self.method.parse().map_err(|_| {
            let names: Vec<&str> = Method::ALL.iter().map(|method| method.name()).collect();
            let known = names.join(", ");
            PyValueError::new_err(format!(
                "method is {:?}, but must be one of: {known}",
                self.method
            ))
        })
    }

    pub(crate) fn auto(&self, start: WarmStart) -> PyResult<Auto> {
        self.without_iterations()?;
        let time_limit = self.time()?;
        let mut settings = AutoSettings { time_limit, start, ..AutoSettings::default() };
        settings.tolerance = self.tol.unwrap_or(settings.tolerance);
        Ok(Auto::new(settings))
    }

    pub(crate) fn lemke(&self, start: WarmStart) -> PyResult<Lemke> {
        let time_limit = self.time()?;
        let mut settings = LemkeSettings { time_limit, start, ..LemkeSettings::default() };
        settings.tolerance = self.tol.unwrap_or(settings.tolerance);
        settings.max_pivots = self.max_iterations;
        Ok(Lemke::new(settings))
    }

    pub(crate) fn enumeration(&self) -> PyResult<Enumeration> {
        self.without_iterations()?;
        let tolerance = self.tol.unwrap_or(AutoSettings::default().tolerance);
        Ok(Enumeration { tolerance, time_limit: self.time()? })
    }

    iterative!(newton, SemismoothNewton, SemismoothNewtonSettings);
    iterative!(interior, InteriorPoint, InteriorPointSettings);
    iterative!(program, QuadraticProgram, QuadraticProgramSettings);
    iterative!(sweeps, ProjectedGaussSeidel, ProjectedGaussSeidelSettings);

    /// Returns an error if the options limit the number of iterations, for a method without iterations.
    fn without_iterations(&self) -> PyResult<()> {
        match self.max_iterations {
            None => Ok(()),
            Some(_) => Err(PyValueError::new_err(format!(
                "max_iterations limits one method, and {:?} has none: give method, or time_limit instead",
                self.method
            ))),
        }
    }

    fn time(&self) -> PyResult<Option<Duration>> {
        let time = self.time_limit.map(|seconds| {
            Duration::try_from_secs_f64(seconds).map_err(|_| {
                PyValueError::new_err(format!(
                    "time_limit is {seconds}, but must be a number of seconds, not negative"
                ))
            })
        });
        time.transpose()
    }
}
