//! The only judge: what a state misses of equilibrium and of the contact law, and whether a wall stands.

pub mod checks;
pub mod verdict;
