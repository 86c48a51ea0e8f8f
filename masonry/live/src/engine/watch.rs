//! The observer of the work on an answer.

use std::fmt::Display;
use std::ops::ControlFlow;

/// A function that is called many times with the progress of the work on an answer; the work ends early after `Break`.
pub type Watch<'a> = dyn FnMut(&dyn Display) -> ControlFlow<()> + 'a;
