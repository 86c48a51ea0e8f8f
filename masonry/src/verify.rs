//! Independent checks: the errors of a state in equilibrium and in the contact law, and whether a wall stands.

pub mod checks;
pub(crate) mod moving;
pub(crate) mod step;
pub mod verdict;
