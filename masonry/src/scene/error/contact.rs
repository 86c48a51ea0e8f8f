//! Errors of contact points.

/// The reason why contact points could not be placed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactError {
    /// A joint has no place at which nodes of both sides coincide.
    #[error(
        "the joint between {a} and {b} has no coincident nodes: \
         refine the mesh so that nodes match, or place contact points at vertices"
    )]
    NoNodalPair {
        /// Name of the body on side `a`.
        a: String,
        /// Name of the body on side `b`.
        b: String,
    },
    /// Two edges that should have mortar between them are not parallel, or nearer than the thickness of the mortar.
    #[error(
        "{a} and {b} stand {nearest:.6} to {farthest:.6} m apart, but their joint, of class \"{class}\", has \
         mortar of {thickness:.6} m between parallel faces: move the blocks apart by {thickness:.6} m, or give the \
         joint no thickness"
    )]
    NoRoomForFilm {
        /// Name of the body on side `a`.
        a: String,
        /// Name of the body on side `b`.
        b: String,
        /// Name of the joint class.
        class: String,
        /// Smaller of the distances of the edges at the two ends of their overlap \[m\].
        nearest: f64,
        /// Larger of the distances of the edges at the two ends of their overlap \[m\].
        farthest: f64,
        /// Thickness of the mortar \[m\].
        thickness: f64,
    },
}
