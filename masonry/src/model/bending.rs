//! Bending of slender blocks: an upper bound of the factor by which a mesh is stiffer than its block.
//!
//! Let `x` be the longer and `y` the shorter main axis of a block, from its centroid. Under a curvature `k` along `x`
//! the displacements `k x y` and `-k (x^2 + nu y^2) / 2` have the stress `E k y` along `x` and no other, and the energy
//! `E I k^2 / 2`. The same displacements of the nodes have a larger energy, since sides of four-node elements stay
//! straight: shear replaces the missing curvature. The quotient of both energies in a rectangle of height `h` with
//! elements of length `a` in `m` rows is
//!
//! ```text
//! 1 + (a / h)^2 / (2 (1 + nu)) + nu^2 / ((1 - nu^2) m^2)
//! ```
//!
//! which is the quotient of the stiffnesses for one row (R. D. Cook et al., Concepts and Applications of Finite Element
//! Other meshes may have less energy by other displacements, so that the quotient is an upper bound for them. It
//! exceeds the quotient of the stiffnesses by 1 % for four rows, and is twice the quotient of the stiffnesses for
//! patches around a centroid with four elements a side.

use nalgebra::{Matrix2, Matrix3, SVector, Vector2};

use super::mesh::BlockMesh;
use crate::element::{quad4, quadrature};
use crate::geometry;

/// The bending of a block: its slenderness, and the stiffness of its mesh relative to that of the block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bending {
    /// Length divided by height of the rectangle with the same second moments of area \[-\].
    pub slenderness: f64,
    /// Stiffness of the mesh in bending divided by that of the block, at most \[-\].
    pub stiffness: f64,
}

impl Bending {
    /// Computes the bending of a meshed block with the constitutive matrix `d` \[Pa\]; `None` if an element is folded.
    pub fn of(mesh: &BlockMesh, d: &Matrix3<f64>) -> Option<Self> {
        let elements = || mesh.elements.iter().map(|it| it.map(|node| mesh.nodes[node]));
        let rim: Vec<_> = mesh.rim().map(|node| mesh.nodes[node]).collect();
        let centroid = geometry::centroid(&rim);
        let mut moments = Matrix2::zeros();
        for nodes in elements() {
            for place in quadrature::square() {
                let (_, determinant) = quad4::gradients(&nodes, place)?;
                let shape = quad4::shape(place);
                let arm: Vector2<f64> =
                    nodes.iter().zip(shape).map(|(node, share)| (node - centroid) * share).sum();
                moments += arm * arm.transpose() * determinant;
            }
        }
        let main = moments.symmetric_eigen();
        let longer = usize::from(main.eigenvalues[1] > main.eigenvalues[0]);
        let [long, short] = [longer, 1 - longer].map(|k| main.eigenvalues[k]);
        let along: Vector2<f64> = main.eigenvectors.column(longer).into();
        let across = -geometry::turn_right(along);
        let nu = d[(0, 1)] / d[(0, 0)];
        let mut energy = 0.0;
        for nodes in elements() {
            let mut moved = SVector::<f64, 8>::zeros();
            for (k, node) in nodes.iter().enumerate() {
                let [x, y] = [along, across].map(|axis| axis.dot(&(node - centroid)));
                let by = along * (x * y) - across * (0.5 * (x * x + nu * y * y));
                moved.fixed_rows_mut::<2>(2 * k).copy_from(&by);
            }
            energy += moved.dot(&(quad4::stiffness(&nodes, d, 1.0)? * moved));
        }
        let exact = d[(0, 0)] * (1.0 - nu * nu) * short;
        Some(Self { slenderness: (long / short).sqrt(), stiffness: energy / exact })
    }
}
