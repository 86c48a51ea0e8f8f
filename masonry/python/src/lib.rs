//! The native half of the Python packages `lcp` and `masonry`. It takes problems as arrays and scenes as keys, solves
//! them without the interpreter's lock, and returns answers as arrays. The interface for users is in `python/lcp` and
//! `python/masonry`.

mod answer;
mod arrays;
mod contact;
mod drawings;
mod failure;
mod forms;
mod found;
mod many;
mod options;
mod outcome;
mod scene;
mod watch;

use pyo3::prelude::*;

/// The module `lcp._native`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::answer::Answer;
    #[pymodule_export]
    use crate::contact::Contact;
    #[pymodule_export]
    use crate::drawings::{Imported, import_drawing};
    #[pymodule_export]
    use crate::failure::SceneError;
    #[pymodule_export]
    use crate::forms::{solve_boxed, solve_horizontal, solve_mixed, solve_program, solve_standard};
    #[pymodule_export]
    use crate::found::{Found, Studied};
    #[pymodule_export]
    use crate::many::{Sequence, solve_many};
    #[pymodule_export]
    use crate::outcome::{Mesh, Outcome};
    #[pymodule_export]
    use crate::scene::PyScene;
}
