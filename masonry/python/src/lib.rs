//! The native half of the Python package `lcp`: problems from arrays, solves without the interpreter's lock, and answers as
//! arrays. What a user sees is in `python/lcp`.

mod answer;
mod arrays;
mod forms;
mod options;
mod walls;
mod watch;

use pyo3::prelude::*;

/// The module `lcp._native`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::answer::Answer;
    #[pymodule_export]
    use crate::forms::Sequence;
    #[pymodule_export]
    use crate::forms::{
        solve_boxed, solve_contact, solve_horizontal, solve_many, solve_mixed, solve_program,
        solve_standard,
    };
    #[pymodule_export]
    use crate::walls::{Found, Outcome, PyScene, SceneError};
}
