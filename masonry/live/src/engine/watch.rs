//! Who follows the work on an answer.

use std::fmt::Display;
use std::ops::ControlFlow;

/// Hears many times how far the work on an answer is; after `Break` the work ends early.
pub type Watch<'a> = dyn FnMut(&dyn Display) -> ControlFlow<()> + 'a;
