//! The tests of `lcp`, one module for each theme or method.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod common;

mod agreement;
mod auto;
mod cases;
mod choices;
mod classes;
mod contact;
mod contact_compliance;
mod enumeration;
mod evolution;
mod exact;
mod families;
mod far_out;
mod interface;
mod interior;
mod invariances;
mod judge;
mod least_forces;
mod lemke_small;
mod limits;
mod membranes;
mod newton;
mod observer;
mod oracle;
mod parametric;
mod parts;
mod pgs;
mod problems;
#[cfg(feature = "clarabel")]
mod qp;
#[cfg(feature = "clarabel")]
mod qp_contact;
mod refine;
mod sparse;
mod sparse_large;
mod sweep;
mod textbook;
