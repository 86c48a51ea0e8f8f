//! Nodes of a four-node element moved to other places as in the paper, (3.40)-(3.53).
//!
//! The library interpolates on the edges of the blocks, which is the same for straight edges; this is the independent way.
//! Let `phi_j` be the shape functions, and let node `h` move to a place at which they are `Delta_j`. The functions
//! that are one at their own node and zero at the other three are then
//!
//! ```text
//!  phi'_j = phi_j - (Delta_j / Delta_h) phi_h   (j != h),      phi'_h = phi_h / Delta_h
//!
//!  phi' = T phi,    u = T^T u',    f' = T f,    K' = T K T^T,    B' = B T^T
//! ```

use masonry::element::quad4::{self, StrainMatrix};
use masonry::paper::film::{Matrix8, Vector8};
use nalgebra::{Matrix2, Matrix4, Vector2};

/// The matrix `T` of one move of a node, or of several.
pub struct NodalChange {
    t: Matrix4<f64>,
}

impl NodalChange {
    pub fn identity() -> Self {
        Self { t: Matrix4::identity() }
    }

    /// Node `node` moves to the place at which the present shape functions are `delta` (3.42).
    pub fn at(node: usize, delta: [f64; 4]) -> Self {
        let own = delta[node];
        let mut t = Matrix4::identity();
        for j in 0..4 {
            t[(j, node)] = if j == node { 1.0 / own } else { -delta[j] / own };
        }
        Self { t }
    }

    /// Node `node` of a bilinear quadrilateral moves to a place of its reference square, or outside of it.
    pub fn of_quad(node: usize, place: [f64; 2]) -> Self {
        Self::at(node, quad4::shape(place))
    }

    /// One end of a face of a film moves by `shift` along `x`; `length` is the present length of that face.
    ///
    /// The rows and columns of the two nodes, the other end of the face first, are
    /// `[1, beta; 0, alpha]`, `alpha = l / (l + dl)`, `beta = dl / (l + dl)` (3.51), where `dl` is the growth
    /// of the face: `shift` at the right ends (nodes 1 and 3) and `-shift` at the left (0 and 2).
    pub fn of_film_end(node: usize, length: f64, shift: f64) -> Self {
        let (growth, other) = if node % 2 == 1 { (shift, node - 1) } else { (-shift, node + 1) };
        let mut t = Matrix4::identity();
        t[(node, node)] = length / (length + growth);
        t[(other, node)] = growth / (length + growth);
        Self { t }
    }

    /// The four ends of a film move, one after another, to the places `[[x_1, x_2], [x_3, x_4]]` on its lower and upper
    /// face. On each face the end goes first that keeps the face longer, so that no end passes the other.
    pub fn of_film(length: f64, faces: [[f64; 2]; 2]) -> Self {
        let mut change = Self::identity();
        for (face, [left, right]) in faces.into_iter().enumerate() {
            let shifts = [left + 0.5 * length, right - 0.5 * length];
            let left_first = length - shifts[0] > length + shifts[1];
            let mut present = length;
            for end in if left_first { [0, 1] } else { [1, 0] } {
                let shift = shifts[end];
                change = change.then(&Self::of_film_end(2 * face + end, present, shift));
                present += if end == 1 { shift } else { -shift };
            }
        }
        change
    }

    /// This change followed by another one, found from the functions that this one has made.
    pub fn then(&self, next: &Self) -> Self {
        Self { t: next.t * self.t }
    }

    /// `T`: new shape functions from old ones.
    pub fn matrix(&self) -> &Matrix4<f64> {
        &self.t
    }

    /// `K' = T K T^T`.
    pub fn stiffness(&self, k: &Matrix8) -> Matrix8 {
        let t = self.both_directions();
        t * k * t.transpose()
    }

    /// `B' = B T^T`: strains from displacements of the new nodes.
    pub fn strain_matrix(&self, b: &StrainMatrix) -> StrainMatrix {
        b * self.both_directions().transpose()
    }

    /// `f' = T f`: forces on the new nodes that do the work of `f` on the old.
    pub fn forces(&self, f: &Vector8) -> Vector8 {
        self.both_directions() * f
    }

    /// `u = T^T u'`: displacements of the old nodes from those of the new.
    pub fn displacements(&self, u: &Vector8) -> Vector8 {
        self.both_directions().transpose() * u
    }

    fn both_directions(&self) -> Matrix8 {
        self.t.kronecker(&Matrix2::identity())
    }
}

/// The matrix `Q` that turns global nodal displacements into local ones, `u = Q u_global`, for the unit tangent of a joint.
pub fn local_axes(tangent: Vector2<f64>) -> Matrix8 {
    let mut q = Matrix8::zeros();
    for k in (0..8).step_by(2) {
        q[(k, k)] = tangent.x;
        q[(k, k + 1)] = tangent.y;
        q[(k + 1, k)] = -tangent.y;
        q[(k + 1, k + 1)] = tangent.x;
    }
    q
}
