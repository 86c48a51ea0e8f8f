//! The plan: which effects a scene calls for, why, and what they cost.

use serde::Serialize;

/// One physical effect, on or off, and the reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Name of the effect, such as `friction`.
    pub name: &'static str,
    /// Whether it is built.
    pub on: bool,
    /// What in the scene calls for it, or what is missing.
    pub because: String,
    /// Unknowns that it adds.
    pub unknowns: usize,
}

/// What will be built for a scene, known before anything is assembled.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    /// Effects, each with its reason.
    pub effects: Vec<Effect>,
    /// Number of blocks.
    pub blocks: usize,
    /// Number of nodes of all deformable blocks.
    pub nodes: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of contact points (m).
    pub contact_points: usize,
    /// Number of contact points with friction.
    pub frictional_points: usize,
    /// Rigid amplitudes: three per block, and as many isostatic rows (3.18).
    pub rigid_modes: usize,
    /// Order of the complementarity problem: m, and two more per frictional point (3m).
    pub order: usize,
    /// The solver that will be used.
    pub solver: String,
    /// Why this solver.
    pub because: String,
}
