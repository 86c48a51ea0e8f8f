//! What is met in place of a solution, and proves nothing.

/// The secondary ray on which an attempt ended.
///
/// `A dt + B dy = covering dz0` with `dt, dy, dz0 >= 0` and `dt.dy = 0`: for every `s >= 0` the last
/// point of the attempt plus `s (dt, dy, dz0)` satisfies `A t + B y = c + covering z0`, so that along
/// the ray the artificial variable `z0` does not decrease.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Ray {
    /// Direction in `t`.
    pub dt: Vec<f64>,
    /// Direction in `y`.
    pub dy: Vec<f64>,
    /// Rate of the artificial variable.
    pub dz0: f64,
    /// The covering vector in the rows of the problem.
    pub covering: Vec<f64>,
}

/// The loads that soft springs on all displacements of a contact problem carry, for decreasing stiffness.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SoftSprings {
    /// The stiffnesses, relative to that of the bodies.
    pub stiffness: Vec<f64>,
    /// The share of the load that the springs of each stiffness carry: it tends to zero like the
    /// stiffness where there is an equilibrium, and to a constant where there is none.
    pub shares: Vec<f64>,
    /// The displacements with the softest springs: the mechanism, as large as the springs let it become.
    pub motion: Vec<f64>,
}

/// More of the load than this is none that contacts carry but for what steps of a method leave. Chosen.
const CARRIED: f64 = 1e-4;

impl SoftSprings {
    /// Whether the softest springs, or the least viscosity, carry a share of the load that matters: more than 1e-4.
    pub fn carry_load(&self) -> bool {
        self.shares.last().is_some_and(|share| *share > CARRIED)
    }
}
