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
