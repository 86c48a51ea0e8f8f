//! Nodes of a four-node element moved to other places, (3.40)-(3.53).
//!
//! The field of an element is kept, and described by its values at other places. Let `phi_j` be the shape
//! functions, and let node `h` move to a place at which they are `Delta_j`. The functions that are one at
//! their own node and zero at the other three are then
//!
//! ```text
//!  phi'_j = phi_j - (Delta_j / Delta_h) phi_h   (j != h),      phi'_h = phi_h / Delta_h
//!
//!  phi' = T phi,    u = T^T u',    f' = T f,    K' = T K T^T,    B' = B T^T
//! ```
//!
//! Nodes that move one after another give products, `T = T_2 T_1`, where `T_2` is found from the
//! functions that `T_1` has made. Rigid motions stay free of stress, and `K'` stays symmetric and
//! positive semidefinite.
//!
//! `T` is singular where `Delta_h` vanishes: at the other old nodes and on the lines between them that
//! do not contain node `h`. Where the `Delta_j` are without bound it is useless. Both are errors.
//!
//! # Example
//! The right end of the lower face of a film of 1 m moves outwards to a corner 1 m away: what the film's
//! end does is the mean of what its left end and that corner do.
//!
//! ```
//! use masonry::paper::film::change::NodalChange;
//! let change = NodalChange::of_film_end("film 1", 1, 1.0, 1.0)?;
//! assert_eq!(change.matrix().column(1).as_slice(), [0.5, 0.5, 0.0, 0.0]);
//! # Ok::<(), masonry::paper::film::change::ChangeError>(())
//! ```

use nalgebra::{Matrix2, Matrix4};

use super::{Matrix8, Vector8};
use crate::element::quad4::{self, StrainMatrix};
use crate::rounding::largest;

/// Largest amplification that a move may have: beyond it a change loses more than six digits.
///
/// It bounds every `|Delta_j|`, and the largest of them divided by `|Delta_h|`.
pub const LIMIT: f64 = 1e6;

/// How far shape functions may add up to something else than one, relative to the largest of them.
const PARTITION: f64 = 1e-9;

/// Why a node could not be moved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChangeError {
    /// The node's own shape function vanishes at the new place.
    #[error(
        "node {node} of {element} cannot move there: its shape function is {delta:e} at the new \
         place, which lies on another node or on a line between others; move another node first"
    )]
    Vanishing {
        /// Name of the element.
        element: String,
        /// The node, 0..4.
        node: usize,
        /// Its shape function at the new place \[-\].
        delta: f64,
    },
    /// The new place is too far away for the size of the element.
    #[error(
        "node {node} of {element} cannot move there: a shape function is {delta:e} at the new \
         place, which is too far away for so small an element; leave the element out or enlarge it"
    )]
    Unbounded {
        /// Name of the element.
        element: String,
        /// The node, 0..4.
        node: usize,
        /// The largest of the shape functions at the new place \[-\].
        delta: f64,
    },
    /// The values given are not those of shape functions.
    #[error(
        "the values given for node {node} of {element} add up to {sum} and not to one: \
         give all four shape functions at the new place"
    )]
    NotShapeFunctions {
        /// Name of the element.
        element: String,
        /// The node, 0..4.
        node: usize,
        /// Sum of the values \[-\].
        sum: f64,
    },
}

/// The matrix `T` of one move of a node, or of several.
#[derive(Debug, Clone, PartialEq)]
pub struct NodalChange {
    t: Matrix4<f64>,
}

impl NodalChange {
    /// No node moves.
    pub fn identity() -> Self {
        Self { t: Matrix4::identity() }
    }

    /// Node `node` (0..4) of an element moves to the place at which the present shape functions are
    /// `delta` (3.42). `element` names the element in errors.
    ///
    /// # Errors
    /// [`ChangeError`] if the change is singular, useless, or `delta` does not add up to one.
    ///
    /// # Panics
    /// If `node > 3`.
    pub fn at(element: &str, node: usize, delta: [f64; 4]) -> Result<Self, ChangeError> {
        check(element, node, delta)?;
        let own = delta[node];
        let mut t = Matrix4::identity();
        for j in 0..4 {
            t[(j, node)] = if j == node { 1.0 / own } else { -delta[j] / own };
        }
        Ok(Self { t })
    }

    /// Node `node` (0..4) of a bilinear quadrilateral moves to a place of its reference square, which may
    /// lie outside of it.
    ///
    /// # Errors
    /// [`ChangeError`] if the change is singular or useless.
    ///
    /// # Panics
    /// If `node > 3`.
    pub fn of_quad(element: &str, node: usize, place: [f64; 2]) -> Result<Self, ChangeError> {
        Self::at(element, node, quad4::shape(place))
    }

    /// One end of a face of a film moves by `shift` \[m\] along `x`; `length` \[m\] is the present length of
    /// that face.
    ///
    /// The rows and columns of the two nodes, the other end of the face first, are
    /// `[1, beta; 0, alpha]`, `alpha = l / (l + dl)`, `beta = dl / (l + dl)` (3.51), where `dl` is the growth
    /// of the face: `shift` at the right ends (nodes 1 and 3) and `-shift` at the left (0 and 2).
    ///
    /// # Errors
    /// [`ChangeError`] if the face becomes too short or too long for its present length.
    ///
    /// # Panics
    /// If `node > 3`.
    pub fn of_film_end(
        element: &str,
        node: usize,
        length: f64,
        shift: f64,
    ) -> Result<Self, ChangeError> {
        let (growth, other) = if node % 2 == 1 { (shift, node - 1) } else { (-shift, node + 1) };
        let mut delta = [0.0; 4];
        delta[node] = (length + growth) / length;
        delta[other] = -growth / length;
        check(element, node, delta)?;
        let mut t = Matrix4::identity();
        t[(node, node)] = length / (length + growth);
        t[(other, node)] = growth / (length + growth);
        Ok(Self { t })
    }

    /// The four ends of a film of `length` \[m\] move, one after another, to the places
    /// `[[x_1, x_2], [x_3, x_4]]` \[m\] on its lower and upper face, in its local axis.
    ///
    /// On each face the end goes first that keeps the face longer, so that no end passes the other.
    ///
    /// ```
    /// use masonry::paper::film::change::NodalChange;
    /// // Half a brick of 0.2 m overlaps half a brick of 0.2 m: running bond.
    /// let change = NodalChange::of_film("film 1", 0.1, [[-0.15, 0.05], [-0.05, 0.15]])?;
    /// assert!((change.matrix()[(0, 0)] - 0.5).abs() < 1e-15);
    /// # Ok::<(), masonry::paper::film::change::ChangeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ChangeError`] if a face becomes too short or too long for the film.
    pub fn of_film(element: &str, length: f64, faces: [[f64; 2]; 2]) -> Result<Self, ChangeError> {
        let mut change = Self::identity();
        for (face, [left, right]) in faces.into_iter().enumerate() {
            let (nodes, shifts) =
                ([2 * face, 2 * face + 1], [left + 0.5 * length, right - 0.5 * length]);
            let left_first = length - shifts[0] > length + shifts[1];
            let mut present = length;
            for end in if left_first { [0, 1] } else { [1, 0] } {
                let shift = shifts[end];
                change = change.then(&Self::of_film_end(element, nodes[end], present, shift)?);
                present += if end == 1 { shift } else { -shift };
            }
        }
        Ok(change)
    }

    /// This change followed by another one, found from the functions that this one has made.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self { t: next.t * self.t }
    }

    /// `T`: new shape functions from old ones.
    pub fn matrix(&self) -> &Matrix4<f64> {
        &self.t
    }

    /// `K' = T K T^T` for a stiffness or tangent `K` on the old nodes; it need not be symmetric.
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

    /// The same matrix for `u` and `v` of every node.
    fn both_directions(&self) -> Matrix8 {
        self.t.kronecker(&Matrix2::identity())
    }
}

fn check(element: &str, node: usize, delta: [f64; 4]) -> Result<(), ChangeError> {
    let own = delta[node];
    let largest = largest(&delta);
    let sum: f64 = delta.iter().sum();
    let element = || element.to_owned();
    // A place that is not finite fails here, too: no comparison holds for NaN.
    let bounded = sum.is_finite() && largest <= LIMIT;
    if !bounded {
        return Err(ChangeError::Unbounded { element: element(), node, delta: largest });
    }
    if (sum - 1.0).abs() > PARTITION * largest {
        return Err(ChangeError::NotShapeFunctions { element: element(), node, sum });
    }
    if own.abs() * LIMIT < largest {
        return Err(ChangeError::Vanishing { element: element(), node, delta: own });
    }
    Ok(())
}
