//! Parts of the paper that the routes of `auto` do not use: the augmented Lagrangian method, mortar films as strips
//! with their own nodes, and the change of these nodes. They are kept for comparison.

pub mod alm;
pub mod film;
