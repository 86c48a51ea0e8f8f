//! What blocks and mortar are made of.

/// Linear elasticity of a deformable block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio \[-\].
    pub poisson: f64,
}
