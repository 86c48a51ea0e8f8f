//! Admissible forces, which balance the loads within friction, or the proof that no such forces exist.

use nalgebra::Vector2;

/// The decision whether forces within friction balance the loads.
#[derive(Debug, Clone, PartialEq)]
pub enum Statics {
    /// Forces balance the loads: the forces of all rows of the system \[N\].
    Admissible(Vec<f64>),
    /// No forces balance the loads, with the proof.
    Impossible(Proof),
    /// Undecided: neither forces nor a proof were found.
    Open,
}

/// A proof that no forces balance the loads: a motion of the blocks, which was checked in the geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Displacement rates of the corners of every block, scaled to a largest component of one.
    pub rates: Vec<Vec<Vector2<f64>>>,
    /// Work of the loads on the motion, minus that of cohesion and tensile strength, relative to the sum of all loads
    /// and strengths \[-\].
    pub work: f64,
    /// The largest work that a unit contact force can do against the motion \[-\]: rounding errors of the motion.
    pub error: f64,
}

/// An extreme value, the largest or the least, of a linear function of admissible forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extreme {
    /// The value is known between two bounds \[N\].
    Value {
        /// The value that admissible forces reach.
        value: f64,
        /// The bound that a motion proves: no admissible forces go beyond it.
        bound: f64,
    },
    /// There is no limit: forces that balance one another can be added in any amount.
    Unlimited,
    /// Undecided: neither bounds nor forces that balance one another were found.
    Open,
}
