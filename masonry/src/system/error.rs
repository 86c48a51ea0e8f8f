//! Errors in building a system.

/// The reasons for which the stiffness of a block could not be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SystemError {
    /// A deformable block has no mesh.
    #[error("block `{block}` is elastic but has no mesh: give it a mesh or make it rigid")]
    NoMesh {
        /// Name of the block.
        block: String,
    },
    /// An element of the mesh is folded.
    #[error(
        "element {element} of block `{block}` is folded: the block must be convex, or star-shaped about its centroid"
    )]
    FoldedElement {
        /// Name of the block.
        block: String,
        /// Position of the element in the block's mesh.
        element: usize,
    },
    /// The stiffness has more zero modes than the three rigid motions, or negative ones.
    #[error(
        "the stiffness of block `{block}` is not positive definite (E = {young:e} Pa, \
         nu = {poisson}): E must be positive, nu above -1 and below 0.5"
    )]
    NotElastic {
        /// Name of the block.
        block: String,
        /// Young's modulus \[Pa\].
        young: f64,
        /// Poisson's ratio \[-\].
        poisson: f64,
    },
}
