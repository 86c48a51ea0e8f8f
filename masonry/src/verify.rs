//! Independent checks of a state: the errors in equilibrium and in the contact law; and the verdict whether a wall
//! stands.

pub mod checks;
#[doc(hidden)]
pub mod moving;
pub(crate) mod step;
pub mod verdict;
