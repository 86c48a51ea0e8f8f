//! The choice of the rows of `G = C N` that carry the statically determinate part of the contact forces (3.18).

use faer::linalg::solvers::ColPivQr;
use faer::{Mat, MatRef};
use nalgebra::Point2;

use super::{Modes, select_rows};

/// Threshold of the rank \[-\]: pivots of the orthogonal factorisation below this fraction of the largest count as
/// zero. Exact dependencies leave pivots of 1e-15; the pivots of the weakest supports of a real structure are far
/// above the threshold.
const RANK_TOLERANCE: f64 = 1e-10;

/// A split of the contact rows into isostatic rows and the others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Isostatic {
    /// The isostatic rows: linearly independent, as many as there are rigid amplitudes; increasing.
    pub rows: Vec<usize>,
    /// The rows that are not isostatic, increasing.
    pub others: Vec<usize>,
}

/// A motion of one block that changes no gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FreeMotion {
    /// The block translates along a unit vector.
    Translation {
        /// The direction, a unit vector.
        direction: [f64; 2],
    },
    /// The block turns about a point.
    Rotation {
        /// The point that does not move \[m\].
        centre: Point2<f64>,
    },
}

impl std::fmt::Display for FreeMotion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Translation { direction: [x, y] } => {
                write!(f, "slide along ({x:.3}, {y:.3})")
            }
            Self::Rotation { centre } => {
                write!(f, "turn about the point ({:.4}, {:.4}) m", centre.x, centre.y)
            }
        }
    }
}

/// The reason why contacts do not hold the blocks.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RigidError {
    /// Some blocks can move without any relative displacement at a contact.
    #[error("block {block} can {motion}, and no contact resists (free motions in all: {free})")]
    Free {
        /// The index of the block of the model that moves most.
        block: usize,
        /// The motion of the block.
        motion: FreeMotion,
        /// Number of independent motions that no contact resists.
        free: usize,
    },
}

/// Chooses the isostatic rows of `g`, the matrix `G` of all rows with three columns per block.
///
/// The first `normal` rows of `g` are preferred: a column-pivoted orthogonal factorisation of their transpose selects
/// the best conditioned of them. Tangential rows, projected on the free motions, are selected only if the normal rows
/// lack rank (no normal row resists the horizontal motion of a column on a floor). `weights` has one positive number
/// per row; among equal rows, rows with large weights are selected. The recovered state does not depend on the choice.
///
/// # Errors
/// [`RigidError::Free`] if all rows together leave a motion free.
///
/// # Panics
/// If there are fewer weights than rows.
pub fn choose(
    g: &Mat<f64>,
    normal: usize,
    modes: &[Modes],
    weights: Option<&[f64]>,
) -> Result<Isostatic, RigidError> {
    let weighted = match weights {
        None => g.clone(),
        Some(w) => Mat::from_fn(g.nrows(), g.ncols(), |i, j| g[(i, j)] * w[i]),
    };
    let normals = select_rows(&weighted, &(0..normal).collect::<Vec<_>>());
    let first = Pivoted::of(normals.transpose(), 0.0);
    let mut rows = first.columns;
    if rows.len() < g.ncols() {
        let tangents = select_rows(&weighted, &(normal..g.nrows()).collect::<Vec<_>>());
        let seen = (&tangents * &first.complement).transpose().to_owned();
        let second = Pivoted::of(seen.as_ref(), tangents.norm_max());
        if second.columns.len() < first.complement.ncols() {
            return Err(describe(&(&first.complement * &second.complement), modes));
        }
        rows.extend(second.columns.iter().map(|k| normal + k));
    }
    rows.sort_unstable();
    let mut chosen = vec![false; g.nrows()];
    for row in &rows {
        chosen[*row] = true;
    }
    let others = (0..g.nrows()).filter(|row| !chosen[*row]).collect();
    Ok(Isostatic { rows, others })
}

/// Independent columns of a matrix and the orthogonal complement of their span.
struct Pivoted {
    columns: Vec<usize>,
    /// Orthonormal columns that span the orthogonal complement.
    complement: Mat<f64>,
}

impl Pivoted {
    /// Computes the pivoted factorisation. `reference` is the size of the data from which the matrix was computed: a
    /// matrix that has only rounding errors gets rank zero.
    fn of(matrix: MatRef<'_, f64>, reference: f64) -> Self {
        let (height, width) = matrix.shape();
        if width == 0 {
            return Self { columns: Vec::new(), complement: Mat::identity(height, height) };
        }
        let qr = ColPivQr::new(matrix);
        let pivot = |k: usize| qr.thin_R()[(k, k)].abs();
        let least = RANK_TOLERANCE * pivot(0).max(reference);
        let rank = (0..height.min(width)).take_while(|k| pivot(*k) > least).count();
        let columns = qr.P().arrays().0[..rank].to_vec();
        let complement = qr.compute_Q().subcols(rank, height - rank).to_owned();
        Self { columns, complement }
    }
}

/// Describes the free motion in which a single block moves most; `free` has the free motions as orthonormal columns.
fn describe(free: &Mat<f64>, modes: &[Modes]) -> RigidError {
    let squared_norm = |i: usize| (0..free.ncols()).map(|j| free[(i, j)].powi(2)).sum::<f64>();
    let strongest = (0..free.nrows())
        .max_by(|i, j| squared_norm(*i).total_cmp(&squared_norm(*j)))
        .unwrap_or_default();
    let block = strongest / 3;
    // The free motion nearest to the strongest amplitude alone.
    let amplitude =
        |i: usize| (0..free.ncols()).map(|j| free[(i, j)] * free[(strongest, j)]).sum::<f64>();
    let [x, y, turn] = [0, 1, 2].map(|k| amplitude(3 * block + k));
    let Modes { centre, length } = modes[block];
    let translation = x.hypot(y);
    // A centre farther away than a thousand sizes of the block is at infinity for the reader.
    let motion = if turn.abs() * 1e3 > translation {
        let arm = nalgebra::Vector2::new(-y, x) * (length / turn);
        FreeMotion::Rotation { centre: centre + arm }
    } else {
        FreeMotion::Translation { direction: [x / translation, y / translation] }
    };
    RigidError::Free { block, motion, free: free.ncols() }
}
