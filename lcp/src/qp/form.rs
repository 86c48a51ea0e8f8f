//! The one form of all problems that the method treats.

use faer::sparse::SparseColMat;

use crate::matrix::add_image;

/// The values that a multiplier may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Bounds {
    /// Any value; the slack is zero.
    Free,
    /// Not negative, complementary to the slack.
    Nonnegative,
    /// Within `mu` times the multiplier of another row, in size; at the lower end if the slack is
    /// positive, at the upper end if the slack is negative.
    Cone {
        /// The other row.
        normal: usize,
        /// The coefficient of friction.
        mu: f64,
    },
}

/// Stationarity `P x + linear = D^T lambda` and slacks `w = D x + S lambda + offset`, with symmetric
/// positive semidefinite `P` and `S`. Every multiplier and its slack obey their [`Bounds`].
///
/// A form without cones has the conditions of a convex quadratic program.
#[derive(Debug, Clone)]
pub(super) struct Form {
    pub(super) p: SparseColMat<usize, f64>,
    pub(super) d: SparseColMat<usize, f64>,
    pub(super) s: SparseColMat<usize, f64>,
    pub(super) linear: Vec<f64>,
    pub(super) offset: Vec<f64>,
    pub(super) bounds: Vec<Bounds>,
}

/// Unknowns of a [`Form`].
#[derive(Debug, Clone)]
pub(super) struct ProgramPoint {
    pub(super) x: Vec<f64>,
    pub(super) lambda: Vec<f64>,
}

impl ProgramPoint {
    pub(super) fn zero(form: &Form) -> Self {
        Self { x: vec![0.0; form.unknowns()], lambda: vec![0.0; form.rows()] }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.x.iter().chain(&self.lambda).all(|v| v.is_finite())
    }
}

impl Form {
    /// Number of `x`.
    pub(super) fn unknowns(&self) -> usize {
        self.linear.len()
    }

    /// Number of multipliers.
    pub(super) fn rows(&self) -> usize {
        self.offset.len()
    }

    /// Whether any multiplier is bounded by another one.
    pub(super) fn has_cones(&self) -> bool {
        self.bounds.iter().any(|bounds| matches!(bounds, Bounds::Cone { .. }))
    }

    /// The slacks `w`.
    pub(super) fn slacks(&self, point: &ProgramPoint) -> Vec<f64> {
        let mut sum = self.offset.clone();
        add_image(&self.d, 1.0, &point.x, &mut sum);
        add_image(&self.s, 1.0, &point.lambda, &mut sum);
        sum
    }

    /// The friction bounds that belong to the multipliers, one for every row, zero without a cone.
    pub(super) fn limits(&self, lambda: &[f64]) -> Vec<f64> {
        let limit = |bounds: &Bounds| match bounds {
            Bounds::Cone { normal, mu } => mu * lambda[*normal].max(0.0),
            Bounds::Free | Bounds::Nonnegative => 0.0,
        };
        self.bounds.iter().map(limit).collect()
    }
}
