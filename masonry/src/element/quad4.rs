//! The bilinear four-node quadrilateral (Q4) with 2 x 2 Gauss points.
//!
//! Nodes run counter-clockwise; the degrees of freedom are `u_1, v_1, ..., u_4, v_4`.

use nalgebra::{Matrix2, Matrix3, Point2, SMatrix, SVector, Vector2, Vector3};

use super::quadrature;

/// Coordinates of the four nodes of an element, counter-clockwise \[m\].
pub type Nodes = [Point2<f64>; 4];

/// The strain-displacement matrix `B` \[1/m\] of `eps = B u`.
pub type StrainMatrix = SMatrix<f64, 3, 8>;

/// Coordinates of the nodes in the reference square.
const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// Returns the values of the four shape functions at a place of the reference square.
pub fn shape([xi, eta]: [f64; 2]) -> [f64; 4] {
    CORNERS.map(|[a, b]| 0.25 * (1.0 + a * xi) * (1.0 + b * eta))
}

/// Returns the derivatives of the four shape functions with respect to the reference coordinates.
fn reference_gradients([xi, eta]: [f64; 2]) -> [Vector2<f64>; 4] {
    CORNERS.map(|[a, b]| Vector2::new(0.25 * a * (1.0 + b * eta), 0.25 * b * (1.0 + a * xi)))
}

/// Computes the Jacobian matrix \[m\] of the map from the reference square: entry `(i, j)` is `d x_j / d xi_i`.
fn jacobian(nodes: &Nodes, place: [f64; 2]) -> Matrix2<f64> {
    // Coordinates relative to node 0: elements far from the origin lose no digits.
    let origin = nodes[0];
    reference_gradients(place)
        .iter()
        .zip(nodes)
        .map(|(gradient, node)| gradient * (node - origin).transpose())
        .sum()
}

/// Computes the gradients of the shape functions \[1/m\] and the determinant of the Jacobian \[m^2\] at a place of the
/// reference square; `None` unless the map is invertible and keeps the orientation.
pub fn gradients(nodes: &Nodes, place: [f64; 2]) -> Option<([Vector2<f64>; 4], f64)> {
    let jacobian = jacobian(nodes, place);
    let determinant = jacobian.determinant();
    let inverse = (determinant > 0.0).then(|| jacobian.try_inverse()).flatten()?;
    Some((reference_gradients(place).map(|it| inverse * it), determinant))
}

/// Computes the strain-displacement matrix \[1/m\] and the determinant of the Jacobian \[m^2\] at a place of the
/// reference square; `None` unless the map is invertible and keeps the orientation.
pub fn strain_matrix(nodes: &Nodes, place: [f64; 2]) -> Option<(StrainMatrix, f64)> {
    let (gradients, determinant) = gradients(nodes, place)?;
    let mut b = StrainMatrix::zeros();
    for (k, d) in gradients.into_iter().enumerate() {
        b[(0, 2 * k)] = d.x;
        b[(1, 2 * k + 1)] = d.y;
        b[(2, 2 * k)] = d.y;
        b[(2, 2 * k + 1)] = d.x;
    }
    Some((b, determinant))
}

/// Computes the stiffness matrix \[N/m\] for the constitutive matrix `d` \[Pa\] and a thickness \[m\].
///
/// `None` if the element is folded at a Gauss point.
pub fn stiffness(nodes: &Nodes, d: &Matrix3<f64>, thickness: f64) -> Option<SMatrix<f64, 8, 8>> {
    quadrature::square()
        .map(|place| {
            let (b, determinant) = strain_matrix(nodes, place)?;
            Some(b.transpose() * d * b * (determinant * thickness))
        })
        .sum()
}

/// Computes the consistent nodal forces \[N\] of a uniform force per volume \[N/m^3\], for a thickness \[m\].
pub fn body_load(nodes: &Nodes, force: Vector2<f64>, thickness: f64) -> SVector<f64, 8> {
    let mut load = SVector::zeros();
    for place in quadrature::square() {
        let volume = jacobian(nodes, place).determinant() * thickness;
        for (k, n) in shape(place).into_iter().enumerate() {
            load[2 * k] += n * volume * force.x;
            load[2 * k + 1] += n * volume * force.y;
        }
    }
    load
}

/// Computes the stress at the centre \[Pa\] for the displacements of the nodes \[m\]; `None` if the element is folded
/// at its centre.
pub fn stress_at_centre(
    nodes: &Nodes,
    d: &Matrix3<f64>,
    displacements: &SVector<f64, 8>,
) -> Option<Vector3<f64>> {
    let (b, _) = strain_matrix(nodes, [0.0; 2])?;
    Some(d * b * displacements)
}

/// Returns the centre of the element \[m\], the image of the centre of the reference square.
pub fn centre(nodes: &Nodes) -> Point2<f64> {
    Point2::from(nodes.iter().map(|p| p.coords).sum::<Vector2<f64>>() * 0.25)
}
