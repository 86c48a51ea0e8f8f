//! Motions of a structure that has no equilibrium.

/// A motion of all blocks of a structure.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Amplitudes of the rigid modes of all blocks, as rates: three numbers per block.
    Rigid(Vec<f64>),
    /// Displacements of the sparse problem: a rigid motion of every block, and small deformations.
    Displacements(Vec<f64>),
    /// Velocities of all displacements of the sparse problem, for blocks that do not come to rest.
    Velocities(Vec<f64>),
}
