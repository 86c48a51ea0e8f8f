//! Finite elements: the four-node quadrilateral and its quadrature.

pub mod quad4;
pub mod quadrature;
