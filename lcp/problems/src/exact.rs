//! Exact arithmetic: exact solutions of small problems (feature `exact`).
//!
//! Every `f64` is a rational number, so a problem has an exact solution. The module finds exact solutions for tests,
//! for teaching, and to check floating-point solvers:
//!
//! * [`verify_basis`] solves one complementary basis, say that of a [`Solution`](lcp::Solution).
//! * [`enumerate`] finds all solutions of a small problem: isolated points, segments, polyhedra.
//! * [`feasibility`] decides whether `A t + B y = c`, `t >= 0`, `y >= 0` can be met at all, and
//!   proves it if not.
//!
//! Rows are first multiplied by powers of two that make the data integers; elimination is fraction-free, so that the
//! numbers in it are minors of the data and no larger.

mod cone;
mod enumeration;
mod feasibility;
mod integers;
mod tableau;
mod verdict;

pub use dashu_ratio::RBig;

pub use enumeration::{EnumerationSettings, ExactEnumeration, Face, enumerate};
pub use feasibility::{Feasibility, feasibility};
pub use verdict::{ExactVerdict, verify_basis};

/// A point `(t, y)`, or a direction, in rational numbers.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ExactPoint {
    /// The first variable of every pair.
    pub t: Vec<RBig>,
    /// The second variable of every pair.
    pub y: Vec<RBig>,
}

impl ExactPoint {
    /// The nearest floating-point numbers, `t` and `y`; infinite if a number exceeds their range.
    pub fn rounded(&self) -> (Vec<f64>, Vec<f64>) {
        (rounded(&self.t), rounded(&self.y))
    }
}

fn rounded(values: &[RBig]) -> Vec<f64> {
    values.iter().map(|v| v.to_f64().value()).collect()
}
