//! Forces that balance the loads, or the proof that there are none.

use nalgebra::Vector2;

/// The decision on forces that balance the loads.
#[derive(Debug, Clone, PartialEq)]
pub enum Statics {
    /// These do: of all rows of the system \[N\].
    Admissible(Vec<f64>),
    /// There are none.
    Impossible(Proof),
    /// Undecided.
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
    /// The largest work that a contact force of one could do against it, relative to the force \[-\]: rounding errors.
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
    /// Forces that balance one another make it as large as one likes.
    Unlimited,
    /// Neither came out.
    Open,
}
