//! All methods agree on every problem that they can treat, to every tolerance asked for.
//!
//! A table says for every class of problems what every method owes: the solution, an honest answer, or a
//! refusal. Residuals are computed here from the data, and the distance from the reference, a planted
//! solution or that of Lemke's method, is bounded by what the residual asked for allows in the class.

use crate::common;

mod boxed;
mod contact;
mod friction;
mod measure;
mod mixed;
mod routes;
mod standard;
