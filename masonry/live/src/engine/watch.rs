//! The observer of the work on an answer.

use std::fmt::Display;
use std::ops::ControlFlow;

/// Receives the progress of the work on an answer many times; the work ends early after `Break`.
pub type Watch<'a> = dyn FnMut(&dyn Display) -> ControlFlow<()> + 'a;
