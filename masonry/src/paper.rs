//! What the paper does and the routes of `auto` do not: the augmented Lagrangian method, mortar films as strips with
//! nodes of their own, and the change of these nodes. They are here for comparison.

pub mod alm;
pub mod film;
