//! Routes from the reduced problem to the contact forces: one file each.

pub mod alm;
pub mod lemke;
