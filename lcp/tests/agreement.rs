//! All methods agree on every problem that they can treat, to every tolerance asked for.
//!
//! A table says for every class of problems what every method owes: the solution, an honest answer, or a
//! refusal. Residuals are computed here from the data, and the distance from the reference, a planted
//! solution or that of Lemke's method, is bounded by what the residual asked for allows in the class.

#![allow(clippy::unwrap_used)] // a test may panic

mod common;

#[path = "agreement/boxed.rs"]
mod boxed;
#[path = "agreement/contact.rs"]
mod contact;
#[path = "agreement/friction.rs"]
mod friction;
#[path = "agreement/measure.rs"]
mod measure;
#[path = "agreement/mixed.rs"]
mod mixed;
#[path = "agreement/routes.rs"]
mod routes;
#[path = "agreement/standard.rs"]
mod standard;
