//! Methods of the paper that the routes of `auto` do not use, kept for comparison: the augmented Lagrangian method,
//! and mortar films as strips with their own nodes, which may be changed to the nodes of the blocks.

pub mod alm;
pub mod film;
