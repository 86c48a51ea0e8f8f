//! Forms of the contact problem of a [`System`](crate::system::System): with all displacements as unknowns, or reduced
//! to contact forces.
//!
//! | module | content |
//! |---|---|
//! | [`Sparse`] | all displacements, by sparse matrices (3.2), (3.3) |
//! | [`reduction`] | equilibrium (3.18) and compatibility (3.23) in the contact forces alone |
//! | [`DenseForm`] | complementarity problems `A t + B y = c` made of the reduction (3.27) |

mod dense;
pub mod reduction;
mod sparse;

pub use dense::{DenseForm, FormKind, FormScale, Start};
pub use sparse::Sparse;
