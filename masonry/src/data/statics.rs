//! Forces that balance the loads, or the proof that there are no such forces.

use nalgebra::Vector2;

/// The decision on forces that balance the loads.
#[derive(Debug, Clone, PartialEq)]
pub enum Statics {
    /// Forces of all rows of the system \[N\] that balance the loads.
    Admissible(Vec<f64>),
    /// No forces balance the loads.
    Impossible(Proof),
    /// The decision is open.
    Open,
}

/// A motion that was checked to be a proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Displacement rates of the corners of every block, scaled to a largest component of one.
    pub rates: Vec<Vec<Vector2<f64>>>,
    /// Work of the loads on the motion, less that of cohesion and tensile strength, relative to the sum of all these
    /// forces \[-\].
    pub work: f64,
    /// The largest work of a unit contact force against the motion, relative to the force \[-\]: rounding errors.
    pub error: f64,
}

/// The largest value of a linear function of admissible forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extreme {
    /// Bounds of the largest value \[N\].
    Value {
        /// The value that forces reach.
        value: f64,
        /// The bound by a motion.
        bound: f64,
    },
    /// Forces that balance one another make the value as large as one likes.
    Unlimited,
    /// Neither bounds nor unlimited forces were found.
    Open,
}
