//! Problems given by the products of their rows.

use faer::ColRef;

use crate::Matrix;
use crate::matrix::Storage;

/// A square matrix `M` given by the products of its rows with a vector `z`, which may be represented by a state
/// instead.
///
/// The sweeps change one entry of `z` at a time and report the change by [`moved`](Self::moved). An implementation
/// with a state needs three short functions. The forces `z` in contact between rigid bodies, for instance, change
/// the velocities of the bodies by `M_b^-1 J^T z`, and a row product is a row of `J` times these velocities; the
/// matrix `J M_b^-1 J^T` is never formed:
///
/// ```
/// use lcp::pgs::{Constraint, Rows};
/// use lcp::{ProjectedGaussSeidel, Status};
///
/// struct Impulses {
///     j: Vec<Vec<(usize, f64)>>, // rows of J: (component of the velocity, entry)
///     inverse_mass: Vec<f64>,
///     velocity: Vec<f64>, // M_b^-1 J^T z
/// }
///
/// impl Rows for Impulses {
///     fn order(&self) -> usize {
///         self.j.len()
///     }
///     fn product(&self, i: usize, _z: &[f64]) -> f64 {
///         self.j[i].iter().map(|&(k, v)| v * self.velocity[k]).sum()
///     }
///     fn moved(&mut self, i: usize, change: f64) {
///         for &(k, v) in &self.j[i] {
///             self.velocity[k] += self.inverse_mass[k] * v * change;
///         }
///     }
///     fn clear(&mut self) {
///         self.velocity.fill(0.0);
///     }
/// }
///
/// // Two balls of mass 1 and 2, one on top of the other, fall on the ground with the velocity 3.
/// let mut balls = Impulses {
///     j: vec![vec![(0, 1.0)], vec![(0, -1.0), (1, 1.0)]],
///     inverse_mass: vec![1.0, 0.5],
///     velocity: vec![0.0; 2],
/// };
/// let free = [-3.0, 0.0]; // J times the velocities without impulses
/// let solution = ProjectedGaussSeidel::default()
///     .solve_rows(&mut balls, &free, &[Constraint::NONNEGATIVE; 2])?;
/// assert_eq!(solution.status, Status::Solved);
/// assert!((solution.z[0] - 9.0).abs() < 1e-6 && (solution.z[1] - 6.0).abs() < 1e-6);
/// # Ok::<(), lcp::Error>(())
/// ```
pub trait Rows {
    /// Number of rows.
    fn order(&self) -> usize;

    /// `(M z)_i`, either from `z` or from the state, which belongs to the same `z`.
    fn product(&self, i: usize, z: &[f64]) -> f64;

    /// Reports that `z_i` was changed by `change`: an implementation with a state updates it. The state must be
    /// linear in the changes. An implementation without a state does nothing.
    fn moved(&mut self, _i: usize, _change: f64) {}

    /// Sets `z = 0`: an implementation with a state sets it to zero. The function is called before every evaluation
    /// of the residual, after which all of `z` is reported again, so that no rounding errors accumulate in the
    /// state.
    fn clear(&mut self) {}

    /// `sum_j |M_ij z_j|`, by which the residual of the row is measured. A smaller value, such as `|(M z)_i|` by
    /// default, makes the residual larger and the tolerance harder to reach.
    fn size(&self, i: usize, z: &[f64]) -> f64 {
        self.product(i, z).abs()
    }
}

/// The constraint on the entries of `z` that one relaxation changes together, in the order of the rows: every bound
/// takes one row, and every contact takes two.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Constraint {
    /// `lower <= z_i <= upper`, with `w_i >= 0` at the lower bound, `w_i <= 0` at the upper one, and `w_i = 0` in
    /// between. The bounds may be infinite.
    Bounds {
        /// The lower bound.
        #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::minus_infinity"))]
        lower: f64,
        /// The upper bound.
        #[cfg_attr(feature = "serde", serde(with = "crate::json_numbers::infinity"))]
        upper: f64,
    },
    /// Unilateral contact with Coulomb's friction in the plane. `z_i` and `z_(i + 1)` are the normal and the
    /// tangential force, `w_i` and `w_(i + 1)` the velocities: `z_i` and `w_i` are complementary, and the
    /// tangential force is at most `mu z_i`, against the sliding.
    Friction {
        /// The coefficient of friction.
        mu: f64,
    },
}

impl Constraint {
    /// `z_i >= 0`.
    pub const NONNEGATIVE: Self = Self::Bounds { lower: 0.0, upper: f64::INFINITY };
    /// No bound: an equation `w_i = 0`.
    pub const FREE: Self = Self::Bounds { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// Number of rows.
    pub fn rows(self) -> usize {
        match self {
            Self::Bounds { .. } => 1,
            Self::Friction { .. } => 2,
        }
    }
}

/// The rows of a square [`Matrix`], stored by rows.
///
/// ```
/// use faer::mat;
/// use lcp::pgs::{MatrixRows, Rows};
/// let rows = MatrixRows::new(&mat![[2.0, -1.0], [1.0, 3.0]].into());
/// assert_eq!(rows.product(0, &[1.0, 4.0]), -2.0);
/// assert_eq!(rows.size(0, &[1.0, 4.0]), 6.0);
/// ```
#[derive(Debug, Clone)]
pub struct MatrixRows {
    transposed: Matrix,
}

impl MatrixRows {
    /// The rows of a matrix.
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn new(matrix: &Matrix) -> Self {
        let n = matrix.ncols();
        assert_eq!(matrix.nrows(), n, "a square matrix");
        let entries = (0..n).flat_map(|j| matrix.column(j).map(move |(i, v)| (j, i, v)));
        Self { transposed: Matrix::assembled(n, matrix.is_sparse(), entries) }
    }
}

impl Rows for MatrixRows {
    fn order(&self) -> usize {
        self.transposed.ncols()
    }

    fn product(&self, i: usize, z: &[f64]) -> f64 {
        match self.transposed.storage() {
            // The sum is computed in lanes, which need not wait for each other.
            Storage::Dense(m) => m.col(i).transpose() * ColRef::from_slice(z),
            Storage::Sparse(_) => self.transposed.slice(i).dot(z),
        }
    }

    fn size(&self, i: usize, z: &[f64]) -> f64 {
        let mut size = 0.0;
        self.transposed.slice(i).for_each(|j, v| size += (v * z[j]).abs());
        size
    }
}

/// Entries for the normal and the tangential row of one contact after the other.
pub(super) fn interleaved(normal: &[f64], tangential: &[f64]) -> Vec<f64> {
    normal.iter().zip(tangential).flat_map(|(n, t)| [*n, *t]).collect()
}

pub(super) fn parted(rows: &[f64]) -> [Vec<f64>; 2] {
    [0, 1].map(|k| rows.iter().skip(k).step_by(2).copied().collect())
}
