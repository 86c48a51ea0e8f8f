//! Motions of a structure that has no equilibrium.

/// A motion of all blocks.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Rates of the rigid amplitudes, three per block.
    Rigid(Vec<f64>),
    /// Displacements of the sparse problem: a rigid motion of every block, and a small deformation.
    Displacements(Vec<f64>),
    /// Velocities of the sparse problem, of blocks that go on moving.
    Velocities(Vec<f64>),
}
